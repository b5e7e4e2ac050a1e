#include "mortar/linearisation.h"

#include "base/bytes.h"
#include "base/in_order.h"
#include "mortar/slips.h"
#include "mortar/varying_pairs.h"

#include <algorithm>
#include <iterator>

namespace mixture_contact {
namespace {

/// The positions of a pair's nodes in a larger patch.
using PairPlaces = Eigen::Matrix<Index, Eigen::Dynamic, 1, 0, max_pair_nodes, 1>;
template <class Nodes>
PairPlaces dof_map(const Nodes& primary, const Nodes& secondary, const Patch& patch) {
  PairPlaces map(std::distance(primary.begin(), primary.end()) + std::distance(secondary.begin(), secondary.end()));
  Index n = 0;
  for (const int node : primary) map[n++] = position_in(patch.primary, node);
  for (const int node : secondary) map[n++] = patch.primary.count() + position_in(patch.secondary, node);
  return map;
}

/// Adds the variation of a pair, in the order of its nodes, to that of a patch.
template <class Part>
void add_variation(VectorXd& sum, const Eigen::MatrixBase<Part>& part, const PairPlaces& place) {
  for (Index n = 0; n < place.size(); ++n) sum.segment<3>(3 * place[n]) += part.template segment<3>(3 * n);
}

/// The part of a pair in NodeLinearisation::Friction of one node of its primary facet.
struct PairFriction {
  PairVariation<6> average_variation;
  PairVariation<1> area_variation;  ///< variation of the node's area
  PairVector work;
  /// Variation of the pressure, as NodeLinearisation::Friction::pressure_variation; empty without fluid.
  PairVariation<1> pressure_variation;
  // Empty without fluid.
  PairVector pressure_weights;
};

/// The parts of a pair in the linearisations of the nodes of its primary facet, one column per node. Rows have the
/// order of a NodeLinearisation of the pair's patch.
struct PairLinearisation {
  struct Jump {
    MatrixXd projection_variation;
    MatrixXd weights;
  };
  Patch patch;
  IndexedVector<bool> is_averaged;  ///< per node: true if its averages include points of the pair
  MatrixXd gap_variation;
  MatrixXd traction_work;
  IndexedVector<Jump> jumps;
  IndexedVector<PairFriction> friction;  ///< quantities of friction, per node; empty without friction
};

/// The number of nodes, from the first of a patch, on which the mean normal or the area depends: all nodes if points
/// move on their facets, else the primary ones.
Index turning_nodes(const FacingPairs& facing, Index nodes, Index primary_nodes) {
  return facing.moves_points() ? nodes : primary_nodes;
}

/// Sets the variations of friction of a node or of a pair to zero, except the average_variation.
template <class Friction>
void set_rest_zero(Friction& friction, const LocalLayout& displacements, const Effects& effects) {
  friction.area_variation.setZero(displacements.size());
  friction.work.setZero(displacements.nodes());
  if (!effects.has_bearing_fluid()) return;
  friction.pressure_variation.setZero(displacements.size());
  friction.pressure_weights.setZero(displacements.nodes());
}

void set_zero(PairFriction& friction, const LocalLayout& displacements, const Effects& effects) {
  friction.average_variation.setZero(6, displacements.size());
  set_rest_zero(friction, displacements, effects);
}

void set_zero(NodeLinearisation::Friction& friction, const LocalLayout& displacements, const Effects& effects) {
  friction.average_variation.fill(displacements.nodes(), Eigen::Matrix<double, 6, 3>::Zero());
  set_rest_zero(friction, displacements, effects);
}

NodeLinearisation zero_linearisation(const MortarSpace& space, const Patch& patch) {
  NodeLinearisation linear;
  linear.patch = patch;
  const LocalLayout layout = patch.displacement_layout();
  if (space.effects().has_friction()) {
    set_zero(linear.friction, layout, space.effects());
    linear.friction.pressure_field = space.effects().pressure_field();
    linear.friction.turning = turning_nodes(space.facing(), layout.nodes(), layout.primary_nodes());
  }
  if (patch.displacements) linear.gap_variation.setZero(layout.size());
  linear.traction_work = linear.gap_variation;
  if (patch.fields.empty()) return linear;
  const NodeLinearisation::Jump none{linear.gap_variation, VectorXd::Zero(patch.field_layout(false).size())};
  linear.jumps.assign(patch.fields.size(), none);
  return linear;
}

/// Sets the linearisation of a pair to zero. It reuses the memory of another pair's.
void set_zero(PairLinearisation& linear, const MortarSpace& space, const FacetPair& pair) {
  space.facing().set_patch(pair, linear.patch);
  const LocalLayout layout = linear.patch.displacement_layout();
  const Index corners = layout.primary_nodes();
  const auto set_no_variation = [&](MatrixXd& variation) {
    if (linear.patch.displacements) variation.setZero(layout.size(), corners);
  };
  linear.is_averaged.fill(corners, false);
  set_no_variation(linear.gap_variation);
  set_no_variation(linear.traction_work);
  linear.jumps.resize(linear.patch.fields.size());
  for (PairLinearisation::Jump& jump : linear.jumps) {
    set_no_variation(jump.projection_variation);
    jump.weights.setZero(layout.nodes(), corners);
  }
  if (!space.effects().has_friction()) return;
  linear.friction.resize(indexing::entries(corners));
  for (PairFriction& friction : linear.friction) set_zero(friction, layout, space.effects());
}

void scatter(const PairFriction& pair, const PairPlaces& place, NodeLinearisation::Friction& sum) {
  for (Index n = 0; n < place.size(); ++n) {
    if (place[n] < sum.turning) {
      sum.average_variation[place[n]] += pair.average_variation.middleCols<3>(3 * n);
      sum.area_variation.segment<3>(3 * place[n]) += pair.area_variation.segment<3>(3 * n).transpose();
    } else {
      sum.average_variation[place[n]].topRows<3>() += pair.average_variation.block<3, 3>(0, 3 * n);
    }
    sum.work[place[n]] += pair.work[n];
    if (!sum.has_fluid()) continue;
    sum.pressure_variation.segment<3>(3 * place[n]) += pair.pressure_variation.segment<3>(3 * n).transpose();
    sum.pressure_weights[place[n]] += pair.pressure_weights[n];
  }
}

/// Adds the part of a pair to the linearisation of a node of its primary facet. `corner`: number of the node in the
/// facet.
void scatter(const PairLinearisation& pair, Index corner, NodeLinearisation& sum) {
  const PairPlaces place = dof_map(pair.patch.primary, pair.patch.secondary, sum.patch);
  const auto add = [&](VectorXd& variation, const MatrixXd& part) {
    if (sum.patch.displacements) add_variation(variation, part.col(corner), place);
  };
  add(sum.gap_variation, pair.gap_variation);
  add(sum.traction_work, pair.traction_work);
  if (!sum.friction.empty()) scatter(pair.friction[corner], place, sum.friction);
  for (Index f = 0; f < pair.patch.fields.count(); ++f) {
    NodeLinearisation::Jump& jump = sum.jumps[position_in(sum.patch.fields, pair.patch.fields[f])];
    add(jump.projection_variation, pair.jumps[f].projection_variation);
    for (Index n = 0; n < place.size(); ++n) jump.weights[place[n]] += pair.jumps[f].weights(n, corner);
  }
}

/// An integration point in the averages of one node of its primary facet.
struct CornerPoint {
  const VaryingPoint& point;
  Index number;  ///< number of the point in its pair
  Index corner;
  int node;
  double share;              ///< weight w psi_a
  Eigen::RowVector2d slope;  ///< gradient w psi_a,alpha of the weight

