#include "interface/output.h"

#include <numeric>

namespace mixture_contact {
namespace {

/// Area of a point in contact, shared among the nodes of its facet on the surface that is integrated over, or on the
/// other [mm^2].
FacetVector area_of_nodes(const PointContact& contact, bool integrated) {
  const PointKinematics& point = contact.kinematics;
  const FacetVector shape = (integrated ? point.primary_shape : point.secondary_shape).cwiseAbs();
  return contact.loads.weight * point.area / shape.sum() * shape;
}

VectorXd inverse_or_zero(const VectorXd& values) { return (values.array() > 0).select(values.array().inverse(), 0.0); }

/// The facet of one side that a point lies on, or faces; `integrated`: whether its pass integrates over that side.
const Facet& facet_at(const PointContact& contact, const SurfaceMesh& mesh, bool integrated) {
  return mesh.facets[integrated ? contact.pair->primary : contact.pair->secondary];
}

/// Area in contact that belongs to each node of a side, given that of each pass: two full passes cover the same area,
/// each with the errors of its own integration; a restricted pass covers what the first one leaves, and its edge.
VectorXd tributary_area_of(const std::vector<VectorXd>& areas, bool two_pass) {
  const VectorXd& first = areas.front();
  const VectorXd& second = areas.back();  // the same where there is one pass
  if (!two_pass) return first.cwiseMax(second);
  const auto both = first.array() > 0 && second.array() > 0;
  return both.select(0.5 * (first + second), first + second);
}

/// Adds what a point says about the nodes of its facet on one side, weighted with their shares of its area.
void add_point(const PointContact& contact, const Facet& facet, const FacetVector& shares, double sign,
               NodalOutput& out) {
  const PairVector h = contact.kinematics.jump_weights();
  for (Index a = 0; a < shares.size(); ++a) {
    const int node = facet.node(a);
    out.gap[node] += shares[a] * contact.kinematics.gap;
    out.pressure[node] -= shares[a] * contact.loads.traction.value;
    for (Index k = 0; k < contact.fields.count(); ++k) {
      out.flux(contact.fields[k], node) += sign * shares[a] * contact.loads.flux[k].value;
      out.jump(contact.fields[k], node) += sign * shares[a] * h.dot(contact.values.col(k));
    }
  }
}

/// Calls use(point, facet of the side, shares of its nodes, sign) for each point of a pass, and returns the area of
/// each node of the side.
template <class Use>
VectorXd for_each_point_of(const ContactInterface& contact, std::size_t pass, Side side,
                           const PerSide<SurfaceFields>& fields, const Use& use) {
  const Side integrated = both_sides.at(pass);
  const SurfaceMesh& mesh = contact.mesh(side);
  VectorXd area = VectorXd::Zero(mesh.nodes);
  contact.pass(pass).for_each_contact(seen_from(integrated, fields), 1.0, [&](const PointContact& point) {
    const Facet& facet = facet_at(point, mesh, integrated == side);
    const FacetVector shares = area_of_nodes(point, integrated == side);
    for (Index a = 0; a < shares.size(); ++a) area[facet.node(a)] += shares[a];
    use(point, facet, shares, integrated == side ? 1.0 : -1.0);
  });
  return area;
}

/// The same for all passes: the areas of each.
template <class Use>
std::vector<VectorXd> for_each_point(const ContactInterface& contact, Side side, const PerSide<SurfaceFields>& fields,
                                     const Use& use) {
  std::vector<VectorXd> areas;
  for (std::size_t pass = 0; pass < contact.passes(); ++pass) {
    areas.push_back(for_each_point_of(contact, pass, side, fields, use));
  }
  return areas;
}

/// Divides what has been summed up by the areas that it has been weighted with. Gaps are those of the surfaces,
/// whatever the offset at which they touch.
void divide_by_areas(NodalOutput& out, const VectorXd& of_all_passes, double offset) {
  const VectorXd mean = inverse_or_zero(of_all_passes);
  out.gap = (of_all_passes.array() > 0).select(out.gap.array() * mean.array() - offset, 0.0);
  out.jump = out.jump * mean.asDiagonal();
  // Passes that cover the same area share its load: each integrates a part of it.
  const VectorXd per_area = inverse_or_zero(out.tributary_area);
  out.pressure.array() *= per_area.array();
  out.flux = out.flux * per_area.asDiagonal();
}

}  // namespace

Balance balance(const ContactInterface& contact, const PerSide<SurfaceFields>& fields) {
  const TaskClock timed = contact.measurements().clock(Task::output);
  Balance balance;
  balance.flow = VectorXd::Zero(contact.effects().scalar_fields());
  const auto add = [&](const PointContact& point, const Facet& /*facet*/, const FacetVector& /*shares*/, double sign) {
    const double weight = point.loads.weight;
    balance.force += sign * weight * point.loads.traction.value * point.kinematics.area_vector;
    for (Index k = 0; k < point.fields.count(); ++k) {
      balance.flow[point.fields[k]] += sign * weight * point.kinematics.area * point.loads.flux[k].value;
    }
  };
  const std::vector<VectorXd> areas = for_each_point(contact, Side::primary, fields, add);
  balance.area = tributary_area_of(areas, contact.settings().two_pass).sum();
  return balance;
}

NodalOutput nodal_output(const ContactInterface& contact, Side side, const PerSide<SurfaceFields>& fields) {
  const TaskClock timed = contact.measurements().clock(Task::output);
  const Index nodes = contact.mesh(side).nodes;
  const Index scalars = contact.effects().scalar_fields();
  NodalOutput out{VectorXd::Zero(nodes), VectorXd::Zero(nodes), MatrixXd::Zero(scalars, nodes),
                  MatrixXd::Zero(scalars, nodes), VectorXd::Zero(nodes)};
  const auto add = [&](const PointContact& point, const Facet& facet, const FacetVector& shares, double sign) {
    add_point(point, facet, shares, sign, out);
  };
  const std::vector<VectorXd> areas = for_each_point(contact, side, fields, add);
  out.tributary_area = tributary_area_of(areas, contact.settings().two_pass);
  divide_by_areas(out, std::accumulate(areas.begin(), areas.end(), VectorXd::Zero(nodes).eval()),
                  contact.pass(0).space().offset());
  return out;
}

}  // namespace mixture_contact
