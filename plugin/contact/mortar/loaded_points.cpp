#include "mortar/loaded_points.h"

#include "base/in_order.h"

namespace mixture_contact {

PointContact loaded_point(const MortarSpace& space, const FacetPair& pair, std::size_t number, const NodalLoads& loads,
                          const FacingFields& fields, double dt) {
  const FacingPairs& facing = space.facing();
  const Facet& facet = facing.primary_facet(pair);
  const IntegrationPoint& place = pair.points[number];
  PointContact contact(pair, number);
  const ShapeFunctions psi = space.shape(pair.primary, place.sub_facet, place.xi);
  contact.psi = psi.value;
  contact.psi_gradient = psi.gradient;
  contact.fields = facing.exchanged_fields(pair);
  const Index count = contact.fields.count();
  contact.values.resize(contact.kinematics.nodes(), count);
  const FacetVector traction = facet_values(facet, loads.traction);
  contact.loads.traction = {contact.psi.dot(traction), 0.0};
  contact.loads.traction_slope = contact.psi_gradient.transpose() * traction;
  if (!loads.friction.empty()) {
    for (Index a = 0; a < facet.count(); ++a) {
      const Vector3d nodal = loads.friction.traction.col(facet.node(a));
      contact.loads.friction += contact.psi[a] * nodal;
      if (facing.moves_points()) contact.loads.friction_slope += nodal.lazyProduct(contact.psi_gradient.row(a));
    }
  }
  contact.loads.weight = place.weight;
  contact.loads.time_increment = dt;
  contact.loads.flux.resize(count);
  contact.loads.flux_slope.resize(count, 2);
  for (Index k = 0; k < count; ++k) {
    const int field = contact.fields[k];
    contact.values.col(k) = facing.values(pair, field, fields);
    const FacetVector nodal = facet_values(facet, loads.flux.row(field).transpose());
    contact.loads.flux[k] = {contact.psi.dot(nodal), 0.0};
    contact.loads.flux_slope.row(k) = nodal.transpose() * contact.psi_gradient;
  }
  return contact;
}

std::vector<VaryingPoint> varying_points(const MortarSpace& space, const FacetPair& pair, const NodalLoads& loads,
                                         const FacingFields& fields, double dt) {
  const std::vector<PointMotion> motions = space.facing().motions(pair, positions(fields));
  std::vector<VaryingPoint> points;
  points.reserve(pair.points.size());
  for (std::size_t q = 0; q < pair.points.size(); ++q) {
    points.push_back({loaded_point(space, pair, q, loads, fields, dt), {}});
    points.back().vary = kinematic_variations(points.back().contact.kinematics, motions[q]);
  }
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
