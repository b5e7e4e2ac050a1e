/// Penalties, with multipliers that only augmentations change.
#pragma once

#include "enforcement/enforcement_method.h"

namespace mixture_contact {

/// Loads are lambda + eps times gap or jump, linearised within an iteration: the load predicted by the linear solve is
/// not multiplied by the second-order error of the gap times a large penalty, which would make it useless as a measure
/// of contact and as a geometric stiffness (mixed integration points, Magisano, Leonetti and Garcea 2017).
class PenaltyMethod : public EnforcementMethod {
 public:
  using EnforcementMethod::EnforcementMethod;

  void load(NodalLoads& loads) const override { laws().load(loads, true); }
  NodalLoads predicted_loads(const LinearisationPoint& point, const FacingFields& fields) const override;
  bool predicts() const override { return true; }
  VectorXd equation_weights(const NodalLoads& /*loads*/, const Matrix3Xd& /*x1*/) const override { return {}; }
  void for_each_coupling(const Patch& patch, const UsePatch& use) const override { use(patch); }
  void equations(const NodalLoads& /*loads*/, const VectorXd& /*weights*/, double /*dt*/,
                 const AddVector& /*add*/) const override {}
  /// Friction is no scalar, and the symmetric part of a product is none.
  bool has_load_blocks() const override { return !effects().may_rub() && !space().symmetric(); }
  NodeTangent node_tangent(Index node, const NodeLinearisation& linear, const NodalLoads& loads,
                           const VectorXd& weights, double dt) const override;

 private:
  void add_traction_tangent(Index node, const NodeLinearisation& linear, const NodalLoads& loads, ScopedTimer& laps,
                            NodeTangent& tangent) const;
  LoadBlock flux_tangent(int field, Index node, const NodeLinearisation& linear, const NodalLoads& loads,
                         double dt) const;
  /// dt_T/du of a node that slides, at fixed pressures.
  Matrix3Xd slip_variation(Index node, const NodeLinearisation& linear, const NodalLoads& loads) const;
  /// Adds the variation of its friction with the pressures of the fluid.
  void add_pressure_block(Index node, const NodeLinearisation& linear, const NodalLoads& loads,
                          std::vector<TangentBlock>& blocks) const;
};

}  // namespace mixture_contact
