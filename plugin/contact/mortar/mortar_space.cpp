#include "mortar/mortar_space.h"

#include "base/bytes.h"
#include "base/in_order.h"
#include "integration/facing_share.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace mixture_contact {
namespace {

/// The integrals over a pair for the average jumps of its exchanged fields. `fields` is empty if no node of the pair is
/// in contact.
struct JumpSums {
  IndexedVector<int> fields;
  FacetVector area;  ///< integrals INT psi_a da
  MatrixXd jump;     ///< integrals INT psi_a jump da, shape (fields, nodes)
};

JumpSums jump_sums(const MortarSpace& space, const FacetPair& pair, const FacingFields& fields,
                   const NodeFlags& in_contact) {
  const FacingPairs& facing = space.facing();
  JumpSums sums;
  if (!facing.has_node_among(pair, in_contact)) return sums;
  sums.fields = facing.exchanged_fields(pair);
  sums.area.setZero(facing.primary_facet(pair).count());
  sums.jump.setZero(sums.fields.count(), sums.area.size());
  const auto by_moments = [&](const FlatPair& flat) {
    sums.area = flat.area * flat.weight();
    for (Index k = 0; k < sums.fields.count(); ++k)
      sums.jump.row(k) = flat.area * flat.jump(facing.values(pair, sums.fields[k], fields));
  };
  const auto add = [&](const IntegrationPoint& place, const PointKinematics& point, const FacetVector& psi) {
    const FacetVector share = place.weight * point.area * psi;
    const PairVector h = point.jump_weights();
    sums.area += share;
    for (Index k = 0; k < sums.fields.count(); ++k)
      sums.jump.row(k) += h.dot(facing.values(pair, sums.fields[k], fields)) * share;
  };
  space.integrate(pair, by_moments, [&] { space.for_each_point(pair, add); });
  return sums;
}

/// A node at an edge bears no load of a facet whose opposition -n1.n2 to the other surface is less than this fraction
/// of that of the best opposed facet around the node. The lower nodes of a block on a plane bear no load of the block's
/// sides. Those of an octagon also bear load of the next side, which is inclined by 45 degrees.
constexpr double least_part_of_best = 0.6;
/// The fraction from which a node that bore no load of a facet bears it. The hysteresis keeps decisions from
/// alternating with the steps.
constexpr double least_part_of_other = 0.75;

/// The largest -n1.n2 of each primary facet with its secondary facets, and that of the best facet around each node.
struct Oppositions {
  VectorXd facets;
  VectorXd nodes;
};

Oppositions oppositions(const FacingPairs& facing, const FacingPositions& x) {
  Oppositions found{VectorXd::Zero(facing.primary().facets.count()), VectorXd::Zero(facing.primary().nodes)};
  for (const FacetPair& pair : facing.pairs()) {
    const Facet& one = facing.primary_facet(pair);
    const Vector3d n1 = middle_normal(one, x.primary);
    const Vector3d n2 = middle_normal(facing.secondary_facet(pair), x.secondary);
    found.facets[pair.primary] = std::max(found.facets[pair.primary], -n1.dot(n2));
    for (const int node : one) found.nodes[node] = std::max(found.nodes[node], found.facets[pair.primary]);
  }
  return found;
}

/// True if a node bears load of a facet. `of_facet`, `best`: oppositions of the facet and of the best facet around the
/// node. `bore`: whether the node bore load of the facet in the step before.
bool is_faced_enough(double of_facet, double best, bool bore) {
  return of_facet >= (bore ? least_part_of_best : least_part_of_other) * best;
}

}  // namespace

MortarSpace::MortarSpace(const SurfaceMesh& primary, const SurfaceMesh& secondary, const Effects& effects,
                         const Settings& settings)
    : slips_(slip_averages(effects.friction_kind, settings.friction.ambient_pressure)),
      facing_(primary, secondary, effects, settings, slips_->flat_integrals()),
      weights_(primary.facets.count()),
      redistributes_(settings.integration == Integration::segments),
      unknown_multipliers_(settings.enforcement == Enforcement::lagrange_multipliers),
      symmetric_(settings.symmetric),
      offset_(settings.gap.offset),
      effect_times_(effects.scalar_fields()) {}

bool MortarSpace::keep_lost_points(const FacingPositions& x) {
  const bool finds_more = facing_.keep_lost_points(x);
  if (finds_more) gaps_.reset();
  return finds_more;
}