  /// Variation w psi_a,alpha dxi_alpha, for a point that moves on its facet.
  auto wandering() const { return slope.lazyProduct(point.vary.xi); }
  /// Variation d(w psi_a |a|).
  PairVariation<1> area_variation() const {
    PairVariation<1> variation = share * point.weighted_area_variation();
    if (point.vary.wanders()) variation += point.contact.kinematics.area * wandering();
    return variation;
  }
};

/// Working memory of a thread for one pair; it is reused for the next pair.
struct PairMemory {
  VaryingPair varying;
  std::vector<CornerPoint> corners;  ///< for each node in contact, the points of its averages
};

void set_corner_points(PairMemory& pair, const Facet& facet, const NodeFlags& in_contact) {
  pair.corners.clear();
  for (Index q = 0; q < count_of(pair.varying.points); ++q) {
    const VaryingPoint& point = at(pair.varying.points, q);
    const PointContact& contact = point.contact;
    for (Index a = 0; a < facet.count(); ++a) {
      if (!in_contact[facet.node(a)]) continue;
      const double share = contact.loads.weight * contact.psi[a];
      const Eigen::RowVector2d slope = contact.loads.weight * contact.psi_gradient.row(a);
      if (share != 0 || !slope.isZero(0)) pair.corners.push_back({point, q, a, facet.node(a), share, slope});
    }
  }
}

/// Adds the part of a point to the first variation of an average over a node, g_a = INT psi_a g da / A_a: dg_a = sum_q
/// [w psi_a |a| dg + (g - g_a) d(w psi_a |a|)]/A_a.
void add_mean_variation(Eigen::Ref<VectorXd> sum, const CornerPoint& at, const PairVariation<1>& variation,
                        double excess, double area) {
  const double size = at.point.contact.kinematics.area;
  const double change = excess / area;
  const KinematicVariations& vary = at.point.vary;
  auto row = sum.transpose();
  row += at.share * size / area * variation + change * at.share * vary.area;
  if (vary.wanders()) row += change * size * (at.share * vary.weight + at.wandering());
}

void add_gap(PairLinearisation& linear, const LocalLayout& layout, const NodalLoads& loads, const CornerPoint& at) {
  const PointKinematics& kinematics = at.point.contact.kinematics;
  const PairVector h = kinematics.jump_weights();
  const double excess = kinematics.gap - loads.gap[at.node] - loads.offset;
  add_mean_variation(linear.gap_variation.col(at.corner), at, at.point.vary.gap, excess, loads.area[at.node]);
  auto work = linear.traction_work.col(at.corner);
  for (Index n = 0; n < layout.nodes(); ++n) {
    work.segment<3>(layout.displacement(n, 0)) += at.share * h[n] * kinematics.area_vector;
  }
}

void add_jump(PairLinearisation& linear, Index k, const NodalLoads& loads, const CornerPoint& at) {
  const auto& [contact, vary] = at.point;
  const int field = contact.fields[k];
  const double area = loads.flux_area(field, at.node);
  const PairVector h = contact.kinematics.jump_weights();
  linear.jumps[k].weights.col(at.corner) += at.share * contact.kinematics.area / area * h;
  if (!linear.patch.displacements) return;
  const PairVector values = contact.values.col(k);
  add_mean_variation(linear.jumps[k].projection_variation.col(at.corner), at,
                     jump_variation(contact.kinematics, vary, values), h.dot(values) - loads.jump(field, at.node),
                     area);
}

/// The quantities of a point on which friction depends, the same for all nodes of its facet. The averages around node a
/// are sums of w psi_a y over the points, y = (|a| r, a), divided by the area A_a.
struct SlidingPoint {
  Eigen::Matrix<double, 6, 1> value;    ///< value of y
  PairVariation<6> variation;           ///< variation dy + y dw/w
  PairVector work;                      ///< work |a| h of the nodes
  Index turning = 0;                    ///< as NodeLinearisation::Friction::turning, for the nodes of the pair
  double pressure = 0;                  ///< pressure |a| (p~ - p*); without fluid, the next two members are empty
  PairVariation<1> pressure_variation;  ///< variation of |a| (p~ - p*) at fixed nodal values, plus |a| (p~ - p*) dw/w
  PairVector pressure_weights;          ///< derivatives of |a| (p~ - p*) with respect to the nodal values of p~
};

void set_pressure(SlidingPoint& sliding, const BearingPressure& pressure, const VaryingPoint& point) {
  const PointKinematics& kinematics = point.contact.kinematics;
  const double here = pressure_at(pressure, kinematics);
  sliding.pressure = kinematics.area * here;
  sliding.pressure_variation = kinematics.area * pressure_variation(pressure, kinematics, point.vary) +
                               here * point.weighted_area_variation();
  sliding.pressure_weights = kinematics.area * pressure_weights(pressure, kinematics);
}

/// Slope r,xi of the slip at a point of the primary facet.
Eigen::Matrix<double, 3, 2> slope_over_primary(const PastFacets& facets, const PastPoint& past, FacetType type,
                                               const Vector2d& xi) {
  return slip_slope_with_xi(past, normal_slope(past, facets.primary * shape_hessian(type, xi)));
}

SlidingPoint sliding_point(const MortarSpace& space, const FacetPair& pair, const PastFacets& facets,
                           const CornerPoint& at) {
  const auto& [contact, vary] = at.point;
  const PointKinematics& kinematics = contact.kinematics;
  const PastPoint past = past_point(kinematics, facets.primary, facets.secondary);
  const Vector3d r = slip(past);
  const PairVariation<1> darea = at.point.weighted_area_variation();
  SlidingPoint sliding;
  sliding.turning = vary.wanders() ? kinematics.nodes() : kinematics.primary_nodes();
  sliding.value << kinematics.area * r, kinematics.area_vector;
  sliding.variation.resize(6, darea.size());
  const Eigen::Matrix<double, 3, 2> with_eta = kinematics.area * slip_slope_with_eta(past);
  Eigen::Matrix<double, 3, 2> with_xi = Eigen::Matrix<double, 3, 2>::Zero();
  if (vary.wanders()) {
    const Facet& facet = space.facing().primary_facet(pair);
    with_xi = kinematics.area * slope_over_primary(facets, past, facet.type, space.facing().points(pair)[at.number].xi);
  }
  for (Index column = 0; column < darea.size(); ++column) {
    Vector3d facing = with_eta.lazyProduct(vary.eta.col(column));
    Vector3d normal = vary.area_vector.col(column);
    if (vary.wanders()) {
      facing += with_xi.lazyProduct(vary.xi.col(column));
      normal += vary.weight[column] * kinematics.area_vector;
    }
    sliding.variation.col(column).head<3>() = facing + darea[column] * r;
    sliding.variation.col(column).tail<3>() = normal;
  }
  sliding.work = kinematics.area * kinematics.jump_weights();
  return sliding;
}

/// Adds the part of a point to the sums around a node: d(w psi_a y) = w psi_a (dy + y dw/w) + y w psi_a,alpha
/// dxi_alpha.
void add_sliding(PairFriction& sum, const CornerPoint& at, const SlidingPoint& sliding) {
  const double share = at.share;
  const bool wanders = at.point.vary.wanders();
  PairVariation<1> wandering;
  if (wanders) wandering = at.wandering();
  sum.area_variation += at.area_variation();
  sum.work += share * sliding.work;
  const bool has_fluid = sum.pressure_weights.size() > 0;
  if (has_fluid) {
    sum.pressure_variation += share * sliding.pressure_variation;
    sum.pressure_weights += share * sliding.pressure_weights;
  }
  for (Index n = 0; n < sliding.turning; ++n) {
    Eigen::Matrix<double, 6, 3> change = share * sliding.variation.middleCols<3>(3 * n);
    if (wanders) change += sliding.value.lazyProduct(wandering.segment<3>(3 * n));
    sum.average_variation.middleCols<3>(3 * n) += change;
  }
  for (Index n = sliding.turning; n < sum.work.size(); ++n)
    sum.average_variation.block<3, 3>(0, 3 * n) += share * sliding.variation.block<3, 3>(0, 3 * n);
  if (has_fluid && wanders) sum.pressure_variation += sliding.pressure * wandering;
}

/// Divides the sums around a node by its area: d(Y/A) = (dY - Y/A dA)/A.
void divide_by_area(NodeLinearisation::Friction& sum, const NodalLoads& loads, Index node) {
  const double per_area = 1 / loads.area[node];
  const NodalFriction& friction = loads.friction;
  Eigen::Matrix<double, 6, 1> average;
  average << friction.slip.col(node), friction.area_vector.col(node);
  for (Index n = 0; n < sum.turning; ++n) {
    const Eigen::RowVector3d area_variation = sum.area_variation.segment<3>(3 * n);
    sum.average_variation[n] = per_area * (sum.average_variation[n] - average.lazyProduct(area_variation));
  }
  for (Index n = sum.turning; n < sum.average_variation.count(); ++n) sum.average_variation[n].topRows<3>() *= per_area;
  if (!sum.has_fluid()) return;
  sum.pressure_variation = per_area * (sum.pressure_variation - friction.pressure[node] * sum.area_variation);
  sum.pressure_weights *= per_area;
}

void add_sliding(PairLinearisation& linear, const MortarSpace& space, const FacetPair& pair,
                 const std::vector<CornerPoint>& points, const FacingFields& fields) {
  const PastFacets past = past_facets(space, pair);
  const BearingPressure pressure = bearing_pressure(space, pair, fields);
  for (auto at = points.begin(); at != points.end();) {
    const Index number = at->number;
    SlidingPoint sliding = sliding_point(space, pair, past, *at);
    if (space.effects().has_bearing_fluid()) set_pressure(sliding, pressure, at->point);
    for (; at != points.end() && at->number == number; ++at) add_sliding(linear.friction[at->corner], *at, sliding);
  }
}

void linearise_pair(const MortarSpace& space, const FacetPair& pair, PairMemory& memory, const NodalLoads& loads,
                    const FacingFields& fields, PairLinearisation& linear) {
  set_zero(linear, space, pair);
  const Patch& patch = linear.patch;
  ScopedTimer laps(space.effect_times(), space.effects().scalar_fields(), stands_for(space.facing(), pair));
  const Facet& facet = space.facing().primary_facet(pair);
  set_corner_points(memory, facet, loads.in_contact);
  for (const CornerPoint& at : memory.corners) linear.is_averaged[at.corner] = true;
  if (patch.displacements) {
    const LocalLayout layout = patch.displacement_layout();
    for (const CornerPoint& at : memory.corners) add_gap(linear, layout, loads, at);
    laps.traction();
  }
  if (space.effects().has_friction()) {
    add_sliding(linear, space, pair, memory.corners, fields);
    laps.friction();
  }
  for (Index k = 0; k < patch.fields.count(); ++k) {
    for (const CornerPoint& at : memory.corners) add_jump(linear, k, loads, at);
    laps.field(patch.fields[k]);
  }
}

/// Adds the part of a flat pair to the linearisation of the c-th node of its primary facet.
void add_flat(NodeLinearisation& sum, const MortarSpace& space, const FacetPair& pair, const FlatPair& flat, Index c,
              const NodalLoads& loads, const FacingFields& fields) {
  const FacingPairs& facing = space.facing();
  const Facet& one = facing.primary_facet(pair);
  const Facet& two = facing.secondary_facet(pair);
  const int node = one.node(c);
  ScopedTimer laps(space.effect_times(), space.effects().scalar_fields(), stands_for(facing, pair));
  const PairPlaces place = dof_map(one, two, sum.patch);
  const FlatVariations vary = flat_variations(flat, facet_coordinates(one, fields.primary.position),
                                              facet_coordinates(two, fields.secondary.position));
  add_variation(sum.gap_variation, mean_gap_variation(flat, vary, c, loads.gap[node] + loads.offset, loads.area[node]),
                place);
  add_variation(sum.traction_work, traction_work(flat, c), place);
  laps.traction();
  for (const int field : facing.exchanged_fields(pair)) {
    const double area = loads.flux_area(field, node);
    NodeLinearisation::Jump& jump = sum.jumps[position_in(sum.patch.fields, field)];
    const FlatNodes weights = flat.area / area * flat.jump_weights(c);
    for (Index n = 0; n < place.size(); ++n) jump.weights[place[n]] += weights[n];
    add_variation(jump.projection_variation,
                  mean_jump_variation(flat, vary, c, facing.values(pair, field, fields), loads.jump(field, node), area),
                  place);
    laps.field(field);
  }
}

/// Adds the parts of all flat pairs around a node in contact to its linearisation.
void add_flat_pairs(NodeLinearisation& sum, const MortarSpace& space, const PairsAround& pairs, int node,
                    const NodalLoads& loads, const FacingFields& fields) {
  for (const FacetPair* pair : pairs) {
    const std::optional<FlatPair> flat = space.flat(*pair);
    if (!flat) continue;
    const Index c = number_in(space.facing().primary_facet(*pair), node);
    if (flat->weight()[c] != 0) add_flat(sum, space, *pair, *flat, c, loads, fields);
  }
}

/// The displacements of a patch's nodes in the order of patch.of_displacements(). `change`: displacements of both
/// surfaces.
VectorXd displacements_at(const Patch& patch, const FacingPositions& change) {
  const LocalLayout layout = patch.displacement_layout();
  VectorXd values(layout.size());
  for (Index n = 0; n < layout.nodes(); ++n) {
    const Matrix3Xd& surface = n < layout.primary_nodes() ? change.primary : change.secondary;
    values.segment<3>(layout.displacement(n, 0)) = surface.col(patch.node(n));
  }
  return values;
}

/// Subtracts a factor times displacements of both surfaces from the displacements of a patch's nodes. A surface without
/// columns has none.
void subtract(VectorXd& moved, const Patch& patch, const PerSide<Matrix3Xd>& displacements, double factor) {
  const LocalLayout layout = patch.displacement_layout();
  for (Index n = 0; n < layout.nodes(); ++n) {
    const Matrix3Xd& own = displacements[n < layout.primary_nodes() ? Side::primary : Side::secondary];
    if (own.cols() > 0) moved.segment<3>(layout.displacement(n, 0)) -= factor * own.col(patch.node(n));
  }
}

/// Adds the changes of a node's averages to `friction`. `moved`: displacements of the patch; `change`: changes of
/// positions and fields.
void predict(NodalFriction& friction, Index node, const NodeLinearisation& linear, const VectorXd& moved,
             const FacingFields& change) {
  Eigen::Matrix<double, 6, 1> averages = Eigen::Matrix<double, 6, 1>::Zero();
  Vector3d trial = Vector3d::Zero();
  for (Index n = 0; n < linear.friction.average_variation.count(); ++n) {
    for (Index axis = 0; axis < 3; ++axis) {
      averages += linear.friction.average_variation[n].col(axis) * moved[3 * n + axis];
      trial += linear.friction.trial_variation.col(3 * n + axis) * moved[3 * n + axis];
    }
  }
  friction.slip.col(node) += averages.head<3>();
  friction.area_vector.col(node) += averages.tail<3>();
  friction.trial.col(node) += trial;
  friction.convection[node] += convection_change(linear, moved);
  if (!linear.friction.has_fluid()) return;
  friction.pressure[node] += linear.friction.pressure_variation.dot(moved);
  const LocalLayout layout = linear.patch.displacement_layout();
  for (Index n = 0; n < layout.nodes(); ++n) {
    const double weight = linear.friction.pressure_weights[n];
    if (weight == 0) continue;
    const SurfaceFields& surface = n < layout.primary_nodes() ? change.primary : change.secondary;
    friction.pressure[node] += weight * surface.scalar(linear.patch.node(n), linear.friction.pressure_field);
  }
}

SurfaceFields change(const SurfaceFields& from, const SurfaceFields& to) {
  return {to.position - from.position, to.scalar - from.scalar, {}};
}

Matrix3Xd beyond_linear(const SurfaceFields& from, const SurfaceFields& to) {
  return beyond_linear(from.rigid, to.rigid, from.position, to.position);
}

std::size_t bytes_of(const NodalFriction& friction) {
  return bytes(friction.slip) + bytes(friction.area_vector) + bytes(friction.pressure) + bytes(friction.convection) +
         bytes(friction.trial) + bytes(friction.reference) + bytes(friction.reference_bound) +
         bytes(friction.geometric) + bytes(friction.bound) + bytes(friction.traction);
}

std::size_t bytes_of(const NodalLoads& loads) {
  return bytes(loads.area) + bytes(loads.gap) + bytes(loads.traction) + bytes(loads.flux_area) + bytes(loads.jump) +
         bytes(loads.flux) + bytes(loads.own) + bytes_of(loads.friction);
}

std::size_t bytes_of(const NodeLinearisation::Friction& friction) {
  return bytes(friction.average_variation) + bytes(friction.area_variation) + bytes(friction.trial_variation) +
         bytes(friction.convection) + bytes(friction.work) + bytes(friction.pressure_variation) +
         bytes(friction.pressure_weights);
}

}  // namespace

IndexedVector<NodeLinearisation> linearise(const MortarSpace& space, const NodalLoads& loads,
                                           const FacingFields& fields) {
  return linearise(space, loads, fields, loads, [](Index, const VaryingPair&) {});
}

IndexedVector<NodeLinearisation> linearise(const MortarSpace& space, const NodalLoads& loads,
                                           const FacingFields& fields, const NodalLoads& carried,
                                           const UseVaryingPair& use) {
  const FacingPairs& facing = space.facing();
  const auto around = facing.around(loads.in_contact);
  IndexedVector<NodeLinearisation> nodes(around.count());
  in_parallel(around.count(), [&](Index node) {
    if (around[node].empty() && !space.has_unknown_multipliers()) return;
    nodes[node] = zero_linearisation(space, space.node_patch(node, around[node]));
    if (nodes[node].friction.empty()) return;
    nodes[node].friction.convection = convection_around(space, node, around[node], nodes[node].patch.primary);
  });
  const auto linear_pair = [&](Index index, PairLinearisation& linear, PairMemory& memory) {
    const FacetPair& pair = facing.pairs()[index];
    linear.patch.primary.clear();
    if (!facing.has_node_among(pair, loads.in_contact)) return;
    set_varying_pair(space, pair, carried, fields, 1.0, memory.varying);
    use(index, memory.varying);
    if (!memory.varying.flat) linearise_pair(space, pair, memory, loads, fields, linear);
  };
  const auto sum_at_nodes = [&](Index /*index*/, const PairLinearisation& pair) {
    for (Index a = 0; a < pair.patch.primary.count(); ++a) {
      if (pair.is_averaged[a]) scatter(pair, a, nodes[pair.patch.primary[a]]);
    }
  };
  in_order_with(PairMemory(), PairLinearisation(), facing.pairs().count(), linear_pair, sum_at_nodes);
  in_parallel(nodes.count(), [&](Index node) {
    if (!loads.in_contact[node]) return;
    add_flat_pairs(nodes[node], space, around[node], indexing::as_int(node), loads, fields);
    if (!nodes[node].friction.empty()) divide_by_area(nodes[node].friction, loads, node);
  });
  return nodes;
}

double jump_of(const NodeLinearisation& linear, Index k, const FacingFields& fields) {
  const int field = linear.patch.fields[k];
  const LocalLayout layout = linear.patch.field_layout(false);
  double jump = 0;
  for (Index n = 0; n < layout.nodes(); ++n) {
    const SurfaceFields& surface = n < layout.primary_nodes() ? fields.primary : fields.secondary;
    jump += linear.jumps[k].weights[layout.scalar(n, 0)] * surface.scalar(linear.patch.node(n), field);
  }
  return jump;
}

Eigen::Matrix3d convection_change(const NodeLinearisation& linear, const VectorXd& moved) {
  Eigen::Matrix3d change = Eigen::Matrix3d::Zero();
  const Matrix3Xd& c = linear.friction.convection;
  for (Index b = 0; b < c.cols(); ++b) change += moved.segment<3>(3 * b) * c.col(b).transpose();
  return change;
}

bool LinearisationPoint::is_at(const FacingFields& fields) const {
  return primary.position == fields.primary.position && secondary.position == fields.secondary.position &&
         primary.scalar == fields.primary.scalar && secondary.scalar == fields.secondary.scalar;
}

NodalLoads LinearisationPoint::predicted_averages(const FacingFields& fields) const {
  NodalLoads predicted = loads;
  if (is_at(fields)) return predicted;
  predicted.own = fields.primary.scalar.leftCols(loads.own.rows()).transpose();
  const SurfaceFields first = change(primary, fields.primary);
  const SurfaceFields second = change(secondary, fields.secondary);
  const PerSide<Matrix3Xd> beyond{{beyond_linear(primary, fields.primary), beyond_linear(secondary, fields.secondary)}};
  const bool turns = beyond[Side::primary].size() > 0 || beyond[Side::secondary].size() > 0;
  in_parallel(nodes.count(), [&](Index node) {
    const NodeLinearisation& linear = nodes[node];
    if (linear.empty()) return;
    VectorXd moved = displacements_at(linear.patch, {first.position, second.position});
    if (turns) subtract(moved, linear.patch, beyond, 1 - beyond_part[node]);
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
  std::size_t sum = bytes_of(loads) + primary.memory() + secondary.memory() + bytes(geometric_traction) +
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
