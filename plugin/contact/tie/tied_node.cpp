#include "tie/tied_node.h"

#include "geometry/sub_facets.h"
#include "interface/facing_nodes.h"
#include "mortar/mortar_space.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace mixture_contact {
namespace {

/// Gaps below this fraction of a surface's size are rounding of its positions.
constexpr double rounding_of_gaps = 1e-12;

/// Weights by the numbers of their nodes.
using Weights = std::map<int, double>;

/// Integrals of the jump of one quantity around a node.
struct Sums {
  double area = 0;
  PerSide<Weights> weights;

  void add(double share, const Facet& primary, const Facet& secondary, const PointKinematics& point) {
    area += share;
    for (Index b = 0; b < primary.count(); ++b)
      weights[Side::primary][primary.node(b)] -= share * point.primary_shape[b];
    for (Index b = 0; b < secondary.count(); ++b)
      weights[Side::secondary][secondary.node(b)] += share * point.secondary_shape[b];
  }
};

/// The initial gap of a point, with the facet whose normal the gap follows.
struct GapOfPoint {
  int facet = 0;
  FacetGradient gradient;
  double sum = 0;  ///< integral INT psi_a g0 dA
};

/// Integrals around a node over all pairs of facets.
struct SumsOfNode {
  Sums all;
  IndexedVector<Sums> fields;
  PerSide<Weights> areas;  ///< integrals of psi_a psi_b over the nodes b of both surfaces
  IndexedVector<GapOfPoint> gaps;
};

void add_gap(IndexedVector<GapOfPoint>& gaps, const FacetPair& pair, const Facet& facet, const PointKinematics& point,
             double sum) {
  const bool has_same_normal = is_flat(facet.type) && !gaps.empty() && gaps.back().facet == pair.primary;
  if (has_same_normal) {
    gaps.back().sum += sum;
  } else {
    gaps.push_back({pair.primary, point.primary_gradient, sum});
  }
}

/// A point of a pair with its kinematics and the weights of the nodes of both facets.
struct PlacedPoint {
  PointKinematics kinematics;
  FacetVector shares;        ///< quadrature weight times |a| psi_a, per primary node
  PerSide<FacetVector> psi;  ///< functions psi of the nodes of both facets
};

PlacedPoint placed(const MortarSpace& space, const FacetPair& pair, const IntegrationPoint& place,
                   const PerSide<Matrix3Xd>& x) {
  const Facet& one = space.facing().primary_facet(pair);
  const Facet& two = space.facing().secondary_facet(pair);
  PlacedPoint found;
  found.kinematics = point_kinematics(shape_functions(one.type, place.xi), facet_coordinates(one, x[Side::primary]),
                                      shape_functions(two.type, place.eta), facet_coordinates(two, x[Side::secondary]));
  const double area = place.weight * found.kinematics.area;
  found.psi[Side::primary] = space.shape(pair.primary, place.sub_facet, place.xi).value;
  found.shares = area * found.psi[Side::primary];
  found.psi[Side::secondary] = multiplier_functions(two.type, sub_facet_at(two.type, place.eta), place.eta).value;
  return found;
}

void add_pair(const MortarSpace& space, const FacetPair& pair, const PerSide<Matrix3Xd>& x,
              IndexedVector<SumsOfNode>& nodes) {
  const Facet& one = space.facing().primary_facet(pair);
  const Facet& two = space.facing().secondary_facet(pair);
  const IndexedVector<int> fields = space.facing().exchanged_fields(pair);
  const double rounding = rounding_of_gaps * space.facing().surface_size();
  for (const IntegrationPoint& place : space.facing().points(pair)) {
    const PlacedPoint point = placed(space, pair, place, x);
    for (Index a = 0; a < one.count(); ++a) {
      const double share = point.shares[a];
      if (share == 0) continue;
      SumsOfNode& sums = nodes[one.node(a)];
      sums.all.add(share, one, two, point.kinematics);
      for (const int field : fields) sums.fields[field].add(share, one, two, point.kinematics);
      for (Index b = 0; b < one.count(); ++b)
        sums.areas[Side::primary][one.node(b)] += share * point.psi[Side::primary][b];
      for (Index b = 0; b < two.count(); ++b)
        sums.areas[Side::secondary][two.node(b)] += share * point.psi[Side::secondary][b];
      const double gap = point.kinematics.gap;
      if (std::abs(gap) > rounding) add_gap(sums.gaps, pair, one, point.kinematics, share * gap);
    }
  }
}

/// The numbers of the nodes that have weights, ascending.
IndexedVector<int> numbers_in(const Weights& weights) {
  IndexedVector<int> numbers;
  for (const auto& entry : weights) numbers.push_back(entry.first);
  return numbers;
}

double weight_in(const Weights& weights, int node) {
  const auto found = weights.find(node);
  return found == weights.end() ? 0.0 : found->second;
}

TiedAverage average_of(const Sums& sums, const TiedNode& tied) {
  TiedAverage average;
  if (!(sums.area > 0)) return average;
  average.area = sums.area;
  average.weights.resize(tied.count());
  Index n = 0;
  for (const int node : tied.primary) average.weights[n++] = weight_in(sums.weights[Side::primary], node) / sums.area;
  for (const int node : tied.secondary)
    average.weights[n++] = weight_in(sums.weights[Side::secondary], node) / sums.area;
  return average;
}

PlaceOnFacet place_on(const Facet& facet, const FacetGradient& gradient, const IndexedVector<int>& nodes) {
  PlaceOnFacet place{{}, gradient};
  for (const int node : facet) place.places.push_back(position_in(nodes, node));
  return place;
}

/// The fractions of a node's area that belong to other nodes, in the order of `nodes`.
VectorXd shares_in(const Weights& areas, const IndexedVector<int>& nodes, double area) {
  return VectorXd::NullaryExpr(nodes.count(), [&](Index n) { return weight_in(areas, nodes[n]) / area; });
}

TiedNode tied_node(int node, const SumsOfNode& sums, const SurfaceMesh& primary) {
  TiedNode tied;
  tied.node = node;
  tied.primary = numbers_in(sums.all.weights[Side::primary]);
  tied.secondary = numbers_in(sums.all.weights[Side::secondary]);
  tied.traction = average_of(sums.all, tied);
  for (const Sums& of_field : sums.fields) tied.fields.push_back(average_of(of_field, tied));
  tied.primary_shares = shares_in(sums.areas[Side::primary], tied.primary, sums.all.area);
  tied.secondary_shares = shares_in(sums.areas[Side::secondary], tied.secondary, sums.all.area);
  for (const GapOfPoint& gap : sums.gaps) {
    tied.gaps.push_back({place_on(primary.facets[gap.facet], gap.gradient, tied.primary), gap.sum / sums.all.area});
  }
  return tied;
}

/// The intersections of the normals of the primary nodes with the secondary surface, at any distance.
IndexedVector<std::optional<SurfaceHit>> hits_at_any_distance(const PerSide<SurfaceMesh>& mesh, Settings settings,
                                                              const PerSide<Matrix3Xd>& x) {
  const FacingPositions facing = seen_from(Side::primary, x);
  settings.search.radius = 2 * (half_diagonal(facing.primary) + half_diagonal(facing.secondary)) +
                           (facing.primary.rowwise().mean() - facing.secondary.rowwise().mean()).norm();
  return hits_of_nodes(mesh[Side::primary], mesh[Side::secondary], facing, settings);
}

}  // namespace

