#include "interface/output_sums.h"

#include "base/in_order.h"
#include "mortar/loaded_points.h"

namespace mixture_contact {
namespace {

/// Area of a point, shared among the nodes of a facet of whose functions these are the values [mm^2].
FacetVector shares_of_area(const PointContact& point, const FacetVector& shape) {
  const FacetVector size = shape.cwiseAbs();
  return point.loads.weight * point.kinematics.area / size.sum() * size;
}

/// Sets what a point says of friction, in its rows.
void set_sliding(const PointContact& point, const Facet& facet, const SlidingNodes& nodes, const OutputRows& rows,
                 VectorXd& values) {
  values[OutputRows::bound] = point.psi.dot(facet_values(facet, nodes.bound));
  values[OutputRows::fluid] = point.psi.dot(facet_values(facet, nodes.fluid));
  values[OutputRows::slips] = point.psi.dot(facet_values(facet, nodes.slips));
  values.segment<3>(rows.traction()) = point.loads.friction;
  values.segment<3>(rows.slip()) = facet_coordinates(facet, nodes.slip) * point.psi;
}

/// Sets what a point says, of the surface that is integrated over.
void set_values(const PointContact& point, const OutputRows& rows, VectorXd& values) {
  const PairVector h = point.kinematics.jump_weights();
  values.setZero(rows.count());
  values[OutputRows::area] = 1;
  values[OutputRows::gap] = point.kinematics.gap;
  values[OutputRows::pressure] = -point.loads.traction.value;
  for (Index k = 0; k < point.fields.count(); ++k) {
    values[rows.flux() + point.fields[k]] = point.loads.flux[k].value;
    values[rows.jump() + point.fields[k]] = h.dot(point.values.col(k));
  }
}

/// Sets the sums over the points of a pair.
void set_by_points(const LoadedState& state, const FacetPair& pair, OutputSums& sums, VectorXd& values) {
  const FacingPairs& facing = state.space.facing();
  const Facet& facet = facing.primary_facet(pair);
  const OutputRows rows = state.rows();
  sums.set_zero(rows.count(), facet.count(), facing.secondary_facet(pair).count());
  for_each_loaded_point(state.space, pair, state.loads, state.fields, 1.0, [&](const PointContact& point) {
    set_values(point, rows, values);
    if (!state.sliding.empty()) set_sliding(point, facet, state.sliding, rows, values);
    sums.force += point.loads.weight * point.loads.traction.value * point.kinematics.area_vector;
    sums.integrated += values.lazyProduct(shares_of_area(point, point.kinematics.primary_shape).transpose());
    sums.facing += values.lazyProduct(shares_of_area(point, point.kinematics.secondary_shape).transpose());
  });
}

/// Products of functions summed over the points of a flat pair, one column per node b of the surface that is asked for.
struct FlatProducts {
  Eigen::Matrix3d primary;    ///< (c, b): sum w N1_c N_b
  Eigen::Matrix3d secondary;  ///< (c, b): sum w N2_c N_b
  Eigen::Matrix3d loads;      ///< (c, b): sum w psi_c N_b

  /// Of values given at the nodes of both facets: their sum on the primary one less that on the secondary one.
  Eigen::RowVector3d jump(const FlatNodes& values) const {
    return values.head<3>().transpose() * primary - values.tail<3>().transpose() * secondary;
  }
};

/// sum w N2_c N2_b
Eigen::Matrix3d facing_products(const PointsOfPair& points) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const IntegrationPoint& point : points) {
    const Vector3d shape = area_coordinates(point.eta);
    sum += point.weight * shape * shape.transpose();
  }
  return sum;
}

/// What varies linearly over the facets of a flat pair, at their nodes.
struct FlatValues {
  FlatNodes height;  ///< along the normal: the gap is minus its jump
  FacetLoads loads;
  IndexedVector<int> fields;
  PairFields values;
};

