/// Multipliers as unknowns of the Newton solve.
#pragma once

#include "conditions/multiplier.h"
#include "enforcement/enforcement_method.h"

namespace mixture_contact {

/// Loads are the multipliers. Each has an equation: gap or jump = 0, or a membrane's law, in contact, mu = 0 elsewhere
/// (conditions/multiplier.h), with weights that give the equation the units of the residual of its field, and the
/// tangent similar rows and columns.
class UnknownMultipliers : public EnforcementMethod {
 public:
  using EnforcementMethod::EnforcementMethod;

  void load(NodalLoads& loads) const override { laws().load(loads, false); }
  NodalLoads predicted_loads(const LinearisationPoint& point, const FacingFields& fields) const override;
  bool predicts() const override { return false; }
  VectorXd equation_weights(const NodalLoads& loads, const Matrix3Xd& x1) const override;
  /// Each node with its multipliers alone: loads are unknowns, independent of displacements and fields.
  void for_each_coupling(const Patch& patch, const UsePatch& use) const override;
  void equations(const NodalLoads& loads, const VectorXd& weights, double dt, const AddVector& add) const override;
  bool has_load_blocks() const override { return false; }
  NodeTangent node_tangent(Index node, const NodeLinearisation& linear, const NodalLoads& loads,
                           const VectorXd& weights, double dt) const override;

 private:
  ConditionValue traction_condition(Index node, const NodalLoads& loads) const;
  ConditionValue flux_condition(int field, Index node, const NodalLoads& loads) const;
  /// The term in place of the gap in the equation of a field: the jump of a continuous field, or the flux of a law.
  FluxLaw driving(int field, Index node, const NodalLoads& loads) const;
  // Blocks of the multipliers alone, and of each node with them
  void add_traction_tangent(Index node, const NodeLinearisation& linear, const NodalLoads& loads,
                            const VectorXd& weights, std::vector<TangentBlock>& blocks) const;
  void add_flux_tangent(int field, Index node, const NodeLinearisation& linear, const NodalLoads& loads,
                        const VectorXd& weights, double dt, std::vector<TangentBlock>& blocks) const;
};

/// The order of the unknowns of a surface.
MultiplierLayout multiplier_layout(const NodalLaws& laws);
/// The unknowns mu = lambda/k in that order [mm, and the units of the fields], with k the stiffness or conductance of
/// the adjoining elements.
VectorXd scaled_multipliers(const NodalLaws& laws);
void set_scaled_multipliers(NodalLaws& laws, const VectorXd& mu);

}  // namespace mixture_contact
