#include "interface/pass.h"

#include <algorithm>
#include <utility>

namespace mixture_contact {

ContactPass::ContactPass(const SurfaceMesh& primary, const SurfaceMesh& secondary, const Effects& effects,
                         const Settings& settings)
    : primary_(primary),
      secondary_(secondary),
      effects_(effects),
      settings_(settings),
      penalties_(at_nodes(penalties(primary, secondary, effects, settings), primary)),
      points_(point_finder(primary.facets, secondary.facets, settings)),
      effect_times_(effects.scalar_fields()) {
  multipliers.traction.setZero(primary.nodes);
  multipliers.flux.setZero(effects.scalar_fields(), primary.nodes);
  multipliers.flux_growth.setOnes(effects.scalar_fields());
}

void ContactPass::update_penalties() {
  penalties_ = at_nodes(penalties(primary_, secondary_, effects_, settings_), primary_);
}

void ContactPass::project(const Matrix3Xd& x1, const Matrix3Xd& x2, double radius) {
  radius_ = radius;
  touch_ = touch_fraction * half_diagonal(x1);
  see(points_->search(x1, x2, radius), x1, x2);
}

void ContactPass::project_on_same_facets(const Matrix3Xd& x1, const Matrix3Xd& x2) {
  see(points_->on_same_facets(x1, x2), x1, x2);
}

void ContactPass::see(std::vector<FacetPair> pairs, const Matrix3Xd& x1, const Matrix3Xd& x2) {
  pairs_ = std::move(pairs);
  keep_limited();
  if (!held_) bearing_.clear();
  find_bearing_nodes(x1, x2);
  if (!effects_.traction) frozen_ = freeze(x1, x2);
}

void ContactPass::keep_limited() {
  if (!limited_to_) return;
  const auto apart = [&](const FacetPair& pair) { return !carries_load(pair, *limited_to_); };
  pairs_.erase(std::remove_if(pairs_.begin(), pairs_.end(), apart), pairs_.end());
}

void ContactPass::end_iterations() {
  held_.reset();
  bearing_.clear();
  points_->end_iterations();
}

void ContactPass::forget() {
  end_iterations();
  augmented_ = false;
  frozen_.reset();
  pairs_.clear();
}

const Facet& ContactPass::primary_facet(const FacetPair& pair) const {
  return primary_.facets[static_cast<std::size_t>(pair.primary)];
}

const Facet& ContactPass::secondary_facet(const FacetPair& pair) const {
  return secondary_.facets[static_cast<std::size_t>(pair.secondary)];
}

ShapeFunctions ContactPass::multiplier_shape(int primary_facet, int sub_facet, const Vector2d& xi) const {
  const auto index = static_cast<std::size_t>(primary_facet);
  const FacetType type = primary_.facets[index].type;
  ShapeFunctions psi = multiplier_functions(type, sub_facet, xi);
  if (bearing_.empty() || bearing_[index].size() == 0 || bearing_[index].minCoeff() > 0) return psi;
  return shared_out(type, psi, bearing_[index]);
}

PointKinematics ContactPass::kinematics(const FacetPair& pair, const IntegrationPoint& point, const Matrix3Xd& x1,
                                        const Matrix3Xd& x2) const {
  const Facet& one = primary_facet(pair);
  const Facet& two = secondary_facet(pair);
  return point_kinematics(shape_functions(one.type, point.xi), facet_coordinates(one, x1),
                          shape_functions(two.type, point.eta), facet_coordinates(two, x2));
}

PairVector ContactPass::pair_values(const FacetPair& pair, int field, const SurfaceFields& primary,
                                    const SurfaceFields& secondary) const {
  const FacetVector one = facet_values(primary_facet(pair), primary.scalar.col(field));
  const FacetVector two = facet_values(secondary_facet(pair), secondary.scalar.col(field));
  PairVector values(one.size() + two.size());
  values << one, two;
  return values;
}

std::vector<int> ContactPass::exchanged_fields(const FacetPair& pair) const {
  const FieldMask both = primary_.permeable[static_cast<std::size_t>(pair.primary)] &
                         secondary_.permeable[static_cast<std::size_t>(pair.secondary)];
  std::vector<int> fields;
  for (int k = 0; k < effects_.scalar_fields(); ++k) {
    if (contains(both, k)) fields.push_back(k);
  }
  return fields;
}

bool ContactPass::carries_load(const FacetPair& pair, const std::vector<bool>& in_contact) const {
  const Facet& facet = primary_facet(pair);
  return std::any_of(facet.nodes.begin(), facet.nodes.begin() + node_count(facet.type),
                     [&](int node) { return in_contact[static_cast<std::size_t>(node)]; });
}

PointContact ContactPass::contact(const FacetPair& pair, const IntegrationPoint& place, const NodalLoads& loads,
                                  const SurfaceFields& primary, const SurfaceFields& secondary, double dt) const {
  PointContact contact;
  contact.pair = &pair;
  contact.kinematics = kinematics(pair, place, primary.position, secondary.position);
  const ShapeFunctions psi = multiplier_shape(pair.primary, place.sub_facet, place.xi);
  contact.psi = psi.value;
  contact.psi_gradient = psi.gradient;
  contact.fields = exchanged_fields(pair);
  const auto fields = static_cast<Index>(contact.fields.size());
  contact.values.resize(contact.kinematics.nodes(), fields);
  const FacetVector traction = facet_values(primary_facet(pair), loads.traction);
  contact.loads.traction = {contact.psi.dot(traction), 0.0};
  contact.loads.traction_slope = contact.psi_gradient.transpose() * traction;
  contact.loads.weight = place.weight;
  contact.loads.time_increment = dt;
  contact.loads.flux.resize(fields);
  contact.loads.flux_slope.resize(fields, 2);
  for (Index k = 0; k < fields; ++k) {
    const int field = contact.fields[static_cast<std::size_t>(k)];
    contact.values.col(k) = pair_values(pair, field, primary, secondary);
    const FacetVector nodal = facet_values(primary_facet(pair), loads.flux.row(field).transpose());
    contact.loads.flux[k] = {contact.psi.dot(nodal), 0.0};
    contact.loads.flux_slope.row(k) = nodal.transpose() * contact.psi_gradient;
  }
  return contact;
}

void ContactPass::for_each_contact(const SurfaceFields& primary, const SurfaceFields& secondary, double dt,
                                   const std::function<void(const PointContact&)>& use) const {
  const NodalLoads loads = nodal_loads(primary, secondary);
  for (const FacetPair& pair : pairs_) {
    if (!carries_load(pair, loads.in_contact)) continue;
    for (const IntegrationPoint& place : pair.points) use(contact(pair, place, loads, primary, secondary, dt));
  }
}

}  // namespace mixture_contact
