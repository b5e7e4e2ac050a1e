/// Setup of a contact: parameters, surfaces and materials of the model as the core takes them, and their faults.
#pragma once

#include "ambient_concentration.h"
#include "bound_contact.h"
#include "host/facet_material.h"
#include "host/penalty_reduction.h"

#include <optional>
#include <string>
#include <vector>

using AmbientConcentrations = std::vector<FEMixtureAmbientConcentration*>;

/// The kind of the present step's solver.
SolverKind solver_kind_of(FEModel& fem);
/// The time step in which elements store solvent [s]; 0 in a steady state.
double storing_time_step(FEModel& fem);
/// Whether the solvers of all steps can have multipliers of nodes as unknowns; the log gives the reason if not.
bool can_solve_for_multipliers(FEModel& fem, const DofMap& dofs, const ContactLog& log);

class ContactSetup {
 public:
  ContactSetup(FEModel& fem, ContactSurfaces& surfaces, DofMap& dofs, const ContactParameters& parameters,
               const AmbientConcentrations& ambient, const ContactLog& log)
      : fem_(fem), surfaces_(surfaces), dofs_(dofs), parameters_(parameters), ambient_(ambient), log_(log) {}

  // Each function logs the faults, and returns whether there are none.
  bool check_parameters() const;
  bool check_surfaces() const;
  bool check_ambient() const;
  bool check_mesh_adaptors() const;

  /// Makes the core from the materials. Returns false, and logs the reason, if that is impossible.
  bool build(BoundContact& contact);
  /// Reads the materials again, for automatic penalties.
  void update_properties(const BoundContact& contact) const;
  /// Sets penalties and tolerances by their load curves at this time; `reduction` reduces automatic penalties of the
  /// traction.
  void update_laws(const BoundContact& contact, const mixture_contact::ReducedPenalty& reduction) const;
  /// Updates the laws by load curves, see update_laws(), where all values make sense. Returns whether they do; the log
  /// says which do not.
  bool follow_load_curves(const BoundContact& contact, const mixture_contact::ReducedPenalty& reduction) const;
  /// Whether a reduction changes any penalty.
  bool has_reducible_penalty() const;
  /// Switches traction off where nothing can move in the present step of the analysis. Returns whether the requested
  /// effects exist in this step.
  bool decide_traction(const BoundContact& contact);

 private:
  bool has_sound_values() const;
  bool have_no_inner_facets() const;
  /// The materials behind the facets, with a stiffness for rigid bodies that face rigid bodies alone.
  std::optional<FacetMaterials> materials() const;
  void say_stand_in() const;
  std::vector<FieldAtContact> fields_of_model(const FacetMaterials& materials) const;
  FrictionRequest friction_of_model(const FacetMaterials& materials) const;
  std::optional<mixture_contact::Effects> effects(const FacetMaterials& materials);
  /// Whether an automatic penalty finds no element that it could be measured by.
  bool lacks_stiffness(const FacetMaterials& materials) const;
  bool has_penalty(const BoundContact& contact) const;
  bool can_have_multipliers(const BoundContact& contact) const;
  Motion motion() const;
  /// The kind of the present step's solver, for the traction penalty.
  SolverKind solver_kind() const;

  FEModel& fem_;
  ContactSurfaces& surfaces_;
  DofMap& dofs_;
  const ContactParameters& parameters_;
  const AmbientConcentrations& ambient_;
  const ContactLog& log_;
  std::vector<FieldAtContact> fields_at_contact_;  ///< fields that the materials on both sides allow
  FrictionRequest friction_;                       ///< friction by parameters and materials
  std::string summary_;                            ///< the last line of the log on the effects
};
