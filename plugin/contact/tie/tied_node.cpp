#include "tie/tied_node.h"

#include "geometry/sub_facets.h"
#include "interface/facing_nodes.h"
#include "mortar/mortar_space.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace mixture_contact {
namespace {

/// Gaps below this fraction of a surface's size are rounding of its positions.
constexpr double rounding_of_gaps = 1e-12;
/// Weights below this value are rounding of integrals.
constexpr double rounding_of_weights = 1e-12;

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
  /// Integrals of psi_b over the nodes b of both surfaces: of the primary one times the share of the node in the load,
  /// of the secondary one times psi_a.
  PerSide<Weights> areas;
  PerSide<IndexedVector<int>> facets;
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

/// A point of a pair with its kinematics and the functions of the nodes of both facets.
struct PlacedPoint {
  PointKinematics kinematics;
  double area = 0;           ///< quadrature weight times |a| [mm^2]
  PerSide<FacetVector> psi;  ///< functions psi of sliding contact of the nodes of both facets
};

PlacedPoint placed(const MortarSpace& space, const FacetPair& pair, const IntegrationPoint& place,
                   const PerSide<Matrix3Xd>& x) {
  const Facet& one = space.facing().primary_facet(pair);
  const Facet& two = space.facing().secondary_facet(pair);
  PlacedPoint found;
  found.kinematics = point_kinematics(shape_functions(one.type, place.xi), facet_coordinates(one, x[Side::primary]),
                                      shape_functions(two.type, place.eta), facet_coordinates(two, x[Side::secondary]));
  found.area = place.weight * found.kinematics.area;
  found.psi[Side::primary] = space.shape(pair.primary, place.sub_facet, place.xi).value;
  found.psi[Side::secondary] = multiplier_functions(two.type, sub_facet_at(two.type, place.eta), place.eta).value;
  return found;
}

/// Integrals over the covered part of a primary facet.
struct Coverage {
  MatrixXd mass;              ///< integrals INT psi_a psi_b dA of the nodes [mm^2]; empty if the facet has no pair
  IndexedVector<int> fields;  ///< fields that the facet exchanges with the first of its pairs
  bool is_uniform = true;     ///< true if it exchanges these fields with all of its pairs
};

/// True if a primary facet has dual functions. Those of a narrow covered part would be large: each node must be covered
/// as a node that carries load.
bool has_dual_functions(const MortarSpace& space, int facet, const Coverage& covered, const Matrix3Xd& x1) {
  const Facet& of = space.facing().primary().facets[facet];
  const bool is_linear = number_of(sub_facets(of.type)) == 1;
  if (covered.mass.size() == 0 || !is_linear || !covered.is_uniform) return false;
  if (space.boundary_weights().heirs(facet, of.type)) return false;
  const VectorXd part = covered.mass.rowwise().sum().cwiseQuotient(areas_of_nodes(of, x1));
  return part.minCoeff() >= least_covered * part.maxCoeff();
}

/// The integrals over the covered parts of all primary facets.
IndexedVector<Coverage> coverage(const MortarSpace& space, const PerSide<Matrix3Xd>& x) {
  IndexedVector<Coverage> covered(space.facing().primary().facets.count());
  for (const FacetPair& pair : space.facing().pairs()) {
    Coverage& facet = covered[pair.primary];
    const IndexedVector<int> fields = space.facing().exchanged_fields(pair);
    const Index count = space.facing().primary_facet(pair).count();
    if (facet.mass.size() == 0) facet = {MatrixXd::Zero(count, count), fields, true};
    facet.is_uniform = facet.is_uniform && facet.fields == fields;
    for (const IntegrationPoint& place : space.facing().points(pair)) {
      const PlacedPoint point = placed(space, pair, place, x);
      facet.mass += point.area * point.psi[Side::primary] * point.psi[Side::primary].transpose();
    }
  }
  return covered;
}

/// Per primary facet, the matrix C of its functions: the functions of the averages are the sums of C_ab psi_b, with
/// psi_b of sliding contact.
IndexedVector<MatrixXd> functions_of_facets(const MortarSpace& space, const PerSide<Matrix3Xd>& x,
                                            const BreakingLaw& breaking) {
  IndexedVector<MatrixXd> functions;
  for (const Facet& facet : space.facing().primary().facets)
    functions.emplace_back(MatrixXd::Identity(facet.count(), facet.count()));
  if (std::holds_alternative<Cohesive>(breaking)) return functions;
  const IndexedVector<Coverage> covered = coverage(space, x);
  for (int facet = 0; facet < covered.count(); ++facet) {
    const MatrixXd& mass = covered[facet].mass;
    if (has_dual_functions(space, facet, covered[facet], x[Side::primary]))
      functions[facet] = mass.rowwise().sum().asDiagonal() * mass.inverse();
  }
  return functions;
}

/// Adds the integrals over a pair. `functions`: the matrix of the primary facet (functions_of_facets()).
void add_pair(const MortarSpace& space, const FacetPair& pair, const PerSide<Matrix3Xd>& x, const MatrixXd& functions,
              IndexedVector<SumsOfNode>& nodes) {
  const Facet& one = space.facing().primary_facet(pair);
  const Facet& two = space.facing().secondary_facet(pair);
  const IndexedVector<int> fields = space.facing().exchanged_fields(pair);
  const double rounding = rounding_of_gaps * space.facing().surface_size();
  for (const IntegrationPoint& place : space.facing().points(pair)) {
    const PlacedPoint point = placed(space, pair, place, x);
    const FacetVector psi = functions * point.psi[Side::primary];
    for (Index a = 0; a < one.count(); ++a) {
      const double share = point.area * psi[a];
      if (share == 0) continue;
      SumsOfNode& sums = nodes[one.node(a)];
      merge_unique(sums.facets[Side::primary], std::array<int, 1>{pair.primary});
      merge_unique(sums.facets[Side::secondary], std::array<int, 1>{pair.secondary});
      sums.all.add(share, one, two, point.kinematics);
      for (const int field : fields) sums.fields[field].add(share, one, two, point.kinematics);
      const double share_of_load = point.area * point.psi[Side::primary][a];
      for (Index b = 0; b < one.count(); ++b) sums.areas[Side::primary][one.node(b)] += share_of_load * psi[b];
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

/// The weights of nodes divided by an area; zero within rounding.
VectorXd fractions_in(const Weights& weights, const IndexedVector<int>& nodes, double area) {
  return VectorXd::NullaryExpr(nodes.count(), [&](Index n) {
    const double fraction = weight_in(weights, nodes[n]) / area;
    return std::abs(fraction) > rounding_of_weights ? fraction : 0.0;
  });
}

TiedAverage average_of(const Sums& sums, const TiedNode& tied) {
  TiedAverage average;
  if (!(sums.area > 0)) return average;
  average.area = sums.area;
  average.weights.resize(tied.count());
  average.weights << fractions_in(sums.weights[Side::primary], tied.primary, sums.area),
      fractions_in(sums.weights[Side::secondary], tied.secondary, sums.area);
  return average;
}

PlaceOnFacet place_on(const Facet& facet, const FacetGradient& gradient) {
  PlaceOnFacet place{{}, gradient};
  place.nodes.assign(facet.begin(), facet.end());
  return place;
}

TiedNode tied_node(int node, const SumsOfNode& sums, const SurfaceMesh& primary) {
  TiedNode tied;
  tied.node = node;
  tied.primary = numbers_in(sums.all.weights[Side::primary]);
  tied.secondary = numbers_in(sums.all.weights[Side::secondary]);
  tied.traction = average_of(sums.all, tied);
  for (const Sums& of_field : sums.fields) tied.fields.push_back(average_of(of_field, tied));
  tied.primary_shares = fractions_in(sums.areas[Side::primary], tied.primary, sums.all.area);
  tied.secondary_shares = fractions_in(sums.areas[Side::secondary], tied.secondary, sums.all.area);
  tied.facets = sums.facets;
  for (const GapOfPoint& gap : sums.gaps)
    tied.gaps.push_back({place_on(primary.facets[gap.facet], gap.gradient), gap.sum / sums.all.area});
  return tied;
}

/// The positions of those of `count` nodes, from position `first` of the weights on, that an average contains.
std::vector<Index> coupled_nodes(const TiedNode& tied, Index first, Index count) {
  std::vector<Index> positions;
  for (Index n = 0; n < count; ++n) {
    const auto couples = [&](const TiedAverage& average) {
      return average.exists() && average.weights[first + n] != 0;
    };
    if (couples(tied.traction) || std::any_of(tied.fields.begin(), tied.fields.end(), couples)) positions.push_back(n);
  }
  return positions;
}

IndexedVector<int> entries_at(const IndexedVector<int>& list, const std::vector<Index>& positions) {
  IndexedVector<int> entries;
  for (const Index position : positions) entries.push_back(list[position]);
  return entries;
}

/// Removes nodes without weight from the averages of a tied node.
void remove_uncoupled(TiedNode& tied) {
  const Index first = tied.primary.count();
  const std::vector<Index> primary = coupled_nodes(tied, 0, first);
  const std::vector<Index> secondary = coupled_nodes(tied, first, tied.secondary.count());
  const auto remove = [&](TiedAverage& average) {
    if (!average.exists()) return;
    VectorXd weights(number_of(primary) + number_of(secondary));
    weights << average.weights.head(first)(primary), average.weights.tail(tied.secondary.count())(secondary);
    average.weights = weights;
  };
  remove(tied.traction);
  for (TiedAverage& average : tied.fields) remove(average);
  tied.primary_shares = VectorXd(tied.primary_shares(primary));
  tied.secondary_shares = VectorXd(tied.secondary_shares(secondary));
  tied.primary = entries_at(tied.primary, primary);
  tied.secondary = entries_at(tied.secondary, secondary);
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
                                        const Settings& settings, const PerSide<Matrix3Xd>& reference,
                                        const BreakingLaw& breaking) {
  const FacingPositions x = seen_from(Side::primary, reference);
  MortarSpace space(mesh[Side::primary], mesh[Side::secondary], effects, settings);
  space.change_facing().search(x, reach_of(settings, x));
  space.update_boundary_weights(x);
  SumsOfNode empty;
  empty.fields.resize(indexing::entries(effects.scalar_fields()));
  IndexedVector<SumsOfNode> sums(mesh[Side::primary].nodes, empty);
  const IndexedVector<MatrixXd> functions = functions_of_facets(space, reference, breaking);
  for (const FacetPair& pair : space.facing().pairs()) add_pair(space, pair, reference, functions[pair.primary], sums);
  IndexedVector<TiedNode> tied;
  for (int node = 0; node < mesh[Side::primary].nodes; ++node) {
    if (sums[node].all.area > 0) tied.push_back(tied_node(node, sums[node], mesh[Side::primary]));
  }
  return tied;
}

void remove_uncoupled(IndexedVector<TiedNode>& nodes) {
  for (TiedNode& tied : nodes) {
    if (tied.gaps.empty()) remove_uncoupled(tied);
  }
}

void find_normals(IndexedVector<TiedNode>& nodes, const SurfaceMesh& primary) {
  for (TiedNode& tied : nodes) {
    tied.corners.clear();
    for (const int number : tied.facets[Side::primary]) {
      const Facet& facet = primary.facets[number];
      const int corner = indexing::as_int(number_in(facet, tied.node));
      tied.corners.push_back(place_on(facet, gradient_at_node(facet.type, corner)));
    }
  }
}

void find_faced_normals(IndexedVector<TiedNode>& nodes, const SurfaceMesh& secondary) {
  for (TiedNode& tied : nodes) {
    tied.faced.clear();
    for (const int number : tied.facets[Side::secondary]) {
      const Facet& facet = secondary.facets[number];
      tied.faced.push_back(place_on(facet, shape_functions(facet.type, parametric_centre(facet.type)).gradient));
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
