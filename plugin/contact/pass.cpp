#include "pass.h"

#include "quadrature.h"

#include <algorithm>
#include <cmath>

namespace mixture_contact {
namespace {

/// Curved facets bulge out of the box of their nodes by less than this part of its diagonal.
constexpr double box_margin = 0.1;
/// Surfaces closer than this part of their size touch to rounding.
constexpr double touch_fraction = 1e-10;
constexpr int nothing_seen = -1;
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
      penalties_(at_nodes(penalties(primary, secondary, effects, settings), primary)) {
  for (std::size_t f = 0; f < primary.facets.size(); ++f) {
    const FacetType type = primary.facets[f].type;
    const int order = settings.integration_order > 0 ? settings.integration_order : default_quadrature_order(type);
    for (const QuadraturePoint& q : quadrature(type, order)) {
      points_.push_back({static_cast<int>(f), q.weight, shape_functions(type, q.xi)});
    }
  }
  multipliers.traction.setZero(primary.nodes);
  multipliers.flux.setZero(effects.scalar_fields(), primary.nodes);
  multipliers.flux_growth.setOnes(effects.scalar_fields());
}

void ContactPass::update_penalties() {
  penalties_ = at_nodes(penalties(primary_, secondary_, effects_, settings_), primary_);
}

void ContactPass::project(const Matrix3Xd& x1, const Matrix3Xd& x2, double radius) {
  pairs_.clear();
  seen_.assign(points_.size(), nothing_seen);
  touch_ = touch_fraction * half_diagonal(x1);
  const FacetTree tree(secondary_.facets, x2, box_margin);
  for (std::size_t q = 0; q < points_.size(); ++q) {
    const std::optional<SurfaceHit> hit = nearest_facing(tree, secondary_.facets, x2, ray(q, x1, radius));
    if (!hit) continue;
    seen_[q] = hit->facet;
    pairs_.push_back({static_cast<int>(q), points_[q].facet, hit->facet, hit->eta});
  }
}

void ContactPass::project_on_same_facets(const Matrix3Xd& x1, const Matrix3Xd& x2) {
  pairs_.clear();
  for (std::size_t q = 0; q < seen_.size(); ++q) {
    if (seen_[q] == nothing_seen) continue;
    const Facet& facet = secondary_.facets[static_cast<std::size_t>(seen_[q])];
    const Ray from = ray(q, x1, 0);
    const auto hit = intersect(facet.type, facet_coordinates(facet, x2), from.origin, from.direction, from.tolerance);
    if (hit) pairs_.push_back({static_cast<int>(q), points_[q].facet, seen_[q], hit->eta});
  }
}

Ray ContactPass::ray(std::size_t point, const Matrix3Xd& x1, double radius) const {
  const ShapeFunctions& shape = points_[point].shape;
  const FacetCoordinates x = facet_coordinates(primary_.facets[static_cast<std::size_t>(points_[point].facet)], x1);
  const Eigen::Matrix<double, 3, 2> tangents = x * shape.gradient;
  return {x * shape.value, tangents.col(0).cross(tangents.col(1)).normalized(), radius, settings_.search_tolerance};
}

const Facet& ContactPass::primary_facet(const PointPair& pair) const {
  return primary_.facets[static_cast<std::size_t>(pair.primary_facet)];
}

const Facet& ContactPass::secondary_facet(const PointPair& pair) const {
  return secondary_.facets[static_cast<std::size_t>(pair.secondary_facet)];
}

const ShapeFunctions& ContactPass::primary_shape(const PointPair& pair) const {
  return points_[static_cast<std::size_t>(pair.point)].shape;
}

double ContactPass::weight(const PointPair& pair) const { return points_[static_cast<std::size_t>(pair.point)].weight; }

FacetVector ContactPass::multiplier_shape(const PointPair& pair) const {
  return mixture_contact::multiplier_shape(primary_facet(pair).type, primary_shape(pair).value);
}

PointKinematics ContactPass::kinematics(const PointPair& pair, const Matrix3Xd& x1, const Matrix3Xd& x2) const {
  const Facet& two = secondary_facet(pair);
  return point_kinematics(primary_shape(pair), facet_coordinates(primary_facet(pair), x1),
                          shape_functions(two.type, pair.eta), facet_coordinates(two, x2));
}

PairVector ContactPass::pair_values(const PointPair& pair, int field, const SurfaceFields& primary,
                                    const SurfaceFields& secondary) const {
  const FacetVector one = facet_values(primary_facet(pair), primary.scalar.col(field));
  const FacetVector two = facet_values(secondary_facet(pair), secondary.scalar.col(field));
  PairVector values(one.size() + two.size());
  values << one, two;
  return values;
}

std::vector<int> ContactPass::exchanged_fields(const PointPair& pair) const {
  const FieldMask both = primary_.permeable[static_cast<std::size_t>(pair.primary_facet)] &
                         secondary_.permeable[static_cast<std::size_t>(pair.secondary_facet)];
  std::vector<int> fields;
  for (int k = 0; k < effects_.scalar_fields(); ++k) {
    if (contains(both, k)) fields.push_back(k);
  }
  return fields;
}

// ------------------------------------------------------------ laws at the
// nodes

void ContactPass::average_gaps(const Matrix3Xd& x1, const Matrix3Xd& x2, NodalLoads& loads) const {
  loads.area.setZero(primary_.nodes);
  loads.absolute_area.setZero(primary_.nodes);
  loads.gap.setZero(primary_.nodes);
  for (const PointPair& pair : pairs_) {
    const PointKinematics point = kinematics(pair, x1, x2);
    const FacetVector share = weight(pair) * point.area * multiplier_shape(pair);
    const Facet& facet = primary_facet(pair);
    for (Index a = 0; a < share.size(); ++a) {
      const int node = facet.nodes[static_cast<std::size_t>(a)];
      loads.area[node] += share[a];
      loads.absolute_area[node] += std::abs(share[a]);
      loads.gap[node] += share[a] * point.gap;
    }
  }
  loads.gap = (loads.area.array() > 0).select(loads.gap.array() / loads.area.array(), 0.0);
}

void ContactPass::average_jumps(const SurfaceFields& primary, const SurfaceFields& secondary, NodalLoads& loads) const {
  loads.flux_area.setZero(effects_.scalar_fields(), primary_.nodes);
  loads.jump.setZero(effects_.scalar_fields(), primary_.nodes);
  for (const PointPair& pair : pairs_) {
    if (effects_.scalar_fields() == 0 || !carries_load(pair, loads.in_contact)) continue;
    const PointKinematics point = kinematics(pair, primary.position, secondary.position);
    const FacetVector share = weight(pair) * point.area * multiplier_shape(pair);
    const PairVector h = point.jump_weights();
    const Facet& facet = primary_facet(pair);
    for (const int field : exchanged_fields(pair)) {
      const double jump = h.dot(pair_values(pair, field, primary, secondary));
      for (Index a = 0; a < share.size(); ++a) {
        const int node = facet.nodes[static_cast<std::size_t>(a)];
        loads.flux_area(field, node) += share[a];
        loads.jump(field, node) += share[a] * jump;
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
  for (Index node = 0; node < primary_.nodes; ++node) {
    if (!loads.in_contact[static_cast<std::size_t>(node)]) continue;
    loads.traction[node] = multipliers.traction[node] + traction_penalty(node) * loads.gap[node];
    for (int field = 0; field < effects_.scalar_fields(); ++field) {
      if (!loads.sealed[static_cast<std::size_t>(node)] || !(loads.flux_area(field, node) > 0)) continue;
      loads.flux(
          field,
          node) = normal_flux(multipliers.flux(field, node), flux_penalty(field, node), loads.jump(field, node)).value;
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
  const auto around = pairs_around_nodes(next.loads.in_contact);
  for (std::size_t node = 0; node < around.size(); ++node) {
    next.nodes.push_back(around[node].empty()
                             ? NodeLinearisation{}
                             : linearise(static_cast<Index>(node), around[node], next.loads, primary, secondary));
  }
  next.geometric_traction = predicted ? before.traction : next.loads.traction;
  next.geometric_flux = predicted ? before.flux : next.loads.flux;
  const bool changed = before.in_contact != next.loads.in_contact || before.sealed != next.loads.sealed ||
                       loads_differ(before, next.loads, load_rounding, primary, secondary);
  held_ = std::move(next);
  return changed;
}

bool ContactPass::is_solution(const SurfaceFields& primary, const SurfaceFields& secondary) const {
  if (!held_) return true;
  if (next_status(primary, secondary) != held_->loads.in_contact) return false;
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

bool ContactPass::carries_load(const PointPair& pair, const std::vector<bool>& in_contact) const {
  const Facet& facet = primary_facet(pair);
  return std::any_of(facet.nodes.begin(), facet.nodes.begin() + node_count(facet.type),
                     [&](int node) { return in_contact[static_cast<std::size_t>(node)]; });
}

PointContact ContactPass::contact(const PointPair& pair, const NodalLoads& loads, const SurfaceFields& primary,
                                  const SurfaceFields& secondary, double dt) const {
  PointContact contact;
  contact.pair = &pair;
  contact.kinematics = kinematics(pair, primary.position, secondary.position);
  const FacetVector psi = multiplier_shape(pair);
  contact.fields = exchanged_fields(pair);
  const auto fields = static_cast<Index>(contact.fields.size());
  contact.values.resize(contact.kinematics.nodes(), fields);
  contact.loads.traction = {psi.dot(facet_values(primary_facet(pair), loads.traction)), 0.0};
  contact.loads.weight = weight(pair);
  contact.loads.time_increment = dt;
  contact.loads.flux.resize(fields);
  for (Index k = 0; k < fields; ++k) {
    const int field = contact.fields[static_cast<std::size_t>(k)];
    contact.values.col(k) = pair_values(pair, field, primary, secondary);
    const VectorXd nodal = loads.flux.row(field).transpose();
    contact.loads.flux[k] = {psi.dot(facet_values(primary_facet(pair), nodal)), 0.0};
  }
  return contact;
}

void ContactPass::for_each_contact(const SurfaceFields& primary, const SurfaceFields& secondary, double dt,
                                   const std::function<void(const PointContact&)>& use) const {
  for_each_loaded_point(nodal_loads(primary, secondary), primary, secondary, dt, use);
}

void ContactPass::for_each_loaded_point(const NodalLoads& loads, const SurfaceFields& primary,
                                        const SurfaceFields& secondary, double dt,
                                        const std::function<void(const PointContact&)>& use) const {
  for (const PointPair& pair : pairs_) {
    if (carries_load(pair, loads.in_contact)) use(contact(pair, loads, primary, secondary, dt));
  }
}

Patch ContactPass::facet_patch(const PointPair& pair) const {
  const auto nodes = [](const Facet& facet) {
    return std::vector<int>(facet.nodes.begin(), facet.nodes.begin() + node_count(facet.type));
  };
  return {nodes(primary_facet(pair)), nodes(secondary_facet(pair)), exchanged_fields(pair)};
}

template <class Local, class Evaluate, class Add>
void ContactPass::gather_by_facet_pair(const NodalLoads& loads, const SurfaceFields& primary,
                                       const SurfaceFields& secondary, double dt, const Evaluate& evaluate,
                                       const Add& add) const {
  // Points come facet by facet; those of one primary facet that see the same secondary facet are added up first.
  struct Sum {
    PointPair pair;
    Patch patch;
    Local local;
  };
  std::vector<Sum> sums;
  const auto flush = [&] {
    for (const Sum& sum : sums) add(sum.patch, sum.local);
    sums.clear();
  };
  for_each_loaded_point(loads, primary, secondary, dt, [&](const PointContact& contact) {
    if (!sums.empty() && sums.front().pair.primary_facet != contact.pair->primary_facet) flush();
    Patch patch = facet_patch(*contact.pair);
    const Local local = evaluate(contact, patch.layout());
    const auto same = std::find_if(sums.begin(), sums.end(), [&](const Sum& sum) {
      return sum.pair.secondary_facet == contact.pair->secondary_facet;
    });
    if (same == sums.end()) {
      sums.push_back({*contact.pair, std::move(patch), local});
    } else {
      same->local += local;
    }
  });
  flush();
}

void ContactPass::residual(const SurfaceFields& primary, const SurfaceFields& secondary, double dt,
                           const std::function<void(const Patch&, const VectorXd&)>& add) const {
  const auto evaluate = [](const PointContact& contact, const LocalLayout& layout) {
    return point_residual(contact.kinematics, contact.loads, layout);
  };
  gather_by_facet_pair<VectorXd>(nodal_loads(primary, secondary), primary, secondary, dt, evaluate, add);
}

// ------------------------------------------------------------ tangent

void ContactPass::tangent(const SurfaceFields& primary, const SurfaceFields& secondary, double dt,
                          const std::function<void(const Patch&, const MatrixXd&)>& add) const {
  const auto geometric = [](const PointContact& contact, const LocalLayout& layout) {
    return point_tangent(contact.kinematics, contact.loads, contact.values, layout);
  };
  const auto add_full_or_symmetric = [&](const Patch& patch, const MatrixXd& values) {
    add(patch, settings_.symmetric ? symmetric_part(values, patch.layout()) : values);
  };
  NodalLoads loads = nodal_loads(primary, secondary);
  const auto around = pairs_around_nodes(loads.in_contact);
  for (std::size_t node = 0; node < around.size(); ++node) {
    if (around[node].empty()) continue;
    const auto index = static_cast<Index>(node);
    const NodeLinearisation linear = held_ ? held_->nodes[node]
                                           : linearise(index, around[node], loads, primary, secondary);
    add_full_or_symmetric(linear.patch, law_tangent(index, linear, loads, dt));
  }
  if (held_) {
    loads.traction = held_->geometric_traction;
    loads.flux = held_->geometric_flux;
  }
  gather_by_facet_pair<MatrixXd>(loads, primary, secondary, dt, geometric, add_full_or_symmetric);
}

void ContactPass::for_each_coupling(const Matrix3Xd& x1, const Matrix3Xd& x2,
                                    const std::function<void(const Patch&)>& use) const {
  // A node's patch holds the facet pairs of all points that its loads act at.
  for (const auto& pairs : pairs_around_nodes(held_ ? held_->loads.in_contact : natural_status(x1, x2))) {
    if (!pairs.empty()) use(node_patch(pairs));
  }
}

std::vector<std::vector<const PointPair*>> ContactPass::pairs_around_nodes(const std::vector<bool>& in_contact) const {
  std::vector<std::vector<const PointPair*>> around(static_cast<std::size_t>(primary_.nodes));
  for (const PointPair& pair : pairs_) {
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

Patch ContactPass::node_patch(const std::vector<const PointPair*>& pairs) const {
  Patch patch;
  for (const PointPair* pair : pairs) {
    const Patch facets = facet_patch(*pair);
    unite(patch.primary, facets.primary);
    unite(patch.secondary, facets.secondary);
    unite(patch.fields, facets.fields);
  }
  return patch;
}

VectorXd ContactPass::patch_unknowns(const Patch& patch, const SurfaceFields& primary, const SurfaceFields& secondary) {
  const LocalLayout layout = patch.layout();
  VectorXd unknowns(layout.size());
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

ContactPass::NodeLinearisation ContactPass::linearise(Index node, const std::vector<const PointPair*>& pairs,
                                                      const NodalLoads& loads, const SurfaceFields& primary,
                                                      const SurfaceFields& secondary) const {
  // g_a = INT psi_a g da / A_a, so dg_a = sum_q w psi_a (|a| dg + (g - g_a) d|a|)/A_a; jumps alike, with their fields'
  // own part.
  NodeLinearisation linear;
  linear.patch = node_patch(pairs);
  linear.unknowns = patch_unknowns(linear.patch, primary, secondary);
  const LocalLayout layout = linear.patch.layout();
  const VectorXd zero = VectorXd::Zero(layout.size());
  linear.gap_variation = linear.traction_work = zero;
  linear.jump_variation.assign(linear.patch.fields.size(), zero);
  linear.flux_work = linear.jump_variation;
  for (const PointPair* pair : pairs) {
    const PointKinematics point = kinematics(*pair, primary.position, secondary.position);
    const KinematicVariations vary = kinematic_variations(point);
    const auto& nodes = primary_facet(*pair).nodes;
    const auto corner = std::find(nodes.begin(), nodes.end(), static_cast<int>(node)) - nodes.begin();
    const double share = weight(*pair) * multiplier_shape(*pair)[corner];
    const PairVector h = point.jump_weights();
    const Patch facets = facet_patch(*pair);
    const std::vector<Index> place = places(facets, linear.patch);
    const auto add_variation = [&](VectorXd& variation, const WeightedVariation& varied, double mean, double area) {
      for (std::size_t n = 0; n < place.size(); ++n) {
        const auto local = static_cast<Index>(3 * n);
        variation.segment<3>(layout.displacement(
            place[n], 0)) += (varied.integral.segment<3>(local) - mean * varied.area.segment<3>(local)).transpose() /
                             area;
      }
    };
    add_variation(linear.gap_variation, gap_variation(point, vary, share), loads.gap[node], loads.area[node]);
    for (std::size_t n = 0; n < place.size(); ++n) {
      linear.traction_work.segment<3>(layout.displacement(place[n], 0)) += share * h[static_cast<Index>(n)] *
                                                                           point.area_vector;
    }
    for (const int field : facets.fields) {
      const auto k = position_in(linear.patch.fields, field);
      const double area = loads.flux_area(field, node);
      const PairVector values = pair_values(*pair, field, primary, secondary);
      VectorXd& variation = linear.jump_variation[static_cast<std::size_t>(k)];
      VectorXd& work = linear.flux_work[static_cast<std::size_t>(k)];
      add_variation(variation, jump_variation(point, vary, share, values), loads.jump(field, node), area);
      for (std::size_t n = 0; n < place.size(); ++n) {
        const double entry = share * point.area * h[static_cast<Index>(n)];
        variation[layout.scalar(place[n], k)] += entry / area;
        work[layout.scalar(place[n], k)] += entry;
      }
    }
  }
  return linear;
}

MatrixXd ContactPass::law_tangent(Index node, const NodeLinearisation& linear, const NodalLoads& loads,
                                  double dt) const {
  // The residual holds t_a traction_work + dt phi_a flux_work; the variation of the works is the geometric part.
  MatrixXd tangent = traction_penalty(node) * linear.traction_work * linear.gap_variation.transpose();
  for (std::size_t k = 0; k < linear.patch.fields.size(); ++k) {
    const int field = linear.patch.fields[k];
    if (!loads.sealed[static_cast<std::size_t>(node)] || !(loads.flux_area(field, node) > 0)) continue;
    tangent += dt * flux_penalty(field, node) * linear.flux_work[k] * linear.jump_variation[k].transpose();
  }
  return tangent;
}

}  // namespace mixture_contact
