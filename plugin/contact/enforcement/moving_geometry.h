/// Evaluation of a pass whose surfaces move. Contact status and linearised gaps are constant during a Newton iteration.
#pragma once

#include "enforcement/contact_geometry.h"
#include "enforcement/held_linearisation.h"
#include "enforcement/past_linearisation.h"

#include <optional>

namespace mixture_contact {

/// The evaluation of a pass whose surfaces move.
class MovingGeometry : public ContactGeometry {
 public:
  /// Keeps a reference to the parts.
  explicit MovingGeometry(PassParts& parts) : parts_(parts), held_(parts) {}

  /// Begins a Newton iteration at a state: decides which nodes are in contact (see ActiveSet), and linearises their
  /// gaps and jumps. Both are kept until the next call: in the iteration and its line search, loads are linear in the
  /// unknowns and no status changes. `other_holds`: whether nodes of the other surface may hold the bodies at the start
  /// of a step.
  ///
  /// Returns true if the loads at this state differ from those before the call.
  bool begin_iteration(const FacingFields& fields, bool other_holds);
  /// Begins at a state without a tangent, as in explicit dynamics: decides which nodes are in contact by the true laws,
  /// and keeps the loads of this state for residuals.
  void hold_loads(const FacingFields& fields);
  /// Moves the linearisation point of an iteration to another state, for which project() has been called. Gaps and
  /// jumps are measured and linearised there; status and predicted loads stay the same. Nodes that face nothing in the
  /// new state open, and nodes that overlap in it close.
  void linearise_at(const FacingFields& fields);
  /// Begins an iteration with all nodes open, when a second pass is added within a step.
  void start_inactive(const FacingFields& fields);
  /// Discards all data of past iterations, such that later ones depend on the state only.
  void forget_past();
  /// Lets edge nodes of a solution be decided again (see ActiveSet::reconsiders_edge()). Returns true if the solution
  /// has such nodes.
  bool reconsiders_edge(const FacingFields& fields);
  /// True if the linearised loads of a state agree with those of the true laws within a fraction. A state found with
  /// constant status and linearised gaps is a solution only then.
  bool is_solution(const FacingFields& fields) const;
  /// The linearisation of the iterations.
  HeldLinearisation& held() { return held_; }

  void update(const FacingPositions& x) override;
  void take_multipliers() override { augmented_ = true; }
  void end_iterations() override;
  MovingGeometry* moving() override { return this; }
  NodalLoads loads(const FacingFields& fields) const override;
  NodeFlags flux_coupled() const override;
  void residual(const FacingFields& fields, double dt, const AddVector& add) const override;
  void tangent(const FacingFields& fields, double dt, const TangentParts& add) const override;
  void for_each_coupling(const Couplings& use) const override;
  std::size_t memory() const override;

 private:
  /// The linearisation point of an iteration, still without the linearisation of averages and the loads of the
  /// geometric part. `predicted`: loads that the previous iteration predicts at this state; null if there is none.
  LinearisationPoint evaluated_at(const FacingFields& fields, NodalLoads averages, const DecideFriction& decide,
                                  const NodalLoads* predicted) const;
  /// Finds the integration points of a new iteration and their weights. Returns true if other pairs were found.
  bool find_points(const FacingPositions& x);
  /// Removes the linearisation, but keeps it for reuse by the next iterations.
  void let_go();
  /// Linearises at a point, and keeps the result for an iteration.
  void hold(LinearisationPoint point, const FacingFields& fields);
  /// The geometric part of the tangent if it was computed at these positions; else null.
  const GeometricPart* geometric_at(const FacingPositions& x) const;
  /// The averages at a state, with the status with which iterations begin.
  NodalLoads initial_averages(const FacingFields& fields) const;
  /// The contact status with which an iteration begins (see begin_iteration()). `now`: present loads.
  NodeFlags beginning_status(const NodalLoads& now, const NodalGaps& gaps, bool other_holds) const;
  /// Sets the loads in the geometric part of the tangent for an iteration. `before`: loads before its start.
  void set_geometric_loads(LinearisationPoint& next, const NodalLoads& before);
  /// Calls `use` with the couplings of pairs in contact that those of nodes do not include.
  void use_pairs(const NodeFlags& in_contact, const Couplings& use) const;
  /// The contact status by the present loads and gaps.
  NodeFlags updated_status(const NodalLoads& now, const NodalGaps& gaps) const;
  VectorXd equation_weights(const NodalLoads& loads, const Matrix3Xd& x1) const;

  PassParts& parts_;
  /// Linearisation point of the present iteration, or of held loads; empty if there is none.
  std::optional<LinearisationPoint> point_;
  std::optional<GeometricPart> geometric_;  ///< geometric part at `point_`; empty after the surfaces have moved
  LastLinearisation last_;                  ///< the last point and geometric part, for reuse
  HeldLinearisation held_;                  ///< corrected loads of the linearisation at `point_`
  bool augmented_ = false;  ///< true if the multipliers have been augmented since the start of the last iteration
};

}  // namespace mixture_contact
