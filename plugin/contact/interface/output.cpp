#include "interface/output.h"

#include <iterator>
#include <numeric>
#include <utility>

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

void set_zero(FrictionOutput& out, Index nodes) {
  out.traction = out.slip = Matrix3Xd::Zero(3, nodes);
  out.bound = out.fluid = out.status = VectorXd::Zero(nodes);
}

/// Sums up, as add_point() does, friction and how much of the contact slides; `share` of each node.
void add_sliding(const PointContact& contact, const Facet& primary, const SlidingNodes& nodes, const Facet& facet,
                 const FacetVector& shares, double sign, FrictionOutput& out) {
  const Vector3d slip = sign * facet_coordinates(primary, nodes.slip) * contact.psi;
  const double bound = contact.psi.dot(facet_values(primary, nodes.bound));
  const double fluid = contact.psi.dot(facet_values(primary, nodes.fluid));
  const double slips = contact.psi.dot(facet_values(primary, nodes.slips));
  for (Index a = 0; a < shares.size(); ++a) {
    const int node = facet.node(a);
    out.traction.col(node) += sign * shares[a] * contact.loads.friction;
    out.slip.col(node) += shares[a] * slip;
    out.bound[node] += shares[a] * bound;
    out.fluid[node] += shares[a] * fluid;
    out.status[node] += shares[a] * slips;
  }
}

/// Divides what has been summed up by areas; `per_area`: of loads, as divide_by_areas() has it. A node slides where
/// more than half of the contact around it does.
void divide_by_areas(FrictionOutput& out, const VectorXd& areas, const VectorXd& per_area) {
  const VectorXd mean = inverse_or_zero(areas);
  out.traction = out.traction * per_area.asDiagonal();
  out.slip = out.slip * mean.asDiagonal();
  out.bound.array() *= per_area.array();
  out.fluid.array() *= mean.array();
  for (Index node = 0; node < areas.size(); ++node) {
    const Sliding sliding = out.status[node] > 0.5 * areas[node] ? Sliding::slips : Sliding::sticks;
    out.status[node] = static_cast<double>(areas[node] > 0 ? sliding : Sliding::open);
  }
}

