#include "interface/output.h"

#include "interface/friction_rows.h"

namespace mixture_contact {
namespace {

/// The area in contact of each node of a side, from the areas `first` and `second` in both passes. Two full passes
/// cover the same area, each with its own integration errors. A restricted pass covers the area that the first one
/// leaves, and its edge.
VectorXd tributary_area_of(const VectorXd& first, const VectorXd& second, bool two_pass) {
  if (!two_pass) return first.cwiseMax(second);
  const auto both = first.array() > 0 && second.array() > 0;
  return both.select(0.5 * (first + second), first + second);
}

/// The output of one pass.
struct PassOutput {
  std::unique_ptr<OutputRows> rows;
  OutputSums sums;
};

/// The sums of all passes for one surface.
struct SideSums {
  MatrixXd values;  ///< sums per node, with the signs of this surface
  VectorXd tributary_area;
};

SideSums sums_of_side(const ContactInterface& contact, Side side, const std::vector<PassOutput>& passes) {
  const Index first = passes.front().rows->turning();
  const Index turned = passes.front().rows->count() - first;
  SideSums sums{MatrixXd::Zero(first + turned, contact.mesh(side).nodes), {}};
  std::vector<VectorXd> areas;
  for (std::size_t pass = 0; pass < passes.size(); ++pass) {
    const bool is_integrated = both_sides.at(pass) == side;
    const MatrixXd& of_pass = is_integrated ? passes[pass].sums.integrated : passes[pass].sums.facing;
    areas.emplace_back(of_pass.row(OutputRows::area));
    sums.values.topRows(first) += of_pass.topRows(first);
    sums.values.bottomRows(turned) += (is_integrated ? 1.0 : -1.0) * of_pass.bottomRows(turned);
  }
  sums.tributary_area = tributary_area_of(areas.front(), areas.back(), contact.settings().two_pass);
  return sums;
}

/// Divides the sums by their areas. Gaps are distances of the surfaces, whatever the offset. If passes cover the same
/// area, each bears a part of the load.
NodalOutput divided(const SideSums& sums, const OutputRows& rows, double offset) {
  const MatrixXd& values = sums.values;
  const VectorXd areas = values.row(OutputRows::area);
  const VectorXd mean = inverse_or_zero(areas);
  const VectorXd per_area = inverse_or_zero(sums.tributary_area);
  NodalOutput out;
  out.gap = (areas.array() > 0).select(mean.array() * values.row(OutputRows::gap).transpose().array() - offset, 0.0);
  out.pressure = per_area.cwiseProduct(values.row(OutputRows::pressure).transpose());
  out.flux = values.middleRows(rows.flux(), rows.fields()) * per_area.asDiagonal();
  out.jump = values.middleRows(rows.jump(), rows.fields()) * mean.asDiagonal();
  out.tributary_area = sums.tributary_area;
  out.friction = rows.friction(values, per_area);
  return out;
}

}  // namespace

InterfaceOutput output(const ContactInterface& contact, const PerSide<SurfaceFields>& fields) {
  const TaskClock timed = contact.measurements().clock(Task::output);
  InterfaceOutput out;
  std::vector<PassOutput> passes;
  for (std::size_t number = 0; number < contact.passes(); ++number) {
    const ContactPass& pass = contact.pass(number);
    const FacingFields facing = seen_from(both_sides.at(number), fields);
    const NodalLoads loads = pass.nodal_loads(facing);
    std::unique_ptr<OutputRows> rows = output_rows(pass.laws(), loads);
    OutputSums sums = sums_of(pass.space(), loads, *rows, facing);
    out.balance.force += (number == 0 ? 1.0 : -1.0) * sums.force;
    out.balance.dissipation += rows->dissipation();
    passes.push_back({std::move(rows), std::move(sums)});
  }
  const OutputRows& rows = *passes.front().rows;
  for (const Side side : both_sides) {
    const SideSums sums = sums_of_side(contact, side, passes);
    out.nodes[side] = divided(sums, rows, contact.pass(0).space().offset());
    if (side == Side::primary) {
      out.balance.flow = sums.values.middleRows(rows.flux(), rows.fields()).rowwise().sum();
      out.balance.friction = rows.friction_force(sums.values);
      out.balance.area = sums.tributary_area.sum();
    }
  }
  for (std::size_t number = 0; number < passes.size(); ++number)
    passes[number].rows->take_status(out.nodes[both_sides.at(number)].friction);
  out.balance.force += out.balance.friction;
  return out;
}

}  // namespace mixture_contact
