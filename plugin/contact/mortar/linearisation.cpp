#include "mortar/linearisation.h"

#include "base/bytes.h"
#include "base/parallel.h"
#include "mortar/slips.h"
#include "mortar/varying_pairs.h"

#include <algorithm>

namespace mixture_contact {
namespace {

Index position_in(const IndexedVector<int>& list, int entry) {
  return std::find(list.begin(), list.end(), entry) - list.begin();
}

/// Where the nodes of a pair of facets stand in a larger patch.
using PairPlaces = Eigen::Matrix<Index, Eigen::Dynamic, 1, 0, max_pair_nodes, 1>;
PairPlaces dof_map(const Patch& pair, const Patch& patch) {
  PairPlaces map(pair.layout().nodes());
  Index n = 0;
  for (const int node : pair.primary) map[n++] = position_in(patch.primary, node);
  for (const int node : pair.secondary) map[n++] = patch.primary.count() + position_in(patch.secondary, node);
  return map;
}

/// What a pair of facets has around the nodes of its primary facet, one column for each of them; rows are those of a
/// NodeLinearisation of the pair's patch.
struct PairLinearisation {
  struct Jump {
    MatrixXd projection_variation;
    MatrixXd weights;
  };
  Patch patch;
  IndexedVector<bool> is_averaged;  ///< per node: whether its averages are taken over points of the pair
  MatrixXd gap_variation;
  MatrixXd traction_work;
  IndexedVector<Jump> jumps;
  IndexedVector<NodeLinearisation::Friction> friction;  ///< per node; empty without friction
};

void set_zero(NodeLinearisation::Friction& friction, const LocalLayout& displacements, const Effects& effects) {
  friction.slip_variation.setZero(3, displacements.size());
  friction.area_vector_variation.setZero(3, displacements.size());
  friction.work.setZero(displacements.nodes());
  if (!effects.has_bearing_fluid()) return;
  friction.pressure_field = effects.pressure_field();
  friction.pressure_variation.setZero(displacements.size());
  friction.pressure_weights.setZero(displacements.nodes());
}

NodeLinearisation zero_linearisation(const MortarSpace& space, const Patch& patch) {
  NodeLinearisation linear;
  linear.patch = patch;
  if (space.effects().has_friction()) set_zero(linear.friction, patch.of_displacements().layout(), space.effects());
  if (patch.displacements) linear.gap_variation.setZero(patch.of_displacements().layout().size());
  linear.traction_work = linear.gap_variation;
  for (const int field : patch.fields) {
    linear.jumps.push_back({linear.gap_variation, VectorXd::Zero(patch.of_field(field, false).layout().size())});
  }
  return linear;
}

PairLinearisation zero_linearisation(const MortarSpace& space, const FacetPair& pair) {
  PairLinearisation linear;
  linear.patch = space.facing().patch(pair);
  const LocalLayout layout = linear.patch.of_displacements().layout();
  const Index corners = layout.primary_nodes();
  linear.is_averaged.assign(linear.patch.primary.size(), false);
  if (linear.patch.displacements) linear.gap_variation.setZero(layout.size(), corners);
  linear.traction_work = linear.gap_variation;
  const PairLinearisation::Jump none{linear.gap_variation, MatrixXd::Zero(layout.nodes(), corners)};
  linear.jumps.assign(linear.patch.fields.size(), none);
  if (!space.effects().has_friction()) return linear;
  linear.friction = IndexedVector<NodeLinearisation::Friction>(corners);
  for (NodeLinearisation::Friction& friction : linear.friction) set_zero(friction, layout, space.effects());
  return linear;
}

void scatter(const NodeLinearisation::Friction& pair, const PairPlaces& place, NodeLinearisation::Friction& sum) {
  for (Index n = 0; n < place.size(); ++n) {
    sum.slip_variation.middleCols<3>(3 * place[n]) += pair.slip_variation.middleCols<3>(3 * n);
    sum.area_vector_variation.middleCols<3>(3 * place[n]) += pair.area_vector_variation.middleCols<3>(3 * n);
    sum.work[place[n]] += pair.work[n];
    if (!sum.has_fluid()) continue;
    sum.pressure_variation.segment<3>(3 * place[n]) += pair.pressure_variation.segment<3>(3 * n);
    sum.pressure_weights[place[n]] += pair.pressure_weights[n];
  }
}

/// Adds what a pair of facets has around a node of its primary facet to the node's own.
void scatter(const PairLinearisation& pair, Index corner, NodeLinearisation& sum) {
  const PairPlaces place = dof_map(pair.patch, sum.patch);
  const LocalLayout layout = sum.patch.of_displacements().layout();
  const LocalLayout own = pair.patch.of_displacements().layout();
  const auto add_variation = [&](VectorXd& variation, const MatrixXd& part) {
    if (!sum.patch.displacements) return;
    for (Index n = 0; n < place.size(); ++n) {
      variation.segment<3>(layout.displacement(place[n], 0)) += part.col(corner).segment<3>(own.displacement(n, 0));
    }
  };
  add_variation(sum.gap_variation, pair.gap_variation);
  add_variation(sum.traction_work, pair.traction_work);
  if (!sum.friction.empty()) scatter(pair.friction[corner], place, sum.friction);
  for (Index f = 0; f < pair.patch.fields.count(); ++f) {
    NodeLinearisation::Jump& jump = sum.jumps[position_in(sum.patch.fields, pair.patch.fields[f])];
    add_variation(jump.projection_variation, pair.jumps[f].projection_variation);
    for (Index n = 0; n < place.size(); ++n) jump.weights[place[n]] += pair.jumps[f].weights(n, corner);
  }
}

/// A point as it counts for a node of its primary facet.
struct CornerPoint {
  const VaryingPoint& point;
  Index number;  ///< of the point
  Index corner;
  int node;
  PointShare share;
  PairVariation<1> area;  ///< d(w psi_a |a|)
};

/// For all nodes in contact whose averages are taken over it.
std::vector<CornerPoint> corner_points(const Facet& facet, const std::vector<VaryingPoint>& points,
                                       const NodeFlags& in_contact) {
  std::vector<CornerPoint> found;
  found.reserve(points.size() * indexing::entries(facet.count()));
  for (Index q = 0; q < count_of(points); ++q) {
    const auto& [contact, vary] = at(points, q);
    const double weight = contact.loads.weight;
    for (Index a = 0; a < facet.count(); ++a) {
      if (!in_contact[facet.node(a)]) continue;
      const PointShare share{weight * contact.psi[a], weight * contact.psi_gradient.row(a)};
      if (share.is_zero()) continue;
      found.push_back({at(points, q), q, a, facet.node(a), share, area_variation(contact.kinematics, vary, share)});
    }
  }
  return found;
}

/// Adds a point's part in the first variation of an average over a node, g_a = INT psi_a g da / A_a:
/// dg_a = sum_q [w psi_a |a| dg + (g - g_a) d(w psi_a |a|)]/A_a.
void add_mean_variation(Eigen::Ref<VectorXd> sum, const CornerPoint& at, const PairVariation<1>& variation,
                        double excess, double area) {
  const double part = at.share.value * at.point.contact.kinematics.area;
  sum += (part / area * variation + excess / area * at.area).transpose();
}

void add_gap(PairLinearisation& linear, const LocalLayout& layout, const NodalLoads& loads, const CornerPoint& at) {
  const PointKinematics& kinematics = at.point.contact.kinematics;
  const PairVector h = kinematics.jump_weights();
  const double excess = kinematics.gap - loads.gap[at.node] - loads.offset;
  add_mean_variation(linear.gap_variation.col(at.corner), at, at.point.vary.gap, excess, loads.area[at.node]);
  auto work = linear.traction_work.col(at.corner);
  for (Index n = 0; n < layout.nodes(); ++n) {
    work.segment<3>(layout.displacement(n, 0)) += at.share.value * h[n] * kinematics.area_vector;
  }
}

void add_jump(PairLinearisation& linear, Index k, const NodalLoads& loads, const CornerPoint& at) {
  const auto& [contact, vary] = at.point;
  const int field = contact.fields[k];
  const double area = loads.flux_area(field, at.node);
  const PairVector h = contact.kinematics.jump_weights();
  linear.jumps[k].weights.col(at.corner) += at.share.value * contact.kinematics.area / area * h;
  if (!linear.patch.displacements) return;
  const PairVector values = contact.values.col(k);
  add_mean_variation(linear.jumps[k].projection_variation.col(at.corner), at,
                     jump_variation(contact.kinematics, vary, values), h.dot(values) - loads.jump(field, at.node),
                     area);
}

/// What friction needs of a point, whichever of its nodes is looked at.
struct SlidingPoint {
  Vector3d slip;
  PairVariation<3> slip_variation;
  double pressure;
  PairVariation<1> pressure_variation;
  PairVector pressure_weights;
};

SlidingPoint sliding_point(const MortarSpace& space, const FacetPair& pair, const IntegrationPoint& place,
                           const VaryingPoint& point, const BearingPressure& pressure) {
  const PointKinematics& kinematics = point.contact.kinematics;
  const Facet& facet = space.facing().primary_facet(pair);
  const PastPoint past = past_point(space, pair, kinematics);
  const Eigen::Matrix3d curvature = facet_coordinates(facet, space.past().primary) *
                                    shape_hessian(facet.type, place.xi);
  return {slip(past), slip_variation(past, normal_slope(past, curvature), point.vary),
          pressure_at(pressure, kinematics), pressure_variation(pressure, kinematics, point.vary),
          pressure_weights(pressure, kinematics)};
}

/// Averages as in add_gap().
void add_sliding(NodeLinearisation::Friction& friction, const NodalLoads& loads, const CornerPoint& at,
                 const SlidingPoint& sliding) {
  const auto& [contact, vary] = at.point;
  const PointKinematics& kinematics = contact.kinematics;
  const double whole = loads.area[at.node];
  const double per_area = at.share.value / whole;
  const double part = per_area * kinematics.area;
  const PairVariation<1> weight = at.share.variation(vary) / whole;
  const PairVariation<1> area = at.area / whole;
  const Vector3d slip = sliding.slip - loads.friction.slip.col(at.node);
  friction.slip_variation += part * sliding.slip_variation + slip.lazyProduct(area);
  friction.area_vector_variation += per_area * vary.area_vector + kinematics.area_vector.lazyProduct(weight) -
                                    loads.friction.area_vector.col(at.node).lazyProduct(area);
  friction.work += at.share.value * kinematics.area * kinematics.jump_weights();
  if (!friction.has_fluid()) return;
  const double pressure = sliding.pressure - loads.friction.pressure[at.node];
  friction.pressure_variation += (part * sliding.pressure_variation + pressure * area).transpose();
  friction.pressure_weights += part * sliding.pressure_weights;
}

void add_sliding(PairLinearisation& linear, const MortarSpace& space, const FacetPair& pair,
                 const std::vector<CornerPoint>& points, const NodalLoads& loads, const FacingFields& fields) {
  const BearingPressure pressure = bearing_pressure(space, pair, fields);
  std::optional<SlidingPoint> sliding;
  Index number = -1;
  for (const CornerPoint& at : points) {
    if (!sliding || at.number != number)
      sliding = sliding_point(space, pair, indexing::at(pair.points, at.number), at.point, pressure);
    number = at.number;
    add_sliding(linear.friction[at.corner], loads, at, *sliding);
  }
}

PairLinearisation linearise_pair(const MortarSpace& space, const FacetPair& pair,
                                 const std::vector<VaryingPoint>& points, const NodalLoads& loads,
                                 const FacingFields& fields) {
  PairLinearisation linear = zero_linearisation(space, pair);
  const Patch& patch = linear.patch;
  const LocalLayout layout = patch.of_displacements().layout();
  ScopedTimer laps(space.effect_times(), space.effects().scalar_fields());
  const std::vector<CornerPoint> all = corner_points(space.facing().primary_facet(pair), points, loads.in_contact);
  for (const CornerPoint& at : all) linear.is_averaged[at.corner] = true;
  if (patch.displacements) {
    for (const CornerPoint& at : all) add_gap(linear, layout, loads, at);
    laps.traction();
  }
  if (space.effects().has_friction()) {
    add_sliding(linear, space, pair, all, loads, fields);
    laps.friction();
  }
  for (Index k = 0; k < patch.fields.count(); ++k) {
    for (const CornerPoint& at : all) add_jump(linear, k, loads, at);
    laps.field(patch.fields[k]);
  }
  return linear;
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

/// Adds the changes of a node's averages.
void predict(NodalFriction& friction, Index node, const NodeLinearisation& linear, const VectorXd& moved,
             const FacingFields& change) {
  friction.slip.col(node) += linear.friction.slip_variation * moved;
  friction.trial.col(node) += linear.friction.trial_variation * moved;
  friction.area_vector.col(node) += linear.friction.area_vector_variation * moved;
  friction.convection[node] += convection_change(linear, moved);
  if (!linear.friction.has_fluid()) return;
  friction.pressure[node] += linear.friction.pressure_variation.dot(moved);
  const LocalLayout layout = linear.patch.of_displacements().layout();
  for (Index n = 0; n < layout.nodes(); ++n) {
    const double weight = linear.friction.pressure_weights[n];
    if (weight == 0) continue;
    const SurfaceFields& surface = n < layout.primary_nodes() ? change.primary : change.secondary;
    friction.pressure[node] += weight * surface.scalar(linear.patch.node(n), linear.friction.pressure_field);
  }
}

SurfaceFields change(const SurfaceFields& from, const SurfaceFields& to) {
  return {to.position - from.position, to.scalar - from.scalar};
}

std::size_t bytes_of(const NodalFriction& friction) {
  return bytes(friction.slip) + bytes(friction.area_vector) + bytes(friction.pressure) + bytes(friction.convection) +
         bytes(friction.trial) + bytes(friction.reference) + bytes(friction.reference_bound) +
         bytes(friction.geometric) + bytes(friction.bound) + bytes(friction.traction);
}

std::size_t bytes_of(const NodalLoads& loads) {
  return bytes(loads.area) + bytes(loads.gap) + bytes(loads.traction) + bytes(loads.flux_area) + bytes(loads.jump) +
         bytes(loads.flux) + bytes_of(loads.friction);
}

std::size_t bytes_of(const NodeLinearisation::Friction& friction) {
  return bytes(friction.slip_variation) + bytes(friction.area_vector_variation) + bytes(friction.trial_variation) +
         bytes(friction.convection) + bytes(friction.work) + bytes(friction.pressure_variation) +
         bytes(friction.pressure_weights);
}

std::size_t bytes_of(const SurfaceFields& fields) { return bytes(fields.position) + bytes(fields.scalar); }

}  // namespace

IndexedVector<NodeLinearisation> linearise(const MortarSpace& space, const NodalLoads& loads,
                                           const FacingFields& fields) {
  return linearise(space, loads, fields, loads, [](Index, const std::vector<VaryingPoint>&) {});
}

IndexedVector<NodeLinearisation> linearise(const MortarSpace& space, const NodalLoads& loads,
                                           const FacingFields& fields, const NodalLoads& carried,
                                           const UseVaryingPoints& use) {
  const FacingPairs& facing = space.facing();
  const auto around = facing.around(loads.in_contact);
  IndexedVector<NodeLinearisation> nodes(around.count());
  in_parallel(around.count(), [&](Index node) {
    if (around[node].empty() && !space.has_unknown_multipliers()) return;
    nodes[node] = zero_linearisation(space, space.node_patch(node, around[node]));
    if (nodes[node].friction.empty()) return;
    nodes[node].friction.convection = convection_around(facing, space.past().primary, node, around[node],
                                                        nodes[node].patch.primary);
  });
  const auto linear_pair = [&](Index index) {
    const FacetPair& pair = facing.pairs()[index];
    if (!facing.has_node_among(pair, loads.in_contact)) return PairLinearisation();
    const std::vector<VaryingPoint> points = varying_points(space, pair, carried, fields, 1.0);
    use(index, points);
    return linearise_pair(space, pair, points, loads, fields);
  };
  in_order(facing.pairs().count(), linear_pair, [&](Index /*index*/, const PairLinearisation& pair) {
    for (Index a = 0; a < pair.patch.primary.count(); ++a) {
      if (pair.is_averaged[a]) scatter(pair, a, nodes[pair.patch.primary[a]]);
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

Eigen::Matrix3d convection_change(const NodeLinearisation& linear, const VectorXd& moved) {
  Eigen::Matrix3d change = Eigen::Matrix3d::Zero();
  const Matrix3Xd& c = linear.friction.convection;
  for (Index b = 0; b < c.cols(); ++b) change += moved.segment<3>(3 * b) * c.col(b).transpose();
  return change;
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
    if (!linear.friction.empty()) predict(predicted.friction, node, linear, moved, {first, second});
    for (Index k = 0; k < linear.jumps.count(); ++k) {
      predicted.jump(linear.patch.fields[k], node) += linear.jumps[k].projection_variation.dot(moved) +
                                                      jump_of(linear, k, {first, second});
    }
  });
  return predicted;
}

std::size_t LinearisationPoint::memory() const {
  std::size_t sum = bytes_of(loads) + bytes_of(primary) + bytes_of(secondary) + bytes(geometric_traction) +
                    bytes(geometric_flux) + bytes(geometric_friction) + bytes(equation_weights) + bytes(nodes);
  for (const NodeLinearisation& node : nodes) {
    sum += bytes(node.patch) + bytes(node.gap_variation) + bytes(node.traction_work) + bytes(node.jumps);
    sum += bytes_of(node.friction);
    for (const NodeLinearisation::Jump& jump : node.jumps)
      sum += bytes(jump.projection_variation) + bytes(jump.weights);
  }
  return sum;
}

}  // namespace mixture_contact
