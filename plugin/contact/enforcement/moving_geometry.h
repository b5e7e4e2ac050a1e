/// Surfaces that move: status and linearised gaps hold during a Newton iteration, and the loads change the geometry.
#pragma once

#include "enforcement/contact_geometry.h"
#include "enforcement/virtual_work.h"

#include <functional>
#include <optional>

namespace mixture_contact {

class MovingGeometry : public ContactGeometry {
 public:
  /// Keeps references.
  MovingGeometry(MortarSpace& space, const NodalLaws& laws, ActiveSet& active_set, const EnforcementMethod& method)
      : space_(space), laws_(laws), active_set_(active_set), method_(method) {}

  void update(const FacingPositions& x) override;
  bool begin_iteration(const FacingFields& fields, double ahead) override;
  void hold_loads(const FacingFields& fields) override;
  void relinearise(const FacingFields& fields) override;
  void start_inactive(const FacingFields& fields) override;
  void take_multipliers() override { augmented_ = true; }
  void end_iterations() override;
  bool keeps_linearisation(const FacingFields& fields) const override;
  bool correct(const FacingFields& fields) override;
  void let_release(bool may_release) override { may_release_ = may_release; }
  IndexedVector<int> released() const override;
  bool is_solution(const FacingFields& fields) const override;

  NodalLoads loads(const FacingFields& fields) const override;
  NodeFlags flux_coupled() const override;
  void residual(const FacingFields& fields, double dt, const AddVector& add) const override;
  bool residual_change(const FacingFields& fields, double dt, const AddVector& add) const override;
  void residual_correction(double dt, const AddVector& add) const override;
  void tangent(const FacingFields& fields, double dt, const TangentParts& add) const override;
  void for_each_coupling(const Couplings& use) const override;
  std::size_t memory() const override;

 private:
  using GeometricPart = IndexedVector<std::optional<GeometricTangent>>;
  /// Decides about friction from the loads at a state.
  using DecideFriction = std::function<FrictionStatus(const NodalLoads& now)>;
  /// What an iteration holds but for its linearisation and the loads of the geometric part.
  LinearisationPoint evaluated_at(const FacingFields& fields, NodalLoads averages, const DecideFriction& decide,
                                  const NodalLoads* predicted) const;
  /// Finds the points of an iteration that begins, and their weights. Returns whether there are more than before.
  bool find_points(const FacingPositions& x);
  /// Linearises, and holds what an iteration does.
  void hold(LinearisationPoint point, const FacingFields& fields);
  /// The geometric part of the tangent where it is held for these positions.
  const GeometricPart* geometric_at(const FacingPositions& x) const;
  IndexedVector<NodeLinearisation> linearised(const NodalLoads& loads, const FacingFields& fields) const;
  FrictionStatus initial_friction(const NodalLoads& now) const {
    return {active_set_.initial_slip(now), active_set_.initial_rubs(now)};
  }
  /// Averages of a state with the status that iterations begin with there.
  NodalLoads initial_averages(const FacingFields& fields) const;
  NodeFlags initial_status() const { return active_set_.initial(space_.gaps()); }
  /// Status of an iteration that begins at the present loads and gaps (see ContactPass::begin_iteration()).
  NodeFlags beginning_status(const NodalLoads& now, const NodalGaps& gaps, double ahead) const;
  /// Status that the present loads and gaps ask for.
  NodeFlags updated_status(const NodalLoads& now, const NodalGaps& gaps) const;
  VectorXd equation_weights(const NodalLoads& loads, const Matrix3Xd& x1) const;
  /// Whether loads are linear in gaps and jumps, so that these alone can be corrected: not where friction turns.
  bool is_correctable() const;
  /// Whether this status differs from that of the linearisation by nodes that may be released.
  bool may_take(const NodeFlags& status) const;
  /// What tractions are off by that an iteration predicts.
  static double doubt(const NodalLoads& predicted, const NodalLoads& now);
  /// Loads of the true averages, with the status that is held.
  NodalLoads true_loads(NodalGaps gaps, const FacingFields& fields) const;
  /// Multipliers of friction, carried along with the surface since the step began.
  Matrix3Xd present_multipliers(const NodalFriction& friction) const;
  /// Whether loads differ by more than a part of the largest one of their kind, and by more than rounding.
  bool differ(const NodalLoads& one, const NodalLoads& other, double part, const FacingFields& fields) const;

  MortarSpace& space_;
  const NodalLaws& laws_;
  ActiveSet& active_set_;
  const EnforcementMethod& method_;
  std::optional<LinearisationPoint> point_;  ///< of the iteration, if one has begun, or of the loads that are held
  /// The geometric part of the tangent there, per pair of facets, in a time increment of 1; until the surfaces move.
  std::optional<GeometricPart> geometric_;
  /// Of the loads as the iteration began; none where there were no others at the same points.
  std::optional<NodalLoads> load_change_;
  bool may_release_ = false;  ///< whether the host can take loads out of the matrix that it has of this linearisation
  double last_doubt_ = 0;     ///< what predicted tractions were off by at the last correct(); 0 before any
  std::optional<NodalLoads> correction_;  ///< of the loads with the linearisation that is held, by the last correct()
  bool augmented_ = false;                ///< since the last iteration began
};

}  // namespace mixture_contact