IndexedVector<TiedNode> find_tied_nodes(const PerSide<SurfaceMesh>& mesh, const Effects& effects,
                                        const Settings& settings, const PerSide<Matrix3Xd>& reference) {
  const FacingPositions x = seen_from(Side::primary, reference);
  MortarSpace space(mesh[Side::primary], mesh[Side::secondary], effects, settings);
  space.change_facing().search(x, reach_of(settings, x));
  space.update_boundary_weights(x);
  SumsOfNode empty;
  empty.fields.resize(indexing::entries(effects.scalar_fields()));
  IndexedVector<SumsOfNode> sums(mesh[Side::primary].nodes, empty);
  for (const FacetPair& pair : space.facing().pairs()) add_pair(space, pair, reference, sums);
  IndexedVector<TiedNode> tied;
  for (int node = 0; node < mesh[Side::primary].nodes; ++node) {
    if (sums[node].all.area > 0) tied.push_back(tied_node(node, sums[node], mesh[Side::primary]));
  }
  return tied;
}

void find_normals(IndexedVector<TiedNode>& nodes, const SurfaceMesh& primary) {
  std::map<int, TiedNode*> by_node;
  for (TiedNode& tied : nodes) {
    tied.corners.clear();
    by_node[tied.node] = &tied;
  }
  for (const Facet& facet : primary.facets) {
    for (int a = 0; a < facet.count(); ++a) {
      const auto found = by_node.find(facet.node(a));
      if (found == by_node.end()) continue;
      TiedNode& tied = *found->second;
      const bool is_own = std::all_of(facet.begin(), facet.end(), [&](int node) {
        return std::binary_search(tied.primary.begin(), tied.primary.end(), node);
      });
      if (is_own) tied.corners.push_back(place_on(facet, gradient_at_node(facet.type, a), tied.primary));
    }
  }
}

UntiedNodes untied_nodes(const IndexedVector<TiedNode>& tied, const PerSide<SurfaceMesh>& mesh,
                         const Settings& settings, const PerSide<Matrix3Xd>& reference) {
  NodeFlags is_tied(mesh[Side::primary].nodes, false);
  for (const TiedNode& each : tied) is_tied[each.node] = true;
  UntiedNodes untied;
  const IndexedVector<std::optional<SurfaceHit>> hits = hits_at_any_distance(mesh, settings, reference);
  for (Index node = 0; node < hits.count(); ++node) {
    if (is_tied[node]) continue;
    const std::optional<SurfaceHit>& hit = hits[node];
    if (!hit) {
      ++untied.facing_nothing;
      continue;
    }
    ++untied.too_far;
    untied.largest_distance = std::max(untied.largest_distance, std::abs(hit->gap));
  }
  return untied;
}

Matrix3Xd without_gaps(const IndexedVector<TiedNode>& tied, const PerSide<SurfaceMesh>& mesh, const Settings& settings,
                       const PerSide<Matrix3Xd>& reference) {
  Matrix3Xd moved = reference[Side::primary];
  const Matrix3Xd normals = nodal_normals(mesh[Side::primary], moved);
  const IndexedVector<std::optional<SurfaceHit>> hits = hits_of_nodes(mesh[Side::primary], mesh[Side::secondary],
                                                                      seen_from(Side::primary, reference), settings);
  for (const TiedNode& each : tied) {
    const std::optional<SurfaceHit>& hit = hits[each.node];
    if (hit) moved.col(each.node) += hit->gap * normals.col(each.node);
  }
  return moved;
}

}  // namespace mixture_contact
