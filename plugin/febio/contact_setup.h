/// Setup of a contact from an FEBio model: parameters, surfaces and materials in the form of the core, and checks of
/// them.
#pragma once

#include "ambient_concentration.h"
#include "bound_contact.h"
#include "host/facet_material.h"
#include "host/penalty_reduction.h"

#include <optional>
#include <string>
#include <vector>

/// True if the solvers of all steps accept nodal multipliers as unknowns; if false, the reason is logged.
bool can_solve_for_multipliers(FEModel& fem, const DofMap& dofs, const ContactLog& log);

/// Sets up a sliding contact.
class ContactSetup {
 public:
  /// Keeps a reference.
  explicit ContactSetup(BoundContact& contact) : contact_(contact) {}

  // The next functions log the faults that they find, and return true if there are none.
  bool check_parameters(const AmbientConcentrations& ambient) const;
  bool check_surfaces() const;
  bool check_ambient(const AmbientConcentrations& ambient) const;
  bool check_mesh_adaptors() const;

  /// Makes the core from the materials. If that is impossible, logs the reason and returns false.
  bool build();
  /// Reads the materials again, for automatic penalties.
  void update_properties() const;
  /// Finds the nodes that cannot move, once FEBio has numbered the equations of the present analysis step.
  void find_immovable_nodes() const;
  /// Sets penalties and tolerances to their values at the present time. `reduction`: reduction of automatic traction
  /// penalties.
  void update_laws(const mixture_contact::ReducedPenalty& reduction);
  /// Calls update_laws() if all values of load curves are valid. Otherwise it logs the invalid ones and returns false.
  bool follow_load_curves(const AmbientConcentrations& ambient, const mixture_contact::ReducedPenalty& reduction);
  /// True if reduced penalties have an effect on this contact.
  bool has_reducible_penalty() const;
  /// Disables the traction if no node can move in the present analysis step. Returns true if the requested effects
  /// exist in this step.
  bool decide_traction();

 private:
  const ContactParameters& parameters() const { return contact_.parameters(); }
  const DofMap& dofs() const { return contact_.dofs(); }
  FEModel& fem() const { return dofs().fem(); }
  const ContactLog& log() const { return contact_.log(); }
  ContactSurfaces& surfaces() const { return contact_.surfaces(); }

  bool has_sound_values() const;
  bool have_no_inner_facets() const;
  /// The materials behind the facets. Rigid bodies that face only rigid bodies get a substitute stiffness.
  std::optional<FacetMaterials> materials() const;
  void say_stand_in() const;
  std::vector<FieldAtContact> fields_of_model(const FacetMaterials& materials) const;
  mixture_contact::FrictionKind friction_of_model(const FacetMaterials& materials) const;
  std::optional<mixture_contact::Effects> effects(const FacetMaterials& materials);
  /// True if an automatic penalty has no element on whose stiffness it can be based.
  bool lacks_stiffness(const FacetMaterials& materials) const;
  bool has_penalty() const;
  bool can_have_multipliers() const;
  Motion motion() const;
  /// The kind of the present step's solver, for the traction penalty.
  SolverKind solver_kind();

  BoundContact& contact_;
  std::vector<FieldAtContact> fields_at_contact_;  ///< fields that the materials on both sides permit
  /// Friction by the parameters and materials.
  mixture_contact::FrictionKind friction_ = mixture_contact::FrictionKind::none;
  std::optional<double> crossing_;  ///< longest_crossing() of the materials [s]; not known until needed
  std::string summary_;             ///< last line in the log about the exchanged effects
};
