#include "enforcement/friction_penalty.h"

#include <utility>

namespace mixture_contact {
namespace {

/// Rows of four nodes. Twelve rows fill the registers of a processor completely, unlike three.
using FourNodes = Eigen::Matrix<double, 12, 1>;

/// A vector over the rows of a patch in pieces of four nodes.
IndexedVector<FourNodes> by_four_nodes(const VectorXd& values) {
  IndexedVector<FourNodes> rows;
  rows.reserve(indexing::entries(values.size() / 12));
  for (Index first = 0; first + 12 <= values.size(); first += 12) rows.emplace_back(values.segment<12>(first));
  return rows;
}

/// The derivative of the virtual work of traction and friction at the nodes of a patch, when both vary.
MatrixXd work_of_both(const VectorXd& traction_work, const VectorXd& d_traction, const VectorXd& friction_work,
                      const Matrix3Xd& d_friction) {
  const IndexedVector<FourNodes> traction = by_four_nodes(traction_work);
  const IndexedVector<FourNodes> friction = by_four_nodes(friction_work.transpose().replicate<3, 1>().reshaped());
  MatrixXd work(traction_work.size(), d_friction.cols());
  for (Index c = 0; c < work.cols(); ++c) {
    const double change = d_traction[c];
    const Vector3d of_node = d_friction.col(c);
    const FourNodes of_four = of_node.replicate<4, 1>();
    for (Index k = 0; k < traction.count(); ++k)
      work.col(c).segment<12>(12 * k) = traction[k] * change + friction[k].cwiseProduct(of_four);
    for (Index n = 4 * traction.count(); n < friction_work.size(); ++n)
      work.col(c).segment<3>(3 * n) = traction_work.segment<3>(3 * n) * change + friction_work[n] * of_node;
  }
  return work;
}

/// The derivative dt_T/du of a sliding node at constant pressures.
Matrix3Xd slip_variation(const NodalLaws& laws, Index node, const NodeLinearisation& linear, const NodalLoads& loads) {
  const FrictionTraction law = friction_law(loads, node);
  const FrictionBound bound = friction_bound(laws, loads, node);
  const SlipLinearisation& friction = linear.friction;
  Eigen::RowVectorXd d_bound = bound.d_traction * laws.traction_penalty(node) * linear.gap_variation.transpose();
  if (friction.has_fluid()) d_bound += bound.d_pressure * friction.pressure_variation.transpose();
  return law.d_trial.lazyProduct(friction.trial_variation) + law.d_bound.lazyProduct(d_bound);
}

/// Adds the variation of a sliding node's friction with respect to the fluid pressures.
void add_pressure_block(const PassNodes& at, Index node, const NodeLinearisation& linear, const NodalLoads& loads,
                        std::vector<TangentBlock>& blocks) {
  const SlipLinearisation& friction = linear.friction;
  if (!friction.has_fluid() || at.space.symmetric()) return;
  const double d_pressure = friction_bound(at.laws, loads, node).d_pressure;
  if (d_pressure == 0) return;
  const Patch columns = linear.patch.of_field(friction.pressure_field, false);
  MatrixXd by_pressure(linear.traction_work.size(), friction.work.size());
  const Vector3d per_pressure = d_pressure * friction_law(loads, node).d_bound;
  for (Index n = 0; n < friction.work.size(); ++n)
    by_pressure.middleRows<3>(3 * n) = friction.work[n] * per_pressure * friction.pressure_weights.transpose();
  blocks.push_back({linear.patch.of_displacements(), columns, std::move(by_pressure)});
}

}  // namespace

std::unique_ptr<EnforcementMethod> penalty_method(FrictionKind friction) {
  return by_friction<std::unique_ptr<EnforcementMethod>>(
      friction, [] { return std::make_unique<PenaltyMethod>(); }, [] { return std::make_unique<FrictionPenalty>(); });
}

void FrictionPenalty::add_traction_tangent(const PassNodes& at, Index node, const NodeLinearisation& linear,
                                           const NodalLoads& loads, ScopedTimer& laps, NodeTangent& tangent) const {
  if (!loads.in_contact[node]) return PenaltyMethod::add_traction_tangent(at, node, linear, loads, laps, tangent);
  const VectorXd work = at.laws.traction_penalty(node) * linear.traction_work;
  const bool slips = loads.slips[node];
  const Matrix3Xd sliding = slips ? slip_variation(at.laws, node, linear, loads) : Matrix3Xd();
  if (slips) add_pressure_block(at, node, linear, loads, tangent.blocks);
  laps.friction();
  MatrixXd both = work_of_both(work, linear.gap_variation, linear.friction.work,
                               slips ? sliding : linear.friction.trial_variation);
  tangent.blocks.push_back(traction_block(at.space, linear.patch, std::move(both)));
}

}  // namespace mixture_contact
