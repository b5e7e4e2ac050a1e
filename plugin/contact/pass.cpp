#include "pass.h"

#include <algorithm>
#include <cmath>

namespace mixture_contact {
namespace {

/// Surfaces closer than this part of their size touch to rounding.
constexpr double touch_fraction = 1e-10;
/// Rounding of averaged gaps and jumps, over the size of the surface or the field.
constexpr double rounding_fraction = 1e-13;
/// Of quadratic facets psi_a changes sign. An average over points that see the other surface only where it does would
/// divide by next to nothing: its area must be this part of that of |psi_a|.
constexpr double least_area = 0.1;
/// Loads below this part of the largest one do not decide about contact: rounding, and what Newton leaves.
constexpr double status_tolerance = 1e-6;
/// Loads that differ by less than this part of the largest one are the same; and are near enough for a solution.
constexpr double load_rounding = 1e-9;
constexpr double load_tolerance = 1e-2;

/// Whether two arrays of loads (fields, nodes) differ by more than a part of a field's largest entry, and by more than
/// `rounding` of the field.
bool differs(const MatrixXd& one, const MatrixXd& other, double part, const VectorXd& rounding) {
  for (Index field = 0; field < one.rows(); ++field) {
    const double size = std::max(one.row(field).cwiseAbs().maxCoeff(), other.row(field).cwiseAbs().maxCoeff());
    if (!((one.row(field) - other.row(field)).cwiseAbs().maxCoeff() <= part * size + rounding[field])) return true;
  }
  return false;
}

}  // namespace

ContactPass::ContactPass(const SurfaceMesh& primary, const SurfaceMesh& secondary, const Effects& effects,
                         const Settings& settings)
    : primary_(primary),
      secondary_(secondary),
      effects_(effects),
      settings_(settings),
      penalties_(at_nodes(penalties(primary, secondary, effects, settings), primary)),
      points_(point_finder(primary.facets, secondary.facets, settings)) {
  multipliers.traction.setZero(primary.nodes);
  multipliers.flux.setZero(effects.scalar_fields(), primary.nodes);
  multipliers.flux_growth.setOnes(effects.scalar_fields());
}

void ContactPass::update_penalties() {
  penalties_ = at_nodes(penalties(primary_, secondary_, effects_, settings_), primary_);
}

void ContactPass::project(const Matrix3Xd& x1, const Matrix3Xd& x2, double radius) {
  touch_ = touch_fraction * half_diagonal(x1);
  pairs_ = points_->search(x1, x2, radius);
}

void ContactPass::project_on_same_facets(const Matrix3Xd& x1, const Matrix3Xd& x2) {
  pairs_ = points_->on_same_facets(x1, x2);
}

const Facet& ContactPass::primary_facet(const FacetPair& pair) const {
  return primary_.facets[static_cast<std::size_t>(pair.primary)];
}

const Facet& ContactPass::secondary_facet(const FacetPair& pair) const {
  return secondary_.facets[static_cast<std::size_t>(pair.secondary)];
}

FacetVector ContactPass::multiplier_shape(const FacetPair& pair, const PointKinematics& point) const {
  return mixture_contact::multiplier_shape(primary_facet(pair).type, point.primary_shape);
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

// ------------------------------------------------------------ laws at nodes

void ContactPass::average_gaps(const Matrix3Xd& x1, const Matrix3Xd& x2, NodalLoads& loads) const {
  loads.area.setZero(primary_.nodes);
  loads.absolute_area.setZero(primary_.nodes);
  loads.gap.setZero(primary_.nodes);
  for (const FacetPair& pair : pairs_) {
    const Facet& facet = primary_facet(pair);
    for (const IntegrationPoint& place : pair.points) {
      const PointKinematics point = kinematics(pair, place, x1, x2);
      const FacetVector share = place.weight * point.area * multiplier_shape(pair, point);
      for (Index a = 0; a < share.size(); ++a) {
        const int node = facet.nodes[static_cast<std::size_t>(a)];
        loads.area[node] += share[a];
        loads.absolute_area[node] += std::abs(share[a]);
        loads.gap[node] += share[a] * point.gap;
      }
    }
  }
  loads.gap = (loads.area.array() > 0).select(loads.gap.array() / loads.area.array(), 0.0);
}

void ContactPass::average_jumps(const SurfaceFields& primary, const SurfaceFields& secondary, NodalLoads& loads) const {
  loads.flux_area.setZero(effects_.scalar_fields(), primary_.nodes);
  loads.jump.setZero(effects_.scalar_fields(), primary_.nodes);
  for (const FacetPair& pair : pairs_) {
    if (effects_.scalar_fields() == 0 || !carries_load(pair, loads.in_contact)) continue;
    const Facet& facet = primary_facet(pair);
    const std::vector<int> fields = exchanged_fields(pair);
    for (const IntegrationPoint& place : pair.points) {
      const PointKinematics point = kinematics(pair, place, primary.position, secondary.position);
      const FacetVector share = place.weight * point.area * multiplier_shape(pair, point);
      const PairVector h = point.jump_weights();
      for (const int field : fields) {
        const double jump = h.dot(pair_values(pair, field, primary, secondary));
        for (Index a = 0; a < share.size(); ++a) {
          const int node = facet.nodes[static_cast<std::size_t>(a)];
          loads.flux_area(field, node) += share[a];
          loads.jump(field, node) += share[a] * jump;
        }
      }
    }
  }
  loads.jump = (loads.flux_area.array() > 0).select(loads.jump.array() / loads.flux_area.array(), 0.0);
}

NodalLoads ContactPass::averages(const SurfaceFields& primary, const SurfaceFields& secondary,
                                 std::vector<bool> in_contact, std::vector<bool> sealed) const {
  NodalLoads loads;
  loads.in_contact = std::move(in_contact);
  loads.sealed = std::move(sealed);
  average_gaps(primary.position, secondary.position, loads);
  average_jumps(primary, secondary, loads);
  return loads;
}

void ContactPass::apply_laws(NodalLoads& loads) const {
  loads.traction.setZero(primary_.nodes);
  loads.flux.setZero(effects_.scalar_fields(), primary_.nodes);
  const bool penalised = !has_unknown_multipliers();  // multipliers that are unknowns are the loads
  for (Index node = 0; node < primary_.nodes; ++node) {
    if (!loads.in_contact[static_cast<std::size_t>(node)]) continue;
    loads.traction[node] = multipliers.traction[node];
    if (penalised) loads.traction[node] += traction_penalty(node) * loads.gap[node];
    for (int field = 0; field < effects_.scalar_fields(); ++field) {
      if (!passes(loads, field, node)) continue;
      const double penalty = penalised ? flux_penalty(field, node) : 0.0;
      loads.flux(field, node) = normal_flux(multipliers.flux(field, node), penalty, loads.jump(field, node)).value;
    }
  }
}

NodalLoads ContactPass::nodal_loads(const SurfaceFields& primary, const SurfaceFields& secondary) const {
  if (held_) return predicted_loads(*held_, primary, secondary);
  const std::vector<bool> status = natural_status(primary.position, secondary.position);
  NodalLoads loads = averages(primary, secondary, status, status);
  apply_laws(loads);
  loads.traction = loads.traction.cwiseMin(0.0);
  return loads;
}

bool ContactPass::seen(const NodalLoads& loads, Index node) {
  return loads.area[node] > least_area * loads.absolute_area[node];
}

std::vector<bool> ContactPass::natural_status(const Matrix3Xd& x1, const Matrix3Xd& x2) const {
  NodalLoads loads;
  average_gaps(x1, x2, loads);
  std::vector<bool> status;
  for (Index node = 0; node < primary_.nodes; ++node) {
    const LawValue law = normal_traction(multipliers.traction[node], traction_penalty(node), loads.gap[node], touch_);
    status.push_back(seen(loads, node) && law.derivative > 0);
  }
  return status;
}

std::vector<bool> ContactPass::sealed_nodes(const Matrix3Xd& x1, const Matrix3Xd& x2) const {
  return held_ ? held_->loads.sealed : natural_status(x1, x2);
}

// ------------------------------------------------------------ Newton iterations

NodalLoads ContactPass::predicted_loads(const Held& held, const SurfaceFields& primary,
                                        const SurfaceFields& secondary) const {
  if (has_unknown_multipliers()) {
    NodalLoads loads = averages(primary, secondary, held.loads.in_contact, held.loads.sealed);
    apply_laws(loads);
    return loads;
  }
  NodalLoads loads = held.loads;
  for (Index node = 0; node < primary_.nodes; ++node) {
    const NodeLinearisation& linear = held.nodes[static_cast<std::size_t>(node)];
    if (linear.unknowns.size() == 0) continue;
    const VectorXd change = patch_unknowns(linear.patch, primary, secondary) - linear.unknowns;
    loads.gap[node] += linear.gap_variation.dot(change);
    for (std::size_t k = 0; k < linear.patch.fields.size(); ++k) {
      loads.jump(linear.patch.fields[k], node) += linear.jump_variation[k].dot(change);
    }
  }
  apply_laws(loads);
  return loads;
}

std::vector<bool> ContactPass::next_status(const SurfaceFields& primary, const SurfaceFields& secondary) const {
  if (!held_) return natural_status(primary.position, secondary.position);
  const NodalLoads predicted = predicted_loads(*held_, primary, secondary);
  NodalLoads now;
  average_gaps(primary.position, secondary.position, now);
  const double negligible = status_tolerance * predicted.traction.cwiseAbs().maxCoeff();
  std::vector<bool> status;
  for (Index node = 0; node < primary_.nodes; ++node) {
    const bool was = predicted.in_contact[static_cast<std::size_t>(node)];
    const double overlap_load = multipliers.traction[node] + traction_penalty(node) * (now.gap[node] - touch_);
    const bool stays = predicted.traction[node] <= negligible;
    status.push_back(seen(now, node) && (was ? stays : overlap_load < -negligible));
  }
  return status;
}

bool ContactPass::begin_iteration(const SurfaceFields& primary, const SurfaceFields& secondary) {
  const NodalLoads before = nodal_loads(primary, secondary);
  const bool predicted = held_.has_value();
  Held next;
  const std::vector<bool> status = next_status(primary, secondary);
  next.changes = predicted ? held_->changes : std::vector<int>(status.size(), 0);
  std::vector<bool> sealed = status;
  for (std::size_t node = 0; node < status.size(); ++node) {
    if (predicted && status[node] != before.in_contact[node]) ++next.changes[node];
    if (next.changes[node] > most_status_changes) sealed[node] = false;
  }
  next.loads = averages(primary, secondary, status, sealed);
  apply_laws(next.loads);
  next.nodes = linearise(next.loads, primary, secondary);
  // Unknown multipliers are what an iteration predicts: there is nothing to tell apart.
  const NodalLoads& geometric = predicted && !has_unknown_multipliers() ? before : next.loads;
  next.geometric_traction = geometric.traction;
  next.geometric_flux = geometric.flux;
  if (has_unknown_multipliers()) next.multiplier_weights = multiplier_weights(next.loads, primary.position);
  const bool changed = before.in_contact != next.loads.in_contact || before.sealed != next.loads.sealed ||
                       loads_differ(before, next.loads, load_rounding, primary, secondary);
  held_ = std::move(next);
  return changed;
}

bool ContactPass::is_solution(const SurfaceFields& primary, const SurfaceFields& secondary) const {
  if (!held_) return true;
  if (next_status(primary, secondary) != held_->loads.in_contact) return false;
  if (has_unknown_multipliers()) return true;  // predicted loads are the loads; what is left of gaps, gaps() tells
  const NodalLoads predicted = predicted_loads(*held_, primary, secondary);
  NodalLoads now = averages(primary, secondary, held_->loads.in_contact, held_->loads.sealed);
  apply_laws(now);
  return !loads_differ(predicted, now, load_tolerance, primary, secondary);
}

bool ContactPass::loads_differ(const NodalLoads& one, const NodalLoads& other, double part,
                               const SurfaceFields& primary, const SurfaceFields& secondary) const {
  // A large penalty turns the rounding of gaps and jumps into loads.
  const VectorXd traction_rounding = VectorXd::Constant(
      1, multipliers.traction_growth * penalties_.traction.maxCoeff() * rounding_fraction / touch_fraction * touch_);
  VectorXd flux_rounding(effects_.scalar_fields());
  for (int field = 0; field < effects_.scalar_fields(); ++field) {
    const double size = std::max(primary.scalar.col(field).cwiseAbs().maxCoeff(),
                                 secondary.scalar.col(field).cwiseAbs().maxCoeff());
    flux_rounding[field] = rounding_fraction * size * multipliers.flux_growth[field] *
                           penalties_.flux.row(field).maxCoeff();
  }
  return differs(one.traction.transpose(), other.traction.transpose(), part, traction_rounding) ||
         differs(one.flux, other.flux, part, flux_rounding);
}

// ------------------------------------------------------------ loads at the points

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
  contact.psi = multiplier_shape(pair, contact.kinematics);
  contact.psi_gradient = multiplier_gradient(primary_facet(pair).type, contact.kinematics.primary_gradient);
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

Patch ContactPass::facet_patch(const FacetPair& pair) const {
  const auto nodes = [](const Facet& facet) {
    return std::vector<int>(facet.nodes.begin(), facet.nodes.begin() + node_count(facet.type));
  };
  return {nodes(primary_facet(pair)), nodes(secondary_facet(pair)), exchanged_fields(pair)};
}

void ContactPass::residual(const SurfaceFields& primary, const SurfaceFields& secondary, double dt,
                           const std::function<void(const Patch&, const VectorXd&)>& add) const {
  const NodalLoads loads = nodal_loads(primary, secondary);
  for (const FacetPair& pair : pairs_) {
    if (!carries_load(pair, loads.in_contact)) continue;
    const Patch patch = facet_patch(pair);
    VectorXd sum = VectorXd::Zero(patch.layout().size());
    for (const IntegrationPoint& place : pair.points) {
      const PointContact point = contact(pair, place, loads, primary, secondary, dt);
      sum += point_residual(point.kinematics, point.loads, patch.layout());
    }
    add(patch, sum);
  }
  if (!has_unknown_multipliers()) return;
  const VectorXd weights = present_multiplier_weights(loads, primary.position);
  for (Index node = 0; node < primary_.nodes; ++node) {
    add(node_patch(node, {}), multiplier_residual(node, loads, weights, dt));
  }
}

// ------------------------------------------------------------ tangent

void ContactPass::tangent(const SurfaceFields& primary, const SurfaceFields& secondary, double dt,
                          const std::function<void(const Patch&, const MatrixXd&)>& add) const {
  const auto add_full_or_symmetric = [&](const Patch& patch, const MatrixXd& values) {
    add(patch, settings_.symmetric ? symmetric_part(values, patch.layout()) : values);
  };
  NodalLoads loads = nodal_loads(primary, secondary);
  std::vector<NodeLinearisation> present;
  if (!held_) present = linearise(loads, primary, secondary);
  const std::vector<NodeLinearisation>& nodes = held_ ? held_->nodes : present;
  const VectorXd weights = present_multiplier_weights(loads, primary.position);
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    if (nodes[node].unknowns.size() == 0) continue;
    const auto index = static_cast<Index>(node);
    add_full_or_symmetric(nodes[node].patch, has_unknown_multipliers()
                                                 ? multiplier_tangent(index, nodes[node], loads, weights, dt)
                                                 : law_tangent(index, nodes[node], loads, dt));
  }
  if (held_) {
    loads.traction = held_->geometric_traction;
    loads.flux = held_->geometric_flux;
  }
  for (const FacetPair& pair : pairs_) {
    if (!carries_load(pair, loads.in_contact)) continue;
    const Patch patch = facet_patch(pair);
    const std::vector<PointMotion> motions = points_->motions(pair, primary.position, secondary.position);
    MatrixXd sum = MatrixXd::Zero(patch.layout().size(), patch.layout().size());
    for (std::size_t q = 0; q < pair.points.size(); ++q) {
      const PointContact point = contact(pair, pair.points[q], loads, primary, secondary, dt);
      const KinematicVariations vary = kinematic_variations(point.kinematics, motions[q]);
      sum += point_tangent(point.kinematics, vary, point.loads, point.values, patch.layout());
    }
    add_full_or_symmetric(patch, sum);
  }
}

void ContactPass::for_each_coupling(const Matrix3Xd& x1, const Matrix3Xd& x2,
                                    const std::function<void(const Patch&)>& use) const {
  // A node's patch holds the facet pairs of all points that its loads act at.
  const auto around = pairs_around_nodes(held_ ? held_->loads.in_contact : natural_status(x1, x2));
  for (std::size_t node = 0; node < around.size(); ++node) {
    if (!around[node].empty() || has_unknown_multipliers()) use(node_patch(static_cast<Index>(node), around[node]));
  }
}

std::vector<std::vector<const FacetPair*>> ContactPass::pairs_around_nodes(const std::vector<bool>& in_contact) const {
  std::vector<std::vector<const FacetPair*>> around(static_cast<std::size_t>(primary_.nodes));
  for (const FacetPair& pair : pairs_) {
    const Facet& facet = primary_facet(pair);
    for (int a = 0; a < node_count(facet.type); ++a) {
      const auto node = static_cast<std::size_t>(facet.nodes[static_cast<std::size_t>(a)]);
      if (in_contact[node]) around[node].push_back(&pair);
    }
  }
  return around;
}

namespace {

/// Adds the entries of `more` that `list` does not have yet.
void unite(std::vector<int>& list, const std::vector<int>& more) {
  for (const int entry : more) {
    if (std::find(list.begin(), list.end(), entry) == list.end()) list.push_back(entry);
  }
}

Index position_in(const std::vector<int>& list, int entry) {
  return std::find(list.begin(), list.end(), entry) - list.begin();
}

/// Where the nodes of a pair of facets stand in a larger patch.
std::vector<Index> places(const Patch& pair, const Patch& patch) {
  std::vector<Index> places;
  places.reserve(pair.primary.size() + pair.secondary.size());
  for (const int node : pair.primary) places.push_back(position_in(patch.primary, node));
  for (const int node : pair.secondary) {
    places.push_back(static_cast<Index>(patch.primary.size()) + position_in(patch.secondary, node));
  }
  return places;
}

}  // namespace

Patch ContactPass::node_patch(Index node, const std::vector<const FacetPair*>& pairs) const {
  Patch patch;
  if (has_unknown_multipliers()) {
    patch.multiplier_node = static_cast<int>(node);
    for (int field = 0; field < effects_.scalar_fields(); ++field) patch.fields.push_back(field);
  }
  for (const FacetPair* pair : pairs) {
    const Patch facets = facet_patch(*pair);
    unite(patch.primary, facets.primary);
    unite(patch.secondary, facets.secondary);
    unite(patch.fields, facets.fields);
  }
  return patch;
}

VectorXd ContactPass::patch_unknowns(const Patch& patch, const SurfaceFields& primary, const SurfaceFields& secondary) {
  const LocalLayout layout = patch.layout();
  VectorXd unknowns = VectorXd::Zero(layout.size());
  for (Index place = 0; place < layout.nodes(); ++place) {
    const bool first = place < layout.primary_nodes();
    const SurfaceFields& surface = first ? primary : secondary;
    const int node = first ? patch.primary[static_cast<std::size_t>(place)]
                           : patch.secondary[static_cast<std::size_t>(place - layout.primary_nodes())];
    unknowns.segment<3>(layout.displacement(place, 0)) = surface.position.col(node);
    for (Index k = 0; k < layout.scalar_fields(); ++k) {
      unknowns[layout.scalar(place, k)] = surface.scalar(node, patch.fields[static_cast<std::size_t>(k)]);
    }
  }
  return unknowns;
}

ContactPass::NodeLinearisation ContactPass::start_linearisation(const Patch& patch, const SurfaceFields& primary,
                                                                const SurfaceFields& secondary) {
  NodeLinearisation linear;
  linear.patch = patch;
  linear.unknowns = patch_unknowns(patch, primary, secondary);
  const VectorXd zero = VectorXd::Zero(patch.layout().size());
  linear.gap_variation = linear.traction_work = zero;
  linear.jump_variation.assign(patch.fields.size(), zero);
  linear.flux_work = linear.jump_variation;
  return linear;
}

void ContactPass::add_point(NodeLinearisation& linear, Index node, const std::vector<Index>& place,
                            const NodalLoads& loads, const PointContact& contact, const KinematicVariations& vary,
                            const PointShare& share) {
  // g_a = INT psi_a g da / A_a, so dg_a = sum_q [w psi_a |a| dg + (g - g_a) d(w psi_a |a|)]/A_a; jumps alike, with
  // their fields' own part.
  const PointKinematics& point = contact.kinematics;
  const LocalLayout layout = linear.patch.layout();
  const PairVector h = point.jump_weights();
  const auto add_variation = [&](VectorXd& variation, const WeightedVariation& varied, double mean, double area) {
    const PairVariation<1> row = (varied.integral - mean * varied.area) / area;
    for (std::size_t n = 0; n < place.size(); ++n) {
      variation.segment<3>(layout.displacement(place[n], 0)) += row.segment<3>(static_cast<Index>(3 * n)).transpose();
    }
  };
  add_variation(linear.gap_variation, gap_variation(point, vary, share), loads.gap[node], loads.area[node]);
  for (std::size_t n = 0; n < place.size(); ++n) {
    linear.traction_work.segment<3>(layout.displacement(place[n], 0)) += share.value * h[static_cast<Index>(n)] *
                                                                         point.area_vector;
  }
  for (std::size_t f = 0; f < contact.fields.size(); ++f) {
    const int field = contact.fields[f];
    const auto k = position_in(linear.patch.fields, field);
    const double area = loads.flux_area(field, node);
    VectorXd& variation = linear.jump_variation[static_cast<std::size_t>(k)];
    VectorXd& work = linear.flux_work[static_cast<std::size_t>(k)];
    const PairVector values = contact.values.col(static_cast<Index>(f));
    add_variation(variation, jump_variation(point, vary, share, values), loads.jump(field, node), area);
    for (std::size_t n = 0; n < place.size(); ++n) {
      const double entry = share.value * point.area * h[static_cast<Index>(n)];
      variation[layout.scalar(place[n], k)] += entry / area;
      work[layout.scalar(place[n], k)] += entry;
    }
  }
}

std::vector<ContactPass::NodeLinearisation> ContactPass::linearise(const NodalLoads& loads,
                                                                   const SurfaceFields& primary,
                                                                   const SurfaceFields& secondary) const {
  const auto around = pairs_around_nodes(loads.in_contact);
  std::vector<NodeLinearisation> nodes(around.size());
  for (std::size_t node = 0; node < around.size(); ++node) {
    if (around[node].empty() && !has_unknown_multipliers()) continue;
    const Patch patch = node_patch(static_cast<Index>(node), around[node]);
    nodes[node] = start_linearisation(patch, primary, secondary);
  }
  for (const FacetPair& pair : pairs_) {
    if (!carries_load(pair, loads.in_contact)) continue;
    const Patch facets = facet_patch(pair);
    std::vector<std::vector<Index>> place;  // of the pair's nodes in the patch of each of its primary nodes
    for (const int node : facets.primary) place.push_back(places(facets, nodes[static_cast<std::size_t>(node)].patch));
    const std::vector<PointMotion> motions = points_->motions(pair, primary.position, secondary.position);
    for (std::size_t q = 0; q < pair.points.size(); ++q) {
      const double weight = pair.points[q].weight;
      const PointContact point = contact(pair, pair.points[q], loads, primary, secondary, 1.0);
      const KinematicVariations vary = kinematic_variations(point.kinematics, motions[q]);
      for (std::size_t a = 0; a < facets.primary.size(); ++a) {
        const auto corner = static_cast<Index>(a);
        const int node = facets.primary[a];
        NodeLinearisation& linear = nodes[static_cast<std::size_t>(node)];
        if (!loads.in_contact[static_cast<std::size_t>(node)]) continue;
        const PointShare share{weight * point.psi[corner],
                               weight * (point.psi[corner] * vary.weight + point.psi_gradient.row(corner) * vary.xi)};
        add_point(linear, node, place[a], loads, point, vary, share);
      }
    }
  }
  return nodes;
}

MatrixXd ContactPass::law_tangent(Index node, const NodeLinearisation& linear, const NodalLoads& loads,
                                  double dt) const {
  // The residual holds t_a traction_work + dt phi_a flux_work; the variation of the works is the geometric part.
  MatrixXd tangent = traction_penalty(node) * linear.traction_work * linear.gap_variation.transpose();
  for (std::size_t k = 0; k < linear.patch.fields.size(); ++k) {
    const int field = linear.patch.fields[k];
    if (!passes(loads, field, node)) continue;
    tangent += dt * flux_penalty(field, node) * linear.flux_work[k] * linear.jump_variation[k].transpose();
  }
  return tangent;
}

}  // namespace mixture_contact
