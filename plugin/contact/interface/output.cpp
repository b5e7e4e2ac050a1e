#include "interface/output.h"

#include "interface/output_sums.h"

namespace mixture_contact {
namespace {

VectorXd inverse_or_zero(const VectorXd& values) { return (values.array() > 0).select(values.array().inverse(), 0.0); }

/// The area in contact of each node of a side, from the areas `first` and `second` in both passes. Two full passes
/// cover the same area, each with its own integration errors. A restricted pass covers the area that the first one
/// leaves, and its edge.
VectorXd tributary_area_of(const VectorXd& first, const VectorXd& second, bool two_pass) {
  if (!two_pass) return first.cwiseMax(second);
  const auto both = first.array() > 0 && second.array() > 0;
  return both.select(0.5 * (first + second), first + second);
}

/// The friction status of nodes from facing points: a node slides if more than half of its area in contact does.
/// `slips`: sliding area; `areas`: area in contact.
VectorXd status_of(const VectorXd& slips, const VectorXd& areas) {
  VectorXd status(areas.size());
  for (Index node = 0; node < areas.size(); ++node) {
    const Sliding sliding = slips[node] > 0.5 * areas[node] ? Sliding::slips : Sliding::sticks;
    status[node] = static_cast<double>(areas[node] > 0 ? sliding : Sliding::open);
  }
  return status;
}

/// Sets the status of nodes of the primary surface of a pass, which have a friction status of their own.
void take_status(const SlidingNodes& nodes, FrictionOutput& out) {
  for (Index node = 0; node < out.status.size(); ++node) {
    if (nodes.in_contact[node] == 0) continue;
    out.status[node] = static_cast<double>(nodes.slips[node] > 0 ? Sliding::slips : Sliding::sticks);
  }
}

/// The sums of all passes for one surface.
class SideSums {
 public:
  SideSums(const ContactInterface& contact, Side side, const std::vector<OutputSums>& passes)
      : rows_(contact.effects()), sums_(MatrixXd::Zero(rows_.count(), contact.mesh(side).nodes)) {
    std::vector<VectorXd> areas;
    for (std::size_t pass = 0; pass < passes.size(); ++pass) {
      const bool is_integrated = both_sides.at(pass) == side;
      const MatrixXd& of_pass = is_integrated ? passes[pass].integrated : passes[pass].facing;
      areas.emplace_back(of_pass.row(OutputRows::area));
      sums_.topRows(rows_.turning()) += of_pass.topRows(rows_.turning());
      const Index turned = rows_.count() - rows_.turning();
      sums_.bottomRows(turned) += (is_integrated ? 1.0 : -1.0) * of_pass.bottomRows(turned);
    }
    tributary_area_ = tributary_area_of(areas.front(), areas.back(), contact.settings().two_pass);
  }

  VectorXd flow() const { return sums_.middleRows(rows_.flux(), rows_.fields()).rowwise().sum(); }
  Vector3d friction() const {
    return rows_.has_friction() ? Vector3d(sums_.middleRows<3>(rows_.traction()).rowwise().sum()) : Vector3d::Zero();
  }

  /// Divides the sums by their areas. Gaps are distances of the surfaces, whatever the offset. If passes cover the same
  /// area, each bears a part of the load.
  NodalOutput divided(double offset) const {
    const VectorXd areas = sums_.row(OutputRows::area);
    const VectorXd mean = inverse_or_zero(areas);
    const VectorXd per_area = inverse_or_zero(tributary_area_);
    NodalOutput out;
    out.gap = (areas.array() > 0).select(mean.array() * row(OutputRows::gap).array() - offset, 0.0);
    out.pressure = per_area.cwiseProduct(row(OutputRows::pressure));
    out.flux = sums_.middleRows(rows_.flux(), rows_.fields()) * per_area.asDiagonal();
    out.jump = sums_.middleRows(rows_.jump(), rows_.fields()) * mean.asDiagonal();
    out.tributary_area = tributary_area_;
    if (!rows_.has_friction()) return out;
    out.friction.traction = sums_.middleRows<3>(rows_.traction()) * per_area.asDiagonal();
    out.friction.slip = sums_.middleRows<3>(rows_.slip()) * mean.asDiagonal();
    out.friction.bound = per_area.cwiseProduct(row(OutputRows::bound));
    out.friction.fluid = mean.cwiseProduct(row(OutputRows::fluid));
    out.friction.status = status_of(row(OutputRows::slips), areas);
    return out;
  }

 private:
  VectorXd row(Index number) const { return sums_.row(number); }

  OutputRows rows_;
  MatrixXd sums_;  ///< sums per node, with the signs of this surface
  VectorXd tributary_area_;
};

}  // namespace

InterfaceOutput output(const ContactInterface& contact, const PerSide<SurfaceFields>& fields) {
  const TaskClock timed = contact.measurements().clock(Task::output);
  InterfaceOutput out;
  std::vector<OutputSums> passes;
  std::vector<SlidingNodes> sliding;
  for (std::size_t number = 0; number < contact.passes(); ++number) {
    const ContactPass& pass = contact.pass(number);
    const FacingFields facing = seen_from(both_sides.at(number), fields);
    const NodalLoads loads = pass.nodal_loads(facing);
    sliding.push_back(sliding_nodes(pass.laws(), loads));
    passes.push_back(sums_of({pass.space(), loads, sliding.back(), facing}));
    out.balance.force += (number == 0 ? 1.0 : -1.0) * passes.back().force;
    out.balance.dissipation += sliding.back().dissipation;
  }
  for (const Side side : both_sides) {
    const SideSums sums(contact, side, passes);
    out.nodes[side] = sums.divided(contact.pass(0).space().offset());
    if (side == Side::primary) {
      out.balance.flow = sums.flow();
      out.balance.friction = sums.friction();
      out.balance.area = out.nodes[side].tributary_area.sum();
    }
    const auto own = static_cast<std::size_t>(side);
    if (own < sliding.size() && !sliding[own].empty()) take_status(sliding[own], out.nodes[side].friction);
  }
  out.balance.force += out.balance.friction;
  return out;
}

}  // namespace mixture_contact
