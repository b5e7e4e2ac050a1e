#include "interface/output.h"

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
VectorXd tributary_area(const std::vector<VectorXd>& areas, bool two_pass) {
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
VectorXd for_each_point_of(const SidedPass& pass, Side side, const AllPasses& all, const PerSide<SurfaceFields>& fields,
                           const Use& use) {
  const bool integrated = pass.side == side;
  VectorXd area = VectorXd::Zero(all.mesh[side].nodes);
  pass.integral->for_each_contact(seen_from(pass.side, fields), 1.0, [&](const PointContact& contact) {
    const Facet& facet = facet_at(contact, all.mesh[side], integrated);
    const FacetVector shares = area_of_nodes(contact, integrated);
    for (Index a = 0; a < shares.size(); ++a) area[facet.node(a)] += shares[a];
    use(contact, facet, shares, integrated ? 1.0 : -1.0);
  });
  return area;
}

}  // namespace

Balance balance_of(const AllPasses& all, const PerSide<SurfaceFields>& fields) {
  Balance balance;
  balance.flow = VectorXd::Zero(all.fields);
  std::vector<VectorXd> areas;
  const auto add = [&](const PointContact& contact, const Facet& /*facet*/, const FacetVector& /*shares*/,
                       double sign) {
    const double weight = contact.loads.weight;
    balance.force += sign * weight * contact.loads.traction.value * contact.kinematics.area_vector;
    for (Index k = 0; k < contact.fields.count(); ++k) {
      balance.flow[contact.fields[k]] += sign * weight * contact.kinematics.area * contact.loads.flux[k].value;
    }
  };
  for (const SidedPass& pass : all.passes) areas.push_back(for_each_point_of(pass, Side::primary, all, fields, add));
  balance.area = tributary_area(areas, all.two_pass).sum();
  return balance;
}

NodalOutput nodal_output_of(const AllPasses& all, Side side, const PerSide<SurfaceFields>& fields) {
  const Index nodes = all.mesh[side].nodes;
  NodalOutput out{VectorXd::Zero(nodes), VectorXd::Zero(nodes), MatrixXd::Zero(all.fields, nodes),
                  MatrixXd::Zero(all.fields, nodes), VectorXd::Zero(nodes)};
  VectorXd weight = VectorXd::Zero(nodes);  // area of all passes
  std::vector<VectorXd> areas;
  const auto add = [&](const PointContact& contact, const Facet& facet, const FacetVector& shares, double sign) {
    add_point(contact, facet, shares, sign, out);
  };
  for (const SidedPass& pass : all.passes) {
    areas.push_back(for_each_point_of(pass, side, all, fields, add));
    weight += areas.back();
  }
  out.coverage = tributary_area(areas, all.two_pass);
  const VectorXd mean = inverse_or_zero(weight);
  const double offset = all.passes.front().integral->space().offset();
  out.gap = (weight.array() > 0).select(out.gap.array() * mean.array() - offset, 0.0);
  out.jump = out.jump * mean.asDiagonal();
  // Passes that cover the same area share its load: each integrates a part of it.
  const VectorXd per_area = inverse_or_zero(out.coverage);
  out.pressure.array() *= per_area.array();
  out.flux = out.flux * per_area.asDiagonal();
  return out;
}

}  // namespace mixture_contact
