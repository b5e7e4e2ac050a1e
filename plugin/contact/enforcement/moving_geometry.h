/// Surfaces that move: status and linearised gaps hold during a Newton iteration, and the loads change the geometry.
#pragma once

#include "enforcement/contact_geometry.h"
#include "enforcement/held_linearisation.h"
#include "enforcement/past_linearisation.h"

#include <functional>
#include <optional>

namespace mixture_contact {

class MovingGeometry : public ContactGeometry {
 public:
  /// Keeps references.
  MovingGeometry(MortarSpace& space, const NodalLaws& laws, ActiveSet& active_set, const EnforcementMethod& method)
      : space_(space), laws_(laws), active_set_(active_set), method_(method), held_(space, laws, active_set, method) {}

  void update(const FacingPositions& x) override;
  bool begin_iteration(const FacingFields& fields) override;
  void hold_loads(const FacingFields& fields) override;
  void relinearise(const FacingFields& fields) override;
  void start_inactive(const FacingFields& fields) override;
  void take_multipliers() override { augmented_ = true; }
  void end_iterations() override;
  void forget_past() override;
  bool reconsiders_edge(const FacingFields& fields) override;
  bool is_solution(const FacingFields& fields) const override;
  HeldLinearisation* held() override { return &held_; }

  NodalLoads loads(const FacingFields& fields) const override;
  NodeFlags flux_coupled() const override;
  void residual(const FacingFields& fields, double dt, const AddVector& add) const override;
  void tangent(const FacingFields& fields, double dt, const TangentParts& add) const override;
  void for_each_coupling(const Couplings& use) const override;
  std::size_t memory() const override;

 private:
  /// Decides stick and slip from the loads at a state.
  using DecideFriction = std::function<FrictionStatus(const NodalLoads& now)>;
  /// The state of an iteration without its linearisation and the loads of the geometric part.
  LinearisationPoint evaluated_at(const FacingFields& fields, NodalLoads averages, const DecideFriction& decide,
                                  const NodalLoads* predicted) const;
  /// Finds the points of an iteration that begins, and their weights. Returns whether there are more than before.
  bool find_points(const FacingPositions& x);
  /// Drops the linearisation; the next iterations may reuse it.
  void let_go();
  /// Linearises at a state, and holds the result for an iteration.
  void hold(LinearisationPoint point, const FacingFields& fields);
  /// The held geometric part of the tangent for these positions; null if there is none.
  const GeometricPart* geometric_at(const FacingPositions& x) const;
  IndexedVector<NodeLinearisation> linearised(const NodalLoads& loads, const FacingFields& fields) const;
  FrictionStatus initial_friction(const NodalLoads& now) const {
    return {active_set_.initial_slip(now), active_set_.initial_rubs(now)};
  }
  /// Averages of a state with the status that iterations begin with there.
  NodalLoads initial_averages(const FacingFields& fields) const;
  /// Status of an iteration that begins at the present loads and gaps (see ContactPass::begin_iteration()).
  NodeFlags beginning_status(const NodalLoads& now, const NodalGaps& gaps) const;
  /// Status by the present loads and gaps.
  NodeFlags updated_status(const NodalLoads& now, const NodalGaps& gaps) const;
  VectorXd equation_weights(const NodalLoads& loads, const Matrix3Xd& x1) const;
  /// Multipliers of friction, convected with the surface since the start of the step.
  Matrix3Xd present_multipliers(const NodalFriction& friction) const;

  MortarSpace& space_;
  const NodalLaws& laws_;
  ActiveSet& active_set_;
  const EnforcementMethod& method_;
  std::optional<LinearisationPoint> point_;  ///< of the iteration, if one has begun, or of the loads that are held
  std::optional<GeometricPart> geometric_;   ///< at the point, until the surfaces move
  LastLinearisation last_;                   ///< after these two have been dropped
  HeldLinearisation held_;                   ///< at the point
  bool augmented_ = false;                   ///< since the start of the last iteration
};

}  // namespace mixture_contact