/// Sets the sums at the nodes of one surface.
void set_nodes(const FlatProducts& products, const FlatValues& at_nodes, double area, const OutputRows& rows,
               MatrixXd& sums) {
  sums.setZero(rows.count(), 3);
  sums.row(OutputRows::area) = area * products.primary.colwise().sum();
  sums.row(OutputRows::gap) = -area * products.jump(at_nodes.height);
  sums.row(OutputRows::pressure) = -area * (at_nodes.loads.traction.transpose() * products.loads);
  for (Index k = 0; k < at_nodes.fields.count(); ++k) {
    sums.row(rows.flux() + at_nodes.fields[k]) = area * (at_nodes.loads.flux[k].transpose() * products.loads);
    sums.row(rows.jump() + at_nodes.fields[k]) = area * products.jump(at_nodes.values.col(k));
  }
}

/// Sets the sums of a flat pair by its moments, all values being linear in N1 and N2; `loaded`: those with psi_c.
void set_by_moments(const LoadedState& state, const FacetPair& pair, const FlatMoments& loaded, OutputSums& sums) {
  const FacingPairs& facing = state.space.facing();
  const FlatPair& flat = *facing.flat(pair);
  const Facet& facet = facing.primary_facet(pair);
  FlatValues at_nodes;
  at_nodes.height << facet_coordinates(facet, state.fields.primary.position).transpose() * flat.normal,
      facet_coordinates(facing.secondary_facet(pair), state.fields.secondary.position).transpose() * flat.normal;
  at_nodes.fields = facing.exchanged_fields(pair);
  at_nodes.loads = facet_loads(facet, state.loads, at_nodes.fields);
  at_nodes.values.resize(at_nodes.height.size(), at_nodes.fields.count());
  for (Index k = 0; k < at_nodes.fields.count(); ++k)
    at_nodes.values.col(k) = facing.values(pair, at_nodes.fields[k], state.fields);
  const FlatMoments& moments = flat.moments;
  set_nodes({moments.primary, moments.secondary.transpose(), loaded.primary}, at_nodes, flat.area, state.rows(),
            sums.integrated);
  set_nodes({moments.secondary, facing_products(facing.points(pair)), loaded.secondary}, at_nodes, flat.area,
            state.rows(), sums.facing);
  sums.force = at_nodes.loads.traction.dot(loaded.primary.rowwise().sum()) * flat.area_vector;
}

/// Adds what is summed up for the nodes of a facet to the sums over all nodes.
void add_nodes(const Facet& facet, const MatrixXd& of_facet, MatrixXd& sums) {
  for (Index a = 0; a < of_facet.cols(); ++a) sums.col(facet.node(a)) += of_facet.col(a);
}

}  // namespace

SlidingNodes sliding_nodes(const NodalLaws& laws, const NodalLoads& loads) {
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
                         dissipated(friction.trial.col(node), friction.bound[node], laws.friction_penalty(node));
  }
  return nodes;
}

OutputSums sums_of(const LoadedState& state) {
  const FacingPairs& facing = state.space.facing();
  const auto carries_load = [&](const FacetPair& pair) { return facing.has_node_among(pair, state.loads.in_contact); };
  const auto sum_of_pair = [&](Index index, OutputSums& sums, VectorXd& values) {
    const FacetPair& pair = facing.pairs()[index];
    if (!carries_load(pair)) return;
    if (const auto flat = state.space.flat(pair)) return set_by_moments(state, pair, flat->moments, sums);
    set_by_points(state, pair, sums, values);
  };
  OutputSums all;
  all.set_zero(state.rows().count(), facing.primary().nodes, facing.secondary().nodes);
  const auto add_pair = [&](Index index, const OutputSums& sums) {
    const FacetPair& pair = facing.pairs()[index];
    if (!carries_load(pair)) return;
    all.force += sums.force;
    add_nodes(facing.primary_facet(pair), sums.integrated, all.integrated);
    add_nodes(facing.secondary_facet(pair), sums.facing, all.facing);
  };
  in_order_with(VectorXd(), OutputSums(), facing.pairs().count(), sum_of_pair, add_pair);
  return all;
}

}  // namespace mixture_contact
