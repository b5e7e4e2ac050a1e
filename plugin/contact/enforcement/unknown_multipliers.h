/// Enforcement by multipliers that are unknowns of the Newton solve.
#pragma once

#include "conditions/multiplier.h"
#include "enforcement/enforcement_method.h"

namespace mixture_contact {

/// The loads are the multipliers. The equation of a multiplier is gap or jump = 0, or a membrane's law, in contact, and
/// mu = 0 elsewhere (conditions/multiplier.h). Weights give the equation the unit of the residual of its field, and the
/// rows and columns of the tangent a similar size.
class UnknownMultipliers : public EnforcementMethod {
 public:
  void load(const NodalLaws& laws, NodalLoads& loads) const override { laws.load(loads, false); }
  NodalLoads predicted_loads(const PassNodes& at, const LinearisationPoint& point,
                             const FacingFields& fields) const override;
  bool predicts() const override { return false; }
  bool is_linear() const override { return false; }
  VectorXd equation_weights(const PassNodes& at, const NodalLoads& loads, const Matrix3Xd& x1) const override;
  /// Couples each node with its own multipliers only, because loads are unknowns that do not depend on displacements
  /// and fields.
  void for_each_coupling(const Patch& patch, const UsePatch& use) const override;
  void equations(const PassNodes& at, const NodalLoads& loads, const VectorXd& weights, double dt,
                 const AddVector& add) const override;
  bool has_load_blocks() const override { return false; }
  NodeTangent node_tangent(const PassNodes& at, Index node, const NodeLinearisation& linear, const NodalLoads& loads,
                           const VectorXd& weights, double dt) const override;
};

/// The order of the unknown multipliers of a surface.
MultiplierLayout multiplier_layout(const NodalLaws& laws);
/// The unknowns mu = lambda/k in the order of multiplier_layout() [mm, or unit of the field], where k is the stiffness
/// or conductance of the adjoining elements.
VectorXd scaled_multipliers(const NodalLaws& laws);
/// Sets the multipliers from unknowns mu in the order of multiplier_layout().
void set_scaled_multipliers(NodalLaws& laws, const VectorXd& mu);

}  // namespace mixture_contact
