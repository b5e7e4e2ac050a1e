#include "mortar/loaded_points.h"

#include "base/in_order.h"

namespace mixture_contact {

FacetLoads facet_loads(const Facet& facet, const NodalLoads& loads, const IndexedVector<int>& fields) {
  FacetLoads nodal;
  nodal.traction = facet_values(facet, loads.traction);
  if (!loads.friction.empty()) nodal.friction = facet_coordinates(facet, loads.friction.traction);
  for (const int field : fields) nodal.flux.push_back(facet_values(facet, loads.flux.row(field).transpose()));
  return nodal;
}

PointLoads loads_at(const FacetLoads& nodal, const FacetVector& psi) {
  PointLoads here;
  here.traction = {psi.dot(nodal.traction), 0.0};
  for (Index a = 0; a < nodal.friction.cols(); ++a) here.friction += psi[a] * nodal.friction.col(a);
  here.flux.resize(nodal.flux.count());
  for (Index k = 0; k < nodal.flux.count(); ++k) here.flux[k] = {psi.dot(nodal.flux[k]), 0.0};
  return here;
}

PointContact loaded_point(const MortarSpace& space, const FacetPair& pair, std::size_t number, const NodalLoads& loads,
                          const FacingFields& fields, double dt) {
  const FacingPairs& facing = space.facing();
  const Facet& facet = facing.primary_facet(pair);
  const IntegrationPoint& place = pair.points[number];
  PointContact contact(facing, pair, number);
  const ShapeFunctions psi = space.shape(pair.primary, place.sub_facet, place.xi);
  contact.psi = psi.value;
  contact.psi_gradient = psi.gradient;
  contact.fields = facing.exchanged_fields(pair);
  const Index count = contact.fields.count();
  contact.values.resize(contact.kinematics.nodes(), count);
  const FacetLoads nodal = facet_loads(facet, loads, contact.fields);
  contact.loads = loads_at(nodal, contact.psi);
  contact.loads.weight = place.weight;
  contact.loads.time_increment = dt;
  contact.loads.traction_slope = contact.psi_gradient.transpose() * nodal.traction;
  if (facing.moves_points()) {
    for (Index a = 0; a < nodal.friction.cols(); ++a)
      contact.loads.friction_slope += nodal.friction.col(a).lazyProduct(contact.psi_gradient.row(a));
  }
  contact.loads.flux_slope.resize(count, 2);
  for (Index k = 0; k < count; ++k) {
    contact.values.col(k) = facing.values(pair, contact.fields[k], fields);
    contact.loads.flux_slope.row(k) = nodal.flux[k].transpose() * contact.psi_gradient;
  }
  return contact;
}

std::vector<VaryingPoint> varying_points(const MortarSpace& space, const FacetPair& pair, const NodalLoads& loads,
                                         const FacingFields& fields, double dt) {
  const std::vector<PointMotion> motions = space.facing().motions(pair, positions(fields));
  std::vector<VaryingPoint> points;
  points.reserve(pair.points.size());
  for (std::size_t q = 0; q < pair.points.size(); ++q)
    points.emplace_back(loaded_point(space, pair, q, loads, fields, dt), motions[q]);
  return points;
}

void for_each_loaded_point(const MortarSpace& space, const NodalLoads& loads, const FacingFields& fields, double dt,
                           const std::function<void(const PointContact&)>& use) {
  const IndexedVector<FacetPair>& pairs = space.facing().pairs();
  const auto points_of = [&](Index index) {
    const FacetPair& pair = pairs[index];
    std::vector<PointContact> points;
    if (!space.facing().has_node_among(pair, loads.in_contact)) return points;
    points.reserve(pair.points.size());
    for (std::size_t q = 0; q < pair.points.size(); ++q)
      points.push_back(loaded_point(space, pair, q, loads, fields, dt));
    return points;
  };
  in_order(pairs.count(), points_of, [&](Index /*pair*/, const std::vector<PointContact>& points) {
    for (const PointContact& point : points) use(point);
  });
}

}  // namespace mixture_contact
