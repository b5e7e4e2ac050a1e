/// Setup of a tie from an FEBio model: parameters, surfaces and materials in the form of the core, and checks of them.
#pragma once

#include "contact/tie/tie.h"
#include "contact_log.h"
#include "dof_map.h"
#include "host/facet_material.h"
#include "host/tie_parameters.h"

#include <memory>
#include <optional>

/// Sets up a tie.
class TieSetup {
 public:
  TieSetup(DofMap& dofs, const TieParameters& parameters, const ContactLog& log)
      : dofs_(dofs), parameters_(parameters), log_(log) {}

  /// True if parameters, surfaces and model permit a tie; faults are logged.
  bool check() const;
  /// Finds the tied nodes at the present positions. Null if there are none; the reason is logged.
  std::unique_ptr<mixture_contact::Tie> build() const;
  /// Logs the tied nodes and the exchanged effects.
  void say_what_is_tied(const mixture_contact::Tie& tie) const;
  /// Logs a warning if the facets are too long for the cohesive zone.
  void judge_cohesive_zone(const mixture_contact::Tie& tie) const;
  /// The positions of the primary nodes after their gaps have been closed.
  mixture_contact::Matrix3Xd relocated(const mixture_contact::Tie& tie) const;
  /// Sets penalties and tolerances to their present values, and reads materials again if penalties depend on them.
  /// Returns true if all values are valid; invalid ones are logged.
  bool update(mixture_contact::Tie& tie) const;
  /// The core's settings at the present time.
  mixture_contact::Settings settings() const;
  /// The law by which the tie breaks in the present step.
  mixture_contact::BreakingLaw breaking() const;

 private:
  FEModel& fem() const { return dofs_.fem(); }
  ContactSurfaces& surfaces() const { return dofs_.surfaces(); }
  std::optional<FacetMaterials> materials() const;
  /// True if bonds soften with their penalties, and nothing else excludes breaking.
  bool can_break(const mixture_contact::Tie& tie) const;
  std::optional<mixture_contact::Effects> effects(const FacetMaterials& materials) const;
  mixture_contact::PerSide<mixture_contact::SurfaceMesh> meshes(const FacetMaterials& materials,
                                                                const mixture_contact::Effects& effects) const;

  DofMap& dofs_;
  const TieParameters& parameters_;
  const ContactLog& log_;
};
