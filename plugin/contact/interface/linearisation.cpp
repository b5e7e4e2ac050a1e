/// First variations of the averages and works of each node: a part of ContactPass.
#include "base/parallel.h"
#include "interface/pass.h"

#include <algorithm>

namespace mixture_contact {
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

double ContactPass::jump_of(const NodeLinearisation& linear, std::size_t k, const SurfaceFields& primary,
                            const SurfaceFields& secondary) {
  const int field = linear.patch.fields[k];
  const LocalLayout layout = linear.patch.of_field(field, false).layout();
  double jump = 0;
  for (Index n = 0; n < layout.nodes(); ++n) {
    const SurfaceFields& surface = n < layout.primary_nodes() ? primary : secondary;
    jump += linear.jumps[k].weights[layout.scalar(n, 0)] * surface.scalar(linear.patch.node(n), field);
  }
  return jump;
}

ContactPass::NodeLinearisation ContactPass::zero_linearisation(const Patch& patch) {
  NodeLinearisation linear;
  linear.patch = patch;
  if (patch.displacements) linear.gap_variation.setZero(patch.of_displacements().layout().size());
  linear.traction_work = linear.gap_variation;
  for (const int field : patch.fields) {
    linear.jumps.push_back({linear.gap_variation, VectorXd::Zero(patch.of_field(field, false).layout().size())});
  }
  return linear;
}

void ContactPass::add(NodeLinearisation& sum, const NodeLinearisation& pair) {
  const std::vector<Index> place = places(pair.patch, sum.patch);
  const LocalLayout layout = sum.patch.of_displacements().layout();
  const LocalLayout own = pair.patch.of_displacements().layout();
  const auto add_variation = [&](VectorXd& variation, const VectorXd& part) {
    if (!sum.patch.displacements) return;
    for (std::size_t n = 0; n < place.size(); ++n) {
      variation.segment<3>(layout.displacement(place[n], 0)) += part.segment<3>(
          own.displacement(static_cast<Index>(n), 0));
    }
  };
  add_variation(sum.gap_variation, pair.gap_variation);
  add_variation(sum.traction_work, pair.traction_work);
  for (std::size_t f = 0; f < pair.patch.fields.size(); ++f) {
    const Index k = position_in(sum.patch.fields, pair.patch.fields[f]);
    NodeLinearisation::Jump& jump = sum.jumps[static_cast<std::size_t>(k)];
    add_variation(jump.drift, pair.jumps[f].drift);
    for (std::size_t n = 0; n < place.size(); ++n)
      jump.weights[place[n]] += pair.jumps[f].weights[static_cast<Index>(n)];
  }
}

Patch ContactPass::facet_patch(const FacetPair& pair) const {
  const auto nodes = [](const Facet& facet) {
    return std::vector<int>(facet.nodes.begin(), facet.nodes.begin() + node_count(facet.type));
  };
  return {nodes(primary_facet(pair)), nodes(secondary_facet(pair)), exchanged_fields(pair), std::nullopt,
          effects_.traction};
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

Patch ContactPass::node_patch(Index node, const std::vector<const FacetPair*>& pairs) const {
  Patch patch;
  patch.displacements = effects_.traction;
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

Patch ContactPass::field_columns(const Patch& patch, int field) const {
  return patch.of_field(field, effects_.traction && !settings_.symmetric);
}

std::vector<ContactPass::NodeLinearisation> ContactPass::linearise_corners(const FacetPair& pair,
                                                                           const NodalLoads& loads,
                                                                           const SurfaceFields& primary,
                                                                           const SurfaceFields& secondary) const {
  std::vector<NodeLinearisation> corners;
  if (!carries_load(pair, loads.in_contact)) return corners;
  const Patch patch = facet_patch(pair);
  corners.assign(patch.primary.size(), zero_linearisation(patch));
  Laps laps(effect_times_, effects_.scalar_fields());
  const std::vector<VaryingPoint> points = varying_points(pair, loads, primary, secondary, 1.0);
  const auto for_each_corner_of_points = [&](const auto& use) {
    for (const VaryingPoint& point : points) {
      for (std::size_t a = 0; a < corners.size(); ++a) {
        const int node = patch.primary[a];
        if (!loads.in_contact[static_cast<std::size_t>(node)]) continue;
        use(corners[a], node, point, share_of(point, static_cast<Index>(a)));
      }
    }
  };
  laps.shared();
  if (patch.displacements) {
    for_each_corner_of_points([&](auto& linear, int node, const VaryingPoint& point, const PointShare& share) {
      add_gap(linear, loads, node, point, share);
    });
    laps.traction();
  }
  for (std::size_t k = 0; k < patch.fields.size(); ++k) {
    for_each_corner_of_points([&](auto& linear, int node, const VaryingPoint& point, const PointShare& share) {
      add_jump(linear, k, loads, node, point, share);
    });
    laps.field(patch.fields[k]);
  }
  return corners;
}

std::vector<VaryingPoint> ContactPass::varying_points(const FacetPair& pair, const NodalLoads& loads,
                                                      const SurfaceFields& primary, const SurfaceFields& secondary,
                                                      double dt) const {
  const std::vector<PointMotion> motions = points_->motions(pair, primary.position, secondary.position);
  std::vector<VaryingPoint> points;
  points.reserve(pair.points.size());
  for (std::size_t q = 0; q < pair.points.size(); ++q) {
    PointContact point = contact(pair, pair.points[q], loads, primary, secondary, dt);
    const KinematicVariations vary = kinematic_variations(point.kinematics, motions[q]);
    points.push_back({std::move(point), vary});
  }
  return points;
}

PointShare ContactPass::share_of(const VaryingPoint& point, Index corner) {
  const double weight = point.contact.loads.weight;
  const double psi = point.contact.psi[corner];
  return {weight * psi, weight * (psi * point.vary.weight + point.contact.psi_gradient.row(corner) * point.vary.xi)};
}

namespace {

/// First variation of an average over a node, g_a = INT psi_a g da / A_a:
/// dg_a = sum_q [w psi_a |a| dg + (g - g_a) d(w psi_a |a|)]/A_a.
PairVariation<1> mean_variation(const WeightedVariation& varied, double mean, double area) {
  return (varied.integral - mean * varied.area) / area;
}

}  // namespace

void ContactPass::add_gap(NodeLinearisation& linear, const NodalLoads& loads, Index node, const VaryingPoint& point,
                          const PointShare& share) {
  const PointKinematics& kinematics = point.contact.kinematics;
  const LocalLayout layout = linear.patch.of_displacements().layout();
  const PairVector h = kinematics.jump_weights();
  linear.gap_variation += mean_variation(gap_variation(kinematics, point.vary, share), loads.gap[node],
                                         loads.area[node]);
  for (Index n = 0; n < layout.nodes(); ++n) {
    linear.traction_work.segment<3>(layout.displacement(n, 0)) += share.value * h[n] * kinematics.area_vector;
  }
}

void ContactPass::add_jump(NodeLinearisation& linear, std::size_t k, const NodalLoads& loads, Index node,
                           const VaryingPoint& point, const PointShare& share) {
  const PointKinematics& kinematics = point.contact.kinematics;
  const int field = point.contact.fields[k];
  const double area = loads.flux_area(field, node);
  linear.jumps[k].weights += share.value * kinematics.area / area * kinematics.jump_weights();
  if (!linear.patch.displacements) return;
  const PairVector values = point.contact.values.col(static_cast<Index>(k));
  const WeightedVariation varied = jump_variation(kinematics, point.vary, share, values);
  linear.jumps[k].drift += mean_variation(varied, loads.jump(field, node), area);
}

std::vector<ContactPass::NodeLinearisation> ContactPass::linearise(const NodalLoads& loads,
                                                                   const SurfaceFields& primary,
                                                                   const SurfaceFields& secondary) const {
  const auto around = pairs_around_nodes(loads.in_contact);
  std::vector<NodeLinearisation> nodes(around.size());
  in_parallel(around.size(), [&](std::size_t node) {
    if (around[node].empty() && !has_unknown_multipliers()) return;
    nodes[node] = zero_linearisation(node_patch(static_cast<Index>(node), around[node]));
  });
  const auto corners_of = [&](std::size_t index) {
    return linearise_corners(pairs_[index], loads, primary, secondary);
  };
  in_order(pairs_.size(), corners_of, [&](std::size_t /*index*/, const std::vector<NodeLinearisation>& corners) {
    for (std::size_t a = 0; a < corners.size(); ++a) {
      const auto node = static_cast<std::size_t>(corners[a].patch.primary[a]);
      if (loads.in_contact[node]) add(nodes[node], corners[a]);
    }
  });
  return nodes;
}

}  // namespace mixture_contact
