#include "mortar/linearisation.h"

#include "base/bytes.h"
#include "base/in_order.h"

#include <algorithm>
#include <iterator>

namespace mixture_contact {
namespace {

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
  IndexedVector<PairSlip> slips;  ///< per node; empty without friction
};

NodeLinearisation zero_linearisation(const MortarSpace& space, Index node, const PairsAround& pairs) {
  NodeLinearisation linear;
  linear.patch = space.node_patch(node, pairs);
  const Patch& patch = linear.patch;
  space.slips().set_zero(linear.friction, space, node, patch, pairs);
  if (patch.displacements) linear.gap_variation.setZero(patch.displacement_layout().size());
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
}

/// Adds the part of a pair to the linearisation of a node of its primary facet. `corner`: number of the node in the
/// facet.
void scatter(const SlipAverages& slips, const PairLinearisation& pair, Index corner, NodeLinearisation& sum) {
  const PairPlaces place = dof_map(pair.patch.primary, pair.patch.secondary, sum.patch);
  const auto add = [&](VectorXd& variation, const MatrixXd& part) {
    if (sum.patch.displacements) add_variation(variation, part.col(corner), place);
  };
  add(sum.gap_variation, pair.gap_variation);
  add(sum.traction_work, pair.traction_work);
  slips.scatter(pair.slips, corner, place, sum.friction);
  for (Index f = 0; f < pair.patch.fields.count(); ++f) {
    NodeLinearisation::Jump& jump = sum.jumps[position_in(sum.patch.fields, pair.patch.fields[f])];
    add(jump.projection_variation, pair.jumps[f].projection_variation);
    for (Index n = 0; n < place.size(); ++n) jump.weights[place[n]] += pair.jumps[f].weights(n, corner);
  }
}

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

void linearise_pair(const MortarSpace& space, const FacetPair& pair, PairMemory& memory, const NodalLoads& loads,
                    const FacingFields& fields, PairLinearisation& linear) {
  set_zero(linear, space, pair);
  const Patch& patch = linear.patch;
  ScopedTimer laps(space.effect_times(), space.effects().scalar_fields(), stands_for(space.facing(), pair));
  const Facet& facet = space.facing().primary_facet(pair);
  set_corner_points(memory, facet, loads.in_contact);
  for (const CornerPoint& at : memory.corners) linear.is_averaged[at.corner] = true;
  const LocalLayout layout = patch.displacement_layout();
  if (patch.displacements) {
    for (const CornerPoint& at : memory.corners) add_gap(linear, layout, loads, at);
    laps.traction();
  }
  space.slips().set_pair(linear.slips, space, pair, layout, memory.corners, fields, laps);
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
    const auto add = [&](const FlatPair& flat) {
      const Index c = number_in(space.facing().primary_facet(*pair), node);
      if (flat.weight()[c] != 0) add_flat(sum, space, *pair, flat, c, loads, fields);
    };
    space.integrate(*pair, add, [] {});
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
    nodes[node] = zero_linearisation(space, node, around[node]);
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
      if (pair.is_averaged[a]) scatter(space.slips(), pair, a, nodes[pair.patch.primary[a]]);
    }
  };
  in_order_with(PairMemory(), PairLinearisation(), facing.pairs().count(), linear_pair, sum_at_nodes);
  in_parallel(nodes.count(), [&](Index node) {
    if (!loads.in_contact[node]) return;
    add_flat_pairs(nodes[node], space, around[node], indexing::as_int(node), loads, fields);
    space.slips().divide_by_area(nodes[node].friction, loads, node);
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

bool LinearisationPoint::is_at(const FacingFields& fields) const {
  return primary.position == fields.primary.position && secondary.position == fields.secondary.position &&
         primary.scalar == fields.primary.scalar && secondary.scalar == fields.secondary.scalar;
}

NodalLoads LinearisationPoint::predicted_averages(const SlipAverages& slips, const FacingFields& fields) const {
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
    slips.predict(predicted.friction, node, linear.friction, linear.patch, moved, {first, second});
    for (Index k = 0; k < linear.jumps.count(); ++k) {
      predicted.jump(linear.patch.fields[k], node) += linear.jumps[k].projection_variation.dot(moved) +
                                                      jump_of(linear, k, {first, second});
    }
  });
  return predicted;
}

std::size_t LinearisationPoint::memory() const {
  std::size_t sum = bytes_of(loads) + primary.memory() + secondary.memory() + bytes(geometric_traction) +
                    bytes(geometric_flux) + bytes(geometric_friction) + bytes(equation_weights) + bytes(beyond_part) +
                    bytes(nodes);
  for (const NodeLinearisation& node : nodes) {
    sum += bytes(node.patch) + bytes(node.gap_variation) + bytes(node.traction_work) + bytes(node.jumps);
    sum += bytes_of(node.friction);
    for (const NodeLinearisation::Jump& jump : node.jumps)
      sum += bytes(jump.projection_variation) + bytes(jump.weights);
  }
  return sum;
}

}  // namespace mixture_contact
