/// Setup of a tie: parameters, surfaces and materials of the model as the core takes them, and their faults.
#pragma once

#include "contact/tie/tie.h"
#include "contact_log.h"
#include "dof_map.h"
#include "host/facet_material.h"
#include "host/tie_parameters.h"

#include <memory>
#include <optional>

class TieSetup {
 public:
  TieSetup(FEModel& fem, ContactSurfaces& surfaces, DofMap& dofs, const TieParameters& parameters,
           const ContactLog& log)
      : fem_(fem), surfaces_(surfaces), dofs_(dofs), parameters_(parameters), log_(log) {}

  /// Whether the parameters, the surfaces and the model allow a tie; the log lists the faults.
  bool check() const;
  /// Finds the tied nodes at the present positions. Null if there are none; the log gives the reason.
  std::unique_ptr<mixture_contact::Tie> build() const;
  void say_what_is_tied(const mixture_contact::Tie& tie) const;
  /// Warns of a cohesive zone that is too short for the facets.
  void judge_cohesive_zone(const mixture_contact::Tie& tie) const;
  /// The primary nodes once their gaps are closed.
  mixture_contact::Matrix3Xd relocated(const mixture_contact::Tie& tie) const;
  /// Takes penalties and tolerances as they are at this time, and materials where penalties follow them. Returns
  /// whether all values make sense; the log says which do not.
  bool update(mixture_contact::Tie& tie) const;
  mixture_contact::Settings settings() const;
  /// How the tie breaks in the present step.
  mixture_contact::BreakingLaw breaking() const;

 private:
  std::optional<FacetMaterials> materials() const;
  /// Whether bonds soften with their penalties, and nothing else rules out breaking.
  bool can_break(const mixture_contact::Tie& tie) const;
  std::optional<mixture_contact::Effects> effects(const FacetMaterials& materials) const;
  mixture_contact::PerSide<mixture_contact::SurfaceMesh> meshes(const FacetMaterials& materials,
                                                                const mixture_contact::Effects& effects) const;

  FEModel& fem_;
  ContactSurfaces& surfaces_;
  DofMap& dofs_;
  const TieParameters& parameters_;
  const ContactLog& log_;
};
