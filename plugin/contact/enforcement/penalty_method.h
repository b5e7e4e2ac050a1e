/// Enforcement by penalties, with multipliers that only augmentations change.
#pragma once

#include "enforcement/enforcement_method.h"

namespace mixture_contact {

/// The load of a node is lambda + eps times gap or jump, linearised within an iteration. The gap that a linear solve
/// leaves has a second-order error, which a large penalty would turn into a large error of the load. The predicted load
/// does not contain this error, and is suitable for deciding contact and for the geometric stiffness (mixed integration
/// points, Magisano, Leonetti and Garcea 2017).
class PenaltyMethod : public EnforcementMethod {
 public:
  void load(const NodalLaws& laws, NodalLoads& loads) const override { laws.load(loads, true); }
  NodalLoads predicted_loads(const PassNodes& at, const LinearisationPoint& point,
                             const FacingFields& fields) const override;
  bool predicts() const override { return true; }
  bool is_linear() const override { return true; }
  void for_each_coupling(const Patch& patch, const UsePatch& use) const override { use(patch); }
  bool has_load_blocks() const override { return true; }
  NodeTangent node_tangent(const PassNodes& at, Index node, const NodeLinearisation& linear, const NodalLoads& loads,
                           const VectorXd& weights, double dt) const override;

 protected:
  /// Adds the tangent of the traction of a node.
  virtual void add_traction_tangent(const PassNodes& at, Index node, const NodeLinearisation& linear,
                                    const NodalLoads& loads, ScopedTimer& laps, NodeTangent& tangent) const;
};

}  // namespace mixture_contact
