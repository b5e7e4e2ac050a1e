#include "interface/output_sums.h"

#include "base/in_order.h"

namespace mixture_contact {
namespace {

/// The area of a point, distributed to the nodes of a facet with these shape function values [mm^2].
FacetVector shares_of_area(const PointContact& point, const FacetVector& shape) {
  const FacetVector size = shape.cwiseAbs();
  return point.loads.weight * point.kinematics.area / size.sum() * size;
}

/// Sets the values of a point on the primary surface.
void set_values(const PointContact& point, const OutputRows& rows, VectorXd& values) {
  const PairVector h = point.kinematics.jump_weights();
  values.setZero(rows.count());
  values[OutputRows::area] = 1;
  values[OutputRows::gap] = point.kinematics.gap;
  values[OutputRows::pressure] = -point.loads.traction;
  for (Index k = 0; k < point.fields.count(); ++k) {
    values[rows.flux() + point.fields[k]] = point.loads.flux[k];
    values[rows.jump() + point.fields[k]] = h.dot(point.values.col(k));
  }
}

/// Sets the sums over the points of a pair.
void set_by_points(const MortarSpace& space, const FacetPair& pair, const NodalLoads& loads, const OutputRows& rows,
                   const FacingFields& fields, OutputSums& sums, VectorXd& values) {
  const FacingPairs& facing = space.facing();
  const Facet& facet = facing.primary_facet(pair);
  sums.set_zero(rows.count(), facet.count(), facing.secondary_facet(pair).count());
  for_each_loaded_point(space, pair, loads, fields, 1.0, [&](const PointContact& point) {
    set_values(point, rows, values);
    rows.set_sliding(point, facet, values);
    sums.force += point.loads.weight * point.loads.traction * point.kinematics.area_vector;
    sums.integrated += values.lazyProduct(shares_of_area(point, point.kinematics.primary_shape).transpose());
    sums.facing += values.lazyProduct(shares_of_area(point, point.kinematics.secondary_shape).transpose());
  });
}

/// The flat pair with N2_c in place of psi_c, whose moments give the sums at the secondary nodes c.
FlatPair by_secondary_nodes(const FlatPair& flat, const PointsOfPair& points, const FacetCoordinates& x1,
                            const FacetCoordinates& x2) {
  FlatMoments moments{flat.moments.secondary.transpose()};
  for (const IntegrationPoint& point : points) {
    const Vector3d shape = area_coordinates(point.eta);
    moments.secondary += point.weight * shape * shape.transpose();
  }
  return flat_pair(moments, x1, x2);
}

/// Sets the sums of areas, gaps and jumps at the nodes c of a flat pair, and all other sums to zero.
void set_averages(const FlatPair& flat, const IndexedVector<int>& fields, const PairFields& values,
                  const OutputRows& rows, MatrixXd& sums) {
  sums.setZero(rows.count(), 3);
  sums.row(OutputRows::area) = flat.area * flat.weight().transpose();
  sums.row(OutputRows::gap) = flat.area * flat.gap.transpose();
  for (Index k = 0; k < fields.count(); ++k)
    sums.row(rows.jump() + fields[k]) = flat.area * flat.jump(values.col(k)).transpose();
}

/// Sets the sums of a flat pair from its moments. `loaded`: the pair with the redistributed functions psi_c of the
/// loads.
void set_by_moments(const FacingPairs& facing, const FacetPair& pair, const FlatPair& loaded, const NodalLoads& loads,
                    const OutputRows& rows, const FacingFields& fields, OutputSums& sums) {
  const Facet& facet = facing.primary_facet(pair);
  const IndexedVector<int> exchanged = facing.exchanged_fields(pair);
  PairFields values(facet.count() + facing.secondary_facet(pair).count(), exchanged.count());
  for (Index k = 0; k < exchanged.count(); ++k) values.col(k) = facing.values(pair, exchanged[k], fields);
  const FlatPair& flat = *facing.flat(pair);
  set_averages(flat, exchanged, values, rows, sums.integrated);
  set_averages(by_secondary_nodes(flat, facing.points(pair), facet_coordinates(facet, fields.primary.position),
                                  facet_coordinates(facing.secondary_facet(pair), fields.secondary.position)),
               exchanged, values, rows, sums.facing);
  const FacetLoads nodal = facet_loads(facet, loads, exchanged);
  const auto set_loads = [&](Index row, const Vector3d& load) {
    const FlatNodes by_nodes = flux_residual(loaded, load);
    sums.integrated.row(row) = by_nodes.head<3>().transpose();
    sums.facing.row(row) = -by_nodes.tail<3>().transpose();
  };
  set_loads(OutputRows::pressure, -nodal.traction);
  for (Index k = 0; k < exchanged.count(); ++k) set_loads(rows.flux() + exchanged[k], nodal.flux[k]);
  sums.force = loaded.weight().dot(Vector3d(nodal.traction)) * flat.area_vector;
}

/// Adds the sums at the nodes of a facet to those at all nodes.
void add_nodes(const Facet& facet, const MatrixXd& of_facet, MatrixXd& sums) {
  for (Index a = 0; a < of_facet.cols(); ++a) sums.col(facet.node(a)) += of_facet.col(a);
}

}  // namespace

OutputSums sums_of(const MortarSpace& space, const NodalLoads& loads, const OutputRows& rows,
                   const FacingFields& fields) {
  const FacingPairs& facing = space.facing();
  const auto carries_load = [&](const FacetPair& pair) { return facing.has_node_among(pair, loads.in_contact); };
  const auto sum_of_pair = [&](Index index, OutputSums& sums, VectorXd& values) {
    const FacetPair& pair = facing.pairs()[index];
    if (!carries_load(pair)) return;
    const auto by_moments = [&](const FlatPair& flat) {
      set_by_moments(facing, pair, flat, loads, rows, fields, sums);
    };
    space.integrate(pair, by_moments, [&] { set_by_points(space, pair, loads, rows, fields, sums, values); });
  };
  OutputSums all;
  all.set_zero(rows.count(), facing.primary().nodes, facing.secondary().nodes);
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
