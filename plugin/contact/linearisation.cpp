/// First variations of the averages and works of each node: a part of ContactPass.
#include "pass.h"

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

Patch ContactPass::facet_patch(const FacetPair& pair) const {
  const auto nodes = [](const Facet& facet) {
    return std::vector<int>(facet.nodes.begin(), facet.nodes.begin() + node_count(facet.type));
  };
  return {nodes(primary_facet(pair)), nodes(secondary_facet(pair)), exchanged_fields(pair)};
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

}  // namespace mixture_contact
