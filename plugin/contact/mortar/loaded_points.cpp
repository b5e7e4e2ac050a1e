#include "mortar/loaded_points.h"

namespace mixture_contact {
namespace {

/// A pair with the loads of its nodes, from which the loads of its points are interpolated.
class LoadedPair {
 public:
  LoadedPair(const FacingPairs& facing, const FacetPair& pair, const NodalLoads& loads, const FacingFields& fields,
             double dt)
      : fields_(facing.exchanged_fields(pair)), dt_(dt) {
    nodal_ = facet_loads(facing.primary_facet(pair), loads, fields_);
    values_.resize(node_count(facing.primary_facet(pair).type) + node_count(facing.secondary_facet(pair).type),
                   fields_.count());
    for (Index k = 0; k < fields_.count(); ++k) values_.col(k) = facing.values(pair, fields_[k], fields);
  }

  /// The point of the pair with this number, and its loads.
  PointContact point(const MortarSpace& space, const FacetPair& pair, Index number) const {
    const IntegrationPoint& place = space.facing().points(pair)[number];
    PointContact contact(pair, space.facing().kinematics(pair, number));
    const ShapeFunctions psi = space.shape(pair.primary, place.sub_facet, place.xi);
    contact.psi = psi.value;
    contact.psi_gradient = psi.gradient;
    contact.fields = fields_;
    contact.values = values_;
    contact.loads = loads_at(nodal_, contact.psi);
    contact.loads.weight = place.weight;
    contact.loads.time_increment = dt_;
    if (!pair.unbroken) set_slopes(contact, space.facing().moves_points());
    return contact;
  }

 private:
  void set_slopes(PointContact& contact, bool moves_points) const {
    contact.loads.traction_slope = contact.psi_gradient.transpose() * nodal_.traction;
    if (moves_points) {
      for (Index a = 0; a < nodal_.friction.cols(); ++a)
        contact.loads.friction_slope += nodal_.friction.col(a).lazyProduct(contact.psi_gradient.row(a));
    }
    contact.loads.flux_slope.resize(fields_.count(), 2);
    for (Index k = 0; k < fields_.count(); ++k)
      contact.loads.flux_slope.row(k) = nodal_.flux[k].transpose() * contact.psi_gradient;
  }

  IndexedVector<int> fields_;
  double dt_;
  FacetLoads nodal_;
  PairFields values_;
};

VaryingFlatPair varying_flat_pair(const MortarSpace& space, const FacetPair& pair, const FlatPair& flat,
                                  const NodalLoads& loads, const FacingFields& fields, double dt) {
  const FacingPairs& facing = space.facing();
  const Facet& facet = facing.primary_facet(pair);
  const FacetCoordinates x2 = facet_coordinates(facing.secondary_facet(pair), fields.secondary.position);
  const FlatVariations vary = flat_variations(flat, facet_coordinates(facet, fields.primary.position), x2);
  VaryingFlatPair varying{flat, vary, facet_values(facet, loads.traction), {}};
  for (const int field : facing.exchanged_fields(pair))
    varying.flux.push_back(dt * facet_values(facet, loads.flux.row(field).transpose()));
  return varying;
}

}  // namespace

FacetLoads facet_loads(const Facet& facet, const NodalLoads& loads, const IndexedVector<int>& fields) {
  FacetLoads nodal;
  nodal.traction = facet_values(facet, loads.traction);
  nodal.friction = facet_columns(facet, loads.friction.traction);
  for (const int field : fields) nodal.flux.push_back(facet_values(facet, loads.flux.row(field).transpose()));
  return nodal;
}

PointLoads loads_at(const FacetLoads& nodal, const FacetVector& psi) {
  PointLoads here;
  here.traction = psi.dot(nodal.traction);
  for (Index a = 0; a < nodal.friction.cols(); ++a) here.friction += psi[a] * nodal.friction.col(a);
  here.flux.resize(nodal.flux.count());
  for (Index k = 0; k < nodal.flux.count(); ++k) here.flux[k] = psi.dot(nodal.flux[k]);
  return here;
}

void set_varying_pair(const MortarSpace& space, const FacetPair& pair, const NodalLoads& loads,
                      const FacingFields& fields, double dt, VaryingPair& varying) {
  std::vector<VaryingPoint>& points = varying.points;
  points.clear();
  varying.flat.reset();
  const auto by_moments = [&](const FlatPair& flat) {
    varying.flat = varying_flat_pair(space, pair, flat, loads, fields, dt);
  };
  space.integrate(pair, by_moments, [&] {
    points.reserve(indexing::entries(pair.points));
    const LoadedPair loaded(space.facing(), pair, loads, fields, dt);
    space.facing().for_each_motion(pair, positions(fields), [&](const PointMotion& motion) {
      points.emplace_back(loaded.point(space, pair, count_of(points)), motion);
    });
  });
}

VaryingPair varying_pair(const MortarSpace& space, const FacetPair& pair, const NodalLoads& loads,
                         const FacingFields& fields, double dt) {
  VaryingPair varying;
  set_varying_pair(space, pair, loads, fields, dt, varying);
  return varying;
}

void for_each_loaded_point(const MortarSpace& space, const FacetPair& pair, const NodalLoads& loads,
                           const FacingFields& fields, double dt, const std::function<void(const PointContact&)>& use) {
  const LoadedPair loaded(space.facing(), pair, loads, fields, dt);
  for (Index q = 0; q < pair.points; ++q) use(loaded.point(space, pair, q));
}

}  // namespace mixture_contact