/// Nodes of the surface that a pass integrates over have a status of their own.
void take_status(const SlidingNodes& nodes, FrictionOutput& out) {
  for (Index node = 0; node < out.status.size(); ++node) {
    if (nodes.in_contact[node] == 0) continue;
    out.status[node] = static_cast<double>(nodes.slips[node] > 0 ? Sliding::slips : Sliding::sticks);
  }
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

NodalOutput zero_output(const ContactInterface& contact, Side side) {
  const Index nodes = contact.mesh(side).nodes;
  const VectorXd none = VectorXd::Zero(nodes);
  const MatrixXd no_fields = MatrixXd::Zero(contact.effects().scalar_fields(), nodes);
  NodalOutput out{none, none, no_fields, no_fields, none, {}};
  if (contact.effects().has_friction()) set_zero(out.friction, nodes);
  return out;
}

/// Of each pass; none without friction.
std::vector<SlidingNodes> sliding_nodes(const ContactInterface& contact, const PerSide<SurfaceFields>& fields) {
  std::vector<SlidingNodes> nodes;
  for (std::size_t pass = 0; contact.effects().has_friction() && pass < contact.passes(); ++pass)
    nodes.push_back(sliding_nodes(contact.pass(pass), seen_from(both_sides.at(pass), fields)));
  return nodes;
}

/// What all points of all passes say, each of them asked once.
class OutputSums {
 public:
  OutputSums(const ContactInterface& contact, const PerSide<SurfaceFields>& fields)
      : contact_(contact), sliding_(sliding_nodes(contact, fields)) {
    out_.balance.flow = VectorXd::Zero(contact.effects().scalar_fields());
    for (const Side side : both_sides) {
      out_.nodes[side] = zero_output(contact, side);
      areas_[side].assign(contact.passes(), VectorXd::Zero(contact.mesh(side).nodes));
    }
  }

  void add(std::size_t pass, const PointContact& point) {
    const Side integrated = both_sides.at(pass);
    add_balance(point, integrated == Side::primary ? 1.0 : -1.0);
    for (const Side side : both_sides) add_nodes(side, pass, point, integrated == side);
  }

  InterfaceOutput divided() {
    const bool two_pass = contact_.settings().two_pass;
    for (const Side side : both_sides) {
      NodalOutput& out = out_.nodes[side];
      const std::vector<VectorXd>& areas = areas_[side];
      out.tributary_area = tributary_area_of(areas, two_pass);
      const VectorXd of_all_passes = std::accumulate(std::next(areas.begin()), areas.end(), areas.front());
      divide_by_areas(out, of_all_passes, contact_.pass(0).space().offset());
      if (sliding_.empty()) continue;
      divide_by_areas(out.friction, of_all_passes, inverse_or_zero(out.tributary_area));
      if (static_cast<int>(side) < number_of(sliding_)) take_status(at(sliding_, side), out.friction);
    }
    out_.balance.area = out_.nodes[Side::primary].tributary_area.sum();
    out_.balance.force += out_.balance.friction;
    for (const SlidingNodes& nodes : sliding_) out_.balance.dissipation += nodes.dissipation;
    return std::move(out_);
  }

 private:
  /// `sign`: 1 where the pass integrates over the primary surface, else -1.
  void add_balance(const PointContact& point, double sign) {
    Balance& balance = out_.balance;
    const double weight = point.loads.weight;
    balance.force += sign * weight * point.loads.traction.value * point.kinematics.area_vector;
    for (Index k = 0; k < point.fields.count(); ++k)
      balance.flow[point.fields[k]] += sign * weight * point.kinematics.area * point.loads.flux[k].value;
    if (!sliding_.empty()) balance.friction += sign * weight * point.kinematics.area * point.loads.friction;
  }

  void add_nodes(Side side, std::size_t pass, const PointContact& point, bool integrated) {
    const Facet& facet = facet_at(point, contact_.mesh(side), integrated);
    const FacetVector shares = area_of_nodes(point, integrated);
    VectorXd& area = at(areas_[side], pass);
    for (Index a = 0; a < shares.size(); ++a) area[facet.node(a)] += shares[a];
    const double sign = integrated ? 1.0 : -1.0;
    add_point(point, facet, shares, sign, out_.nodes[side]);
    if (sliding_.empty()) return;
    const Facet& primary = contact_.pass(pass).space().facing().primary_facet(*point.pair);
    add_sliding(point, primary, at(sliding_, pass), facet, shares, sign, out_.nodes[side].friction);
  }

  const ContactInterface& contact_;
  std::vector<SlidingNodes> sliding_;  ///< of each pass; none without friction
  InterfaceOutput out_;
  PerSide<std::vector<VectorXd>> areas_;  ///< of each pass, per node
};

}  // namespace

SlidingNodes sliding_nodes(const ContactPass& pass, const FacingFields& fields) {
  const NodalLoads loads = pass.nodal_loads(fields);
  const NodalFriction& friction = loads.friction;
  SlidingNodes nodes;
  if (friction.empty()) return nodes;
  const Index count = loads.gap.size();
  nodes.slip = Matrix3Xd::Zero(3, count);
  nodes.fluid = nodes.in_contact = nodes.slips = VectorXd::Zero(count);
  nodes.bound = friction.bound;
  for (Index node = 0; node < count; ++node) {
    if (!loads.in_contact[node]) continue;
    const Vector3d n = friction.normal(node);
    const Vector3d carried = friction.convection[node] * friction.slip.col(node);
    nodes.slip.col(node) = carried - n * n.dot(carried);
    nodes.in_contact[node] = 1;
    if (friction.pressure.size() > 0) nodes.fluid[node] = friction.pressure[node];
    if (!loads.slips[node]) continue;
    nodes.slips[node] = 1;
    nodes.dissipation += loads.area[node] *
                         dissipated(friction.trial.col(node), friction.bound[node], pass.laws().friction_penalty(node));
  }
  return nodes;
}

InterfaceOutput output(const ContactInterface& contact, const PerSide<SurfaceFields>& fields) {
  const TaskClock timed = contact.measurements().clock(Task::output);
  OutputSums sums(contact, fields);
  for (std::size_t pass = 0; pass < contact.passes(); ++pass) {
    contact.pass(pass).for_each_contact(seen_from(both_sides.at(pass), fields), 1.0,
                                        [&](const PointContact& point) { sums.add(pass, point); });
  }
  return sums.divided();
}

}  // namespace mixture_contact