FlatPair MortarSpace::redistributed(FlatPair flat, const FacetPair& pair) const {
  if (const std::optional<MatrixXd> heirs = weights_.heirs(pair.primary, facing_.primary_facet(pair).type)) {
    flat.moments = flat.moments.redistributed(*heirs);
    flat.gap = *heirs * flat.gap;
  }
  return flat;
}

FacetGapSums MortarSpace::gap_sums(const FacetPair& pair) const {
  FacetGapSums sums = FacetGapSums::Zero(2, facing_.primary_facet(pair).count());
  const auto by_moments = [&](const FlatPair& flat) {
    sums << flat.area * flat.weight().transpose(), flat.area * flat.gap.transpose();
  };
  const auto add = [&](const IntegrationPoint& place, const PointKinematics& point, const FacetVector& psi) {
    sums.row(0) += place.weight * point.area * psi;
    sums.row(1) += place.weight * point.area * point.gap * psi;
  };
  integrate(pair, by_moments, [&] { for_each_point(pair, add); });
  return sums;
}

void MortarSpace::update_boundary_weights(const FacingPositions& x) {
  // The nodes of a restricted pass keep their own functions: there are no other nodes to carry their load.
  if (facing_.is_restricted()) return;
  IndexedVector<const FacetPair*> unknown;
  for (const FacetPair& pair : facing_.pairs()) {
    if (!weights_.knows(pair.primary)) unknown.push_back(&pair);
  }
  if (unknown.empty()) return;
  gaps_.reset();
  std::map<int, FacetGapSums> covered;
  in_order(
      unknown.count(), [&](Index index) { return gap_sums(*unknown[index]); },
      [&](Index index, const FacetGapSums& sums) {
        const auto [place, first] = covered.try_emplace(unknown[index]->primary, sums);
        if (!first) place->second += sums;
      });
  const Oppositions opposed = oppositions(facing_, x);
  const LoadCarriers last = weights_.last_decisions();  // copied, because decide() replaces them
  for (auto& [facet, sums] : covered) {
    const Facet& of = facing_.primary().facets[facet];
    const FacetVector all = areas_of_nodes(of, x.primary);
    if (!redistributes_) sums.row(0) = all.transpose();
    const bool is_known = !last.empty() && last[facet].size() > 0;
    for (Index a = 0; a < all.size(); ++a) {
      const bool bore = !is_known || last[facet][a] > 0;
      if (!is_faced_enough(opposed.facets[facet], opposed.nodes[of.node(a)], bore)) sums.col(a).setZero();
    }
    weights_.decide(facet, sums, all);
  }
}

const NodalGaps& MortarSpace::gaps() const {
  if (!gaps_) gaps_ = averaged_gaps();
  return *gaps_;
}

NodalGaps MortarSpace::averaged_gaps() const {
  NodalGaps gaps{VectorXd::Zero(nodes()), VectorXd::Zero(nodes()), facing_.surface_size(), offset_};
  const IndexedVector<FacetPair>& pairs = facing_.pairs();
  const auto sums_of = [&](Index index) { return gap_sums(pairs[index]); };
  in_order(pairs.count(), sums_of, [&](Index index, const FacetGapSums& sums) {
    const Facet& facet = facing_.primary_facet(pairs[index]);
    for (Index a = 0; a < sums.cols(); ++a) {
      gaps.area[facet.node(a)] += sums(0, a);
      gaps.gap[facet.node(a)] += sums(1, a);
    }
  });
  gaps.gap = (gaps.area.array() > 0).select(gaps.gap.array() / gaps.area.array() - offset_, 0.0);
  return gaps;
}

void MortarSpace::average_jumps(const FacingFields& fields, NodalLoads& loads) const {
  loads.flux_area.setZero(effects().scalar_fields(), nodes());
  loads.jump.setZero(effects().scalar_fields(), nodes());
  loads.own = own_values(fields, effects());
  if (effects().scalar_fields() == 0) return;
  const IndexedVector<FacetPair>& pairs = facing_.pairs();
  const auto sums_of = [&](Index index) { return jump_sums(*this, pairs[index], fields, loads.in_contact); };
  in_order(pairs.count(), sums_of, [&](Index index, const JumpSums& sums) {
    const Facet& facet = facing_.primary_facet(pairs[index]);
    for (Index k = 0; k < sums.fields.count(); ++k) {
      for (Index a = 0; a < sums.area.size(); ++a) {
        loads.flux_area(sums.fields[k], facet.node(a)) += sums.area[a];
        loads.jump(sums.fields[k], facet.node(a)) += sums.jump(k, a);
      }
    }
  });
  loads.jump = (loads.flux_area.array() > 0).select(loads.jump.array() / loads.flux_area.array(), 0.0);
}

