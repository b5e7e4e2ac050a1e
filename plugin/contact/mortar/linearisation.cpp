#include "mortar/linearisation.h"

#include "base/bytes.h"
#include "base/parallel.h"
#include "mortar/loaded_points.h"

#include <algorithm>

namespace mixture_contact {
namespace {

Index position_in(const IndexedVector<int>& list, int entry) {
  return std::find(list.begin(), list.end(), entry) - list.begin();
}

/// Where the nodes of a pair of facets stand in a larger patch.
IndexedVector<Index> dof_map(const Patch& pair, const Patch& patch) {
  IndexedVector<Index> map;
  map.reserve(pair.primary.size() + pair.secondary.size());
  for (const int node : pair.primary) map.push_back(position_in(patch.primary, node));
  for (const int node : pair.secondary) map.push_back(patch.primary.count() + position_in(patch.secondary, node));
  return map;
}

NodeLinearisation zero_linearisation(const Patch& patch) {
  NodeLinearisation linear;
  linear.patch = patch;
  if (patch.displacements) linear.gap_variation.setZero(patch.of_displacements().layout().size());
  linear.traction_work = linear.gap_variation;
  for (const int field : patch.fields) {
    linear.jumps.push_back({linear.gap_variation, VectorXd::Zero(patch.of_field(field, false).layout().size())});
  }
  return linear;
}

/// Adds what a pair of facets has around a node to the node's own.
void scatter(const NodeLinearisation& pair, NodeLinearisation& sum) {
  const IndexedVector<Index> place = dof_map(pair.patch, sum.patch);
  const LocalLayout layout = sum.patch.of_displacements().layout();
  const LocalLayout own = pair.patch.of_displacements().layout();
  const auto add_variation = [&](VectorXd& variation, const VectorXd& part) {
    if (!sum.patch.displacements) return;
    for (Index n = 0; n < place.count(); ++n) {
      variation.segment<3>(layout.displacement(place[n], 0)) += part.segment<3>(own.displacement(n, 0));
    }
  };
  add_variation(sum.gap_variation, pair.gap_variation);
  add_variation(sum.traction_work, pair.traction_work);
  for (Index f = 0; f < pair.patch.fields.count(); ++f) {
    NodeLinearisation::Jump& jump = sum.jumps[position_in(sum.patch.fields, pair.patch.fields[f])];
    add_variation(jump.projection_variation, pair.jumps[f].projection_variation);
    for (Index n = 0; n < place.count(); ++n) jump.weights[place[n]] += pair.jumps[f].weights[n];
  }
}

PointShare share_of(const VaryingPoint& point, Index corner) {
  const double weight = point.contact.loads.weight;
  const double psi = point.contact.psi[corner];
  return {weight * psi, weight * (psi * point.vary.weight + point.contact.psi_gradient.row(corner) * point.vary.xi)};
}

/// First variation of an average over a node, g_a = INT psi_a g da / A_a:
/// dg_a = sum_q [w psi_a |a| dg + (g - g_a) d(w psi_a |a|)]/A_a.
PairVariation<1> mean_variation(const WeightedVariation& varied, double mean, double area) {
  return (varied.integral - mean * varied.area) / area;
}

void add_gap(NodeLinearisation& linear, const NodalLoads& loads, Index node, const VaryingPoint& point,
             const PointShare& share) {
  const PointKinematics& kinematics = point.contact.kinematics;
  const LocalLayout layout = linear.patch.of_displacements().layout();
  const PairVector h = kinematics.jump_weights();
  linear.gap_variation += mean_variation(gap_variation(kinematics, point.vary, share), loads.gap[node] + loads.offset,
                                         loads.area[node]);
  for (Index n = 0; n < layout.nodes(); ++n) {
    linear.traction_work.segment<3>(layout.displacement(n, 0)) += share.value * h[n] * kinematics.area_vector;
  }
}

void add_jump(NodeLinearisation& linear, Index k, const NodalLoads& loads, Index node, const VaryingPoint& point,
              const PointShare& share) {
  const PointKinematics& kinematics = point.contact.kinematics;
  const int field = point.contact.fields[k];
  const double area = loads.flux_area(field, node);
  linear.jumps[k].weights += share.value * kinematics.area / area * kinematics.jump_weights();
  if (!linear.patch.displacements) return;
  const PairVector values = point.contact.values.col(k);
  const WeightedVariation varied = jump_variation(kinematics, point.vary, share, values);
  linear.jumps[k].projection_variation += mean_variation(varied, loads.jump(field, node), area);
}

/// What a pair of facets has around each node of its primary facet; nothing where it carries no load.
IndexedVector<NodeLinearisation> linearise_corners(const MortarSpace& space, const FacetPair& pair,
                                                   const NodalLoads& loads, const FacingFields& fields) {
  if (!space.facing().has_node_among(pair, loads.in_contact)) return {};
  const Patch patch = space.facing().patch(pair);
  IndexedVector<NodeLinearisation> corners(patch.primary.count(), zero_linearisation(patch));
  ScopedTimer laps(space.effect_times(), space.effects().scalar_fields());
  const std::vector<VaryingPoint> points = varying_points(space, pair, loads, fields, 1.0);
  const auto for_each_corner_of_points = [&](const auto& use) {
    for (const VaryingPoint& point : points) {
      for (Index a = 0; a < corners.count(); ++a) {
        const int node = patch.primary[a];
        if (loads.in_contact[node]) use(corners[a], node, point, share_of(point, a));
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
  for (Index k = 0; k < patch.fields.count(); ++k) {
    for_each_corner_of_points([&](auto& linear, int node, const VaryingPoint& point, const PointShare& share) {
      add_jump(linear, k, loads, node, point, share);
    });
    laps.field(patch.fields[k]);
  }
  return corners;
}

/// Displacements of a patch's nodes in the order of patch.of_displacements(), given those of both surfaces.
VectorXd displacements_at(const Patch& patch, const FacingFields& change) {
  const LocalLayout layout = patch.of_displacements().layout();
  VectorXd values(layout.size());
  for (Index n = 0; n < layout.nodes(); ++n) {
    const SurfaceFields& surface = n < layout.primary_nodes() ? change.primary : change.secondary;
    values.segment<3>(layout.displacement(n, 0)) = surface.position.col(patch.node(n));
  }
  return values;
}

SurfaceFields change(const SurfaceFields& from, const SurfaceFields& to) {
  return {to.position - from.position, to.scalar - from.scalar};
}

std::size_t bytes_of(const NodalLoads& loads) {
  return bytes(loads.area) + bytes(loads.gap) + bytes(loads.traction) + bytes(loads.flux_area) + bytes(loads.jump) +
         bytes(loads.flux);
}

std::size_t bytes_of(const SurfaceFields& fields) { return bytes(fields.position) + bytes(fields.scalar); }

}  // namespace

IndexedVector<NodeLinearisation> linearise(const MortarSpace& space, const NodalLoads& loads,
                                           const FacingFields& fields) {
  const FacingPairs& facing = space.facing();
  const auto around = facing.around(loads.in_contact);
  IndexedVector<NodeLinearisation> nodes(around.count());
  in_parallel(around.count(), [&](Index node) {
    if (around[node].empty() && !space.has_unknown_multipliers()) return;
    nodes[node] = zero_linearisation(space.node_patch(node, around[node]));
  });
  const auto corners_of = [&](Index index) { return linearise_corners(space, facing.pairs()[index], loads, fields); };
  in_order(facing.pairs().count(), corners_of, [&](Index /*index*/, const IndexedVector<NodeLinearisation>& corners) {
    for (Index a = 0; a < corners.count(); ++a) {
      const int node = corners[a].patch.primary[a];
      if (loads.in_contact[node]) scatter(corners[a], nodes[node]);
    }
  });
  return nodes;
}

double jump_of(const NodeLinearisation& linear, Index k, const FacingFields& fields) {
  const int field = linear.patch.fields[k];
  const LocalLayout layout = linear.patch.of_field(field, false).layout();
  double jump = 0;
  for (Index n = 0; n < layout.nodes(); ++n) {
    const SurfaceFields& surface = n < layout.primary_nodes() ? fields.primary : fields.secondary;
    jump += linear.jumps[k].weights[layout.scalar(n, 0)] * surface.scalar(linear.patch.node(n), field);
  }
  return jump;
}

VectorXd jump_row(const NodeLinearisation::Jump& jump, const Patch& columns) {
  const LocalLayout layout = columns.layout();
  const LocalLayout displacements = columns.of_displacements().layout();
  VectorXd row = VectorXd::Zero(layout.size());
  for (Index n = 0; n < layout.nodes(); ++n) {
    row[layout.scalar(n, 0)] = jump.weights[n];
    if (!layout.has_displacements()) continue;
    row.segment<3>(layout.displacement(n, 0)) = jump.projection_variation.segment<3>(displacements.displacement(n, 0));
  }
  return row;
}

NodalLoads LinearisationPoint::predicted_averages(const FacingFields& fields) const {
  NodalLoads predicted = loads;
  const SurfaceFields first = change(primary, fields.primary);
  const SurfaceFields second = change(secondary, fields.secondary);
  in_parallel(nodes.count(), [&](Index node) {
    const NodeLinearisation& linear = nodes[node];
    if (linear.empty()) return;
    const VectorXd moved = displacements_at(linear.patch, {first, second});
    predicted.gap[node] += linear.gap_variation.dot(moved);
    for (Index k = 0; k < linear.jumps.count(); ++k) {
      predicted.jump(linear.patch.fields[k], node) += linear.jumps[k].projection_variation.dot(moved) +
                                                      jump_of(linear, k, {first, second});
    }
  });
  return predicted;
}

std::size_t LinearisationPoint::memory() const {
  std::size_t sum = bytes_of(loads) + bytes_of(primary) + bytes_of(secondary) + bytes(geometric_traction) +
                    bytes(geometric_flux) + bytes(equation_weights) + bytes(nodes);
  for (const NodeLinearisation& node : nodes) {
    sum += bytes(node.patch) + bytes(node.gap_variation) + bytes(node.traction_work) + bytes(node.jumps);
    for (const NodeLinearisation::Jump& jump : node.jumps)
      sum += bytes(jump.projection_variation) + bytes(jump.weights);
  }
  return sum;
}

}  // namespace mixture_contact