NodalLoads MortarSpace::averages(NodalGaps gaps, const FacingFields& fields, ContactStatus status) const {
  NodalLoads loads{std::move(gaps), std::move(status), {}, {}, {}, {}, {}};
  average_jumps(fields, loads);
  loads.friction = slips().averages(*this, loads, fields);
  return loads;
}

const SlipAverages& MortarSpace::slips() const {
  static const SlipAverages none;
  return effects().traction ? *slips_ : none;
}

void MortarSpace::measure_gaps_from(double offset) {
  if (offset == offset_) return;
  offset_ = offset;
  gaps_.reset();
}

std::size_t MortarSpace::memory() const { return facing_.memory() + weights_.memory() + slips_->memory(); }

bool MortarSpace::is_averaged_over(const FacetPair& pair, Index node) const {
  const Facet& facet = facing_.primary_facet(pair);
  const Index a = number_in(facet, node);
  const PointsOfPair points = facing_.points(pair);
  return std::any_of(points.begin(), points.end(), [&](const IntegrationPoint& point) {
    const ShapeFunctions psi = shape(pair.primary, point.sub_facet, point.xi);
    return psi.value[a] != 0 || !psi.gradient.row(a).isZero(0);
  });
}

bool MortarSpace::is_averaged_over(const FacetPair& pair, const NodeFlags& nodes) const {
  const Facet& facet = facing_.primary_facet(pair);
  return std::any_of(facet.begin(), facet.end(), [&](int node) { return nodes[node] && is_averaged_over(pair, node); });
}

Patch MortarSpace::node_patch(Index node, const PairsAround& pairs) const {
  Patch patch;
  patch.displacements = effects().traction;
  if (unknown_multipliers_) {
    patch.multiplier_node = static_cast<int>(node);
    for (int field = 0; field < effects().scalar_fields(); ++field) patch.fields.push_back(field);
  }
  for (const FacetPair* pair : pairs) {
    slips().add_nodes(patch.primary, facing_.primary_facet(*pair));
    if (!is_averaged_over(*pair, node)) continue;
    merge_unique(patch.primary, facing_.primary_facet(*pair));
    merge_unique(patch.secondary, facing_.secondary_facet(*pair));
    merge_unique(patch.fields, facing_.exchanged_fields(*pair));
  }
  return patch;
}

Patch MortarSpace::columns_of(const Patch& patch, int field) const {
  return patch.of_field(field, patch.displacements && !symmetric_);
}

namespace {

/// Calls use(node, gap, area) with the average gap of each facet around each of its nodes, and the area over which it
/// is averaged.
template <class Use>
void for_each_gap(const MortarSpace& space, const Use& use) {
  for (const FacetPair& pair : space.facing().pairs()) {
    const Facet& facet = space.facing().primary_facet(pair);
    const FacetGapSums sums = space.gap_sums(pair);
    for (Index a = 0; a < sums.cols(); ++a) {
      if (sums(0, a) > 0) use(facet.node(a), sums(1, a) / sums(0, a) - space.offset(), sums(0, a));
    }
  }
}

}  // namespace

NodeFlags overlapped_nodes(const MortarSpace& space) {
  NodeFlags found(space.nodes(), false);
  for_each_gap(space, [&](int node, double gap, double /*area*/) { found[node] = found[node] || gap < 0; });
  return found;
}

NodeFlags nearest_nodes(const MortarSpace& space) {
  // The limits are choices: bodies that touch in the model are separated by the difference of their facets from curved
  // faces; nodes at similar distances keep a body from turning.
  constexpr double largest_share = 0.1;
  constexpr double similar = 2;
  double least = std::numeric_limits<double>::infinity();
  int nearest = 0;
  VectorXd areas = VectorXd::Zero(space.nodes());
  for_each_gap(space, [&](int node, double gap, double area) {
    areas[node] += area;
    if (gap >= least) return;
    least = gap;
    nearest = node;
  });
  NodeFlags found(space.nodes(), false);
  if (least < 0 || least > largest_share * std::sqrt(areas[nearest])) return found;
  for_each_gap(space,
               [&](int node, double gap, double /*area*/) { found[node] = found[node] || gap <= similar * least; });
  return found;
}

}  // namespace mixture_contact
