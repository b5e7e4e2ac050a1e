#include "integration/segments.h"

#include "base/parallel.h"
#include "geometry/quadrature.h"
#include "integration/polygon_quadrature.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <utility>

namespace mixture_contact {
namespace {

/// Edges closer than this part of a polygon's size coincide.
constexpr double coincident_fraction = 1e-9;
/// A piece smaller than this part of the polygon that it was cut from is left out: where surfaces end in the same place
/// rounding would cut such pieces.
constexpr double negligible_fraction = 1e-8;
/// How far outside a facet a point may be carried, in parametric coordinates: as far as a neighbour reaches.
constexpr double reach_outside = 2;

/// A point of a piece as it is seen along n, before it is carried to the primary facet, and how it varies.
struct Sample {
  const PolygonPoint& point;
  const VaryingVector& n;
  int sub_facet;  ///< of the primary facet
};

/// Nodal coordinates of a facet, and the columns of its nodes in variations; no columns: values only.
struct VaryingFacet {
  FacetType type;
  FacetCoordinates x;
  Index first_node;  ///< of the facet within the pair
  Index nodes;       ///< of the pair; 0: no variations

  VaryingVector at_node(Index node) const {
    VaryingVector point{x.col(node), PairVariation<3>::Zero(3, 3 * nodes)};
    if (nodes > 0) point.variation.middleCols<3>(3 * (first_node + node)).setIdentity();
    return point;
  }

  VaryingVector at(const Vector2d& xi) const {
    const FacetVector shape = shape_functions(type, xi).value;
    VaryingVector point{x * shape, PairVariation<3>::Zero(3, 3 * nodes)};
    for (Index a = 0; nodes > 0 && a < shape.size(); ++a) {
      point.variation.middleCols<3>(3 * (first_node + a)) = shape[a] * Eigen::Matrix3d::Identity();
    }
    return point;
  }
};

/// A corner of a linear piece; the middle of an 8-node quadrilateral is no node.
Vector3d corner(const VaryingFacet& facet, const SubFacet& piece, int a) {
  const int node = at(piece.nodes, a);
  if (node < facet.x.cols()) return facet.x.col(node);
  return facet.x * shape_functions(facet.type, parametric_node(facet.type, node)).value;
}

/// A linear piece of a facet as a polygon in space.
Polygon in_space(const VaryingFacet& facet, const SubFacet& piece) {
  Polygon polygon;
  polygon.reserve(piece.nodes.size());
  for (int a = 0; a < node_count(piece.type); ++a) {
    const int node = at(piece.nodes, a);
    polygon.push_back(node < facet.x.cols() ? facet.at_node(node) : facet.at(parametric_node(facet.type, node)));
  }
  return polygon;
}

/// The middle of a linear piece of a facet, in parametric coordinates.
Vector2d middle(FacetType type, const SubFacet& piece) {
  const int corners = node_count(piece.type);
  Vector2d sum(0, 0);
  for (int a = 0; a < corners; ++a) sum += parametric_node(type, at(piece.nodes, a));
  return sum / corners;
}

/// Unit normal at a place on the facet that comes first in its pair.
VaryingVector normal_at(const VaryingFacet& facet, const Vector2d& xi) {
  const FacetGradient gradient = shape_functions(facet.type, xi).gradient;
  const Eigen::Matrix<double, 3, 2> tangents = facet.x * gradient;
  VaryingVector area{tangents.col(0).cross(tangents.col(1)), PairVariation<3>::Zero(3, 0)};
  if (facet.nodes > 0) area.variation = area_vector_variation(tangents, gradient, facet.nodes);
  return normalized(area);
}

/// Where a sample stands on the primary facet, carried along n: x1(xi) = y + s n. Empty if the line misses the facet.
std::optional<Vector2d> carried(const VaryingFacet& facet, const Sample& sample) {
  const auto hit = intersect(facet.type, facet.x, sample.point.place.value, sample.n.value, reach_outside);
  return hit ? std::optional(hit->eta) : std::nullopt;
}

/// The quadrature weight of a sample carried to a place on the primary facet: area/(a.n).
double carried_weight(const VaryingFacet& facet, const Sample& sample, const Vector2d& xi) {
  const Eigen::Matrix<double, 3, 2> tangents = facet.x * shape_functions(facet.type, xi).gradient;
  return sample.point.area.value / tangents.col(0).cross(tangents.col(1)).dot(sample.n.value);
}

/// How that place and weight move with the nodes.
PointMotion projection_motion(const VaryingFacet& facet, const Sample& sample, const Vector2d& xi) {
  const VaryingVector& y = sample.point.place;
  const VaryingVector& n = sample.n;
  const ShapeFunctions shape = shape_functions(facet.type, xi);
  const Eigen::Matrix<double, 3, 2> tangents = facet.x * shape.gradient;
  const Vector3d area_vector = tangents.col(0).cross(tangents.col(1));
  const double s = n.value.dot(facet.x * shape.value - y.value);

  // x1,alpha dxi_alpha - n ds = dy + s dn - N dx1
  Eigen::Matrix3d slope;
  slope << tangents, -n.value;
  PairVariation<3> shift = y.variation + s * n.variation;
  for (Index a = 0; a < shape.value.size(); ++a) {
    shift.middleCols<3>(3 * (facet.first_node + a)) -= shape.value[a] * Eigen::Matrix3d::Identity();
  }
  PointMotion motion;
  motion.xi = Eigen::Matrix3d(slope.inverse()).topRows<2>() * shift;
  motion.curvature = facet.x * shape_hessian(facet.type, xi);
  const PairVariation<3> area_variation = area_vector_variation(tangents, shape.gradient, facet.nodes) +
                                          area_vector_slope(tangents, motion.curvature) * motion.xi;
  motion.weight = sample.point.area.variation / sample.point.area.value -
                  (n.value.transpose() * area_variation + area_vector.transpose() * n.variation) /
                      area_vector.dot(n.value);
  return motion;
}

/// A circle around a linear piece of a facet: what does not meet it does not meet the piece.
struct Circle {
  Vector3d centre;
  double radius;
};

Circle circle_around(const VaryingFacet& facet, const SubFacet& piece) {
  const int corners = node_count(piece.type);
  Circle circle{Vector3d::Zero(), 0};
  for (int a = 0; a < corners; ++a) circle.centre += corner(facet, piece, a) / corners;
  for (int a = 0; a < corners; ++a) {
    circle.radius = std::max(circle.radius, (corner(facet, piece, a) - circle.centre).norm());
  }
  return circle;
}

/// Whether two circles are apart, seen along n, by more than rounding.
bool are_apart(const Circle& one, const Circle& two, const Vector3d& n) {
  const double reach = (1 + 1e-6) * (one.radius + two.radius);
  return (two.centre - one.centre).cross(n).squaredNorm() > reach * reach;
}

/// A linear piece of the primary facet, seen along a direction, which others are clipped against.
struct Piece {
  Polygon polygon;
  double area;  ///< twice that which is seen
  Alignment aligned;
};

Piece piece_of(const VaryingFacet& facet, const SubFacet& part, const Vector3d& n) {
  Polygon polygon = in_space(facet, part);
  const double area = twice_area(polygon, n);
  Alignment aligned = alignment(polygon);
  return {std::move(polygon), area, std::move(aligned)};
}

/// Calls use(sample) for the points on the overlap of two facets, in a fixed order.
template <class Use>
void sample_overlap(const VaryingFacet& primary, const VaryingFacet& secondary, int order, const Use& use) {
  int sub_facet = 0;
  for (const SubFacet& part : sub_facets(primary.type)) {
    const VaryingVector n = normal_at(primary, middle(primary.type, part));
    std::optional<Piece> piece;  // most facets of a search are apart
    const Circle circle = circle_around(primary, part);
    for (const SubFacet& other : sub_facets(secondary.type)) {
      if (are_apart(circle, circle_around(secondary, other), n.value)) continue;
      Polygon window = in_space(secondary, other);
      if (twice_area(window, n.value) >= 0) continue;  // it faces away
      std::reverse(window.begin(), window.end());
      if (!piece) piece = piece_of(primary, part, n.value);
      const Polygon both = clip(piece->polygon, window, n, coincident_fraction * std::sqrt(piece->area));
      if (both.size() < 3 || twice_area(both, n.value) <= negligible_fraction * piece->area) continue;
      for (const PolygonPoint& point : polygon_quadrature(both, n, piece->aligned, order))
        use(Sample{point, n, sub_facet});
    }
    ++sub_facet;
  }
}

/// Whether the shape functions of a facet are polynomials of the second degree at most, in total.
bool is_quadratic(FacetType type) {
  return type == FacetType::tri3 || type == FacetType::tri6 || type == FacetType::quad4;
}

bool share_a_node(const Facet& one, const Facet& two) {
  return std::any_of(one.nodes.begin(), one.nodes.begin() + node_count(one.type), [&](int node) {
    const auto* end = two.nodes.begin() + node_count(two.type);
    return std::find(two.nodes.begin(), end, node) != end;
  });
}

/// Half the size of a facet: the largest distance of a node from a point.
double radius_around(const FacetCoordinates& x, const Vector3d& centre) {
  return (x.colwise() - centre).colwise().norm().maxCoeff();
}

const IntegrationPoint& heaviest(const FacetPair& pair) {
  return *std::max_element(pair.points.begin(), pair.points.end(),
                           [](const auto& one, const auto& two) { return one.weight < two.weight; });
}

}  // namespace

int default_segment_order(FacetType primary, FacetType secondary) {
  return is_quadratic(primary) && is_quadratic(secondary) ? 2 : 3;
}

Segments::Segments(const IndexedVector<Facet>& primary, const IndexedVector<Facet>& secondary, int order,
                   SelfContact self)
    : primary_(primary), secondary_(secondary), order_(order), self_(std::move(self)) {}

int Segments::order(const Facing& facing) const {
  if (order_ > 0) return order_;
  return default_segment_order(primary_[facing.primary].type, secondary_[facing.secondary].type);
}

FacetPair Segments::pair_of(const Facing& facing, const Matrix3Xd& x1, const Matrix3Xd& x2) const {
  const Facet& one = primary_[facing.primary];
  const Facet& two = secondary_[facing.secondary];
  const VaryingFacet primary{one.type, facet_coordinates(one, x1), 0, 0};
  const VaryingFacet secondary{two.type, facet_coordinates(two, x2), 0, 0};
  FacetPair pair{facing.primary, facing.secondary, {}};
  bool complete = true;
  sample_overlap(primary, secondary, order(facing), [&](const Sample& sample) {
    const std::optional<Vector2d> xi = carried(primary, sample);
    if (!xi) return void(complete = false);
    const Ray ray = normal_ray(one, x1, *xi, 0, reach_outside);
    const auto hit = intersect(two.type, secondary.x, ray.origin, ray.direction, ray.tolerance);
    if (!hit) return void(complete = false);
    pair.points.push_back({*xi, hit->eta, carried_weight(primary, sample, *xi), sample.sub_facet});
  });
  if (!complete) pair.points.clear();
  return pair;
}

bool Segments::within_reach(const FacetPair& pair, const Matrix3Xd& x1, const Matrix3Xd& x2, double radius) const {
  const IntegrationPoint& point = heaviest(pair);
  const Facet& one = primary_[pair.primary];
  const Facet& two = secondary_[pair.secondary];
  const Ray ray = normal_ray(one, x1, point.xi, radius, 0);
  const Vector3d apart = facet_coordinates(two, x2) * shape_functions(two.type, point.eta).value - ray.origin;
  return apart.norm() <= radius && apart.dot(ray.direction) >= -self_.largest_overlap(pair.primary);
}

bool Segments::opposed(const FacetPair& pair, const Matrix3Xd& x1, const Matrix3Xd& x2) const {
  const double least = self_.opposition();
  if (least == 0) return true;
  const IntegrationPoint& point = heaviest(pair);
  const Vector3d one = normal_ray(primary_[pair.primary], x1, point.xi, 0, 0).direction;
  const Vector3d two = normal_ray(secondary_[pair.secondary], x2, point.eta, 0, 0).direction;
  return one.dot(two) < -least;
}

std::vector<int> Segments::candidates(int facet, const FacetTree& tree, const Matrix3Xd& x1, double radius) const {
  const Ray ray = normal_ray(primary_[facet], x1, parametric_centre(primary_[facet].type), radius, 0);
  const double width = radius_around(facet_coordinates(primary_[facet], x1), ray.origin);
  std::vector<int> found = tree.candidates(ray.origin, ray.direction, radius, width);
  self_.keep_visible(facet, found);
  return found;
}

bool Segments::occluded(const FacetPair& pair, const IndexedVector<FacetPair>& all, const Matrix3Xd& x1,
                        const Matrix3Xd& x2) const {
  const Facet& one = primary_[pair.primary];
  const Facet& two = secondary_[pair.secondary];
  const IntegrationPoint& point = heaviest(pair);
  const Ray ray = normal_ray(one, x1, point.xi, 0, 0);
  const Vector3d paired = facet_coordinates(two, x2) * shape_functions(two.type, point.eta).value;
  return std::any_of(all.begin(), all.end(), [&](const FacetPair& rival) {
    const Facet& facet = secondary_[rival.secondary];
    if (share_a_node(facet, two)) return false;
    const auto hit = intersect(facet.type, facet_coordinates(facet, x2), ray.origin, ray.direction, ray.tolerance);
    return hit && std::abs(hit->gap) < (paired - ray.origin).norm();
  });
}

IndexedVector<FacetPair> Segments::search(const Matrix3Xd& x1, const Matrix3Xd& x2, double radius) {
  IndexedVector<FacetPair> found;
  paired_.clear();
  if (!surfaces_within_reach(x1, x2, radius)) return found;
  const FacetTree tree(secondary_, x2, box_margin);
  const auto pairs_of = [&](Index index) {
    const int f = static_cast<int>(index);
    IndexedVector<FacetPair> pairs;
    for (const int candidate : candidates(f, tree, x1, radius)) {
      FacetPair pair = pair_of({f, candidate}, x1, x2);
      if (!pair.points.empty() && within_reach(pair, x1, x2, radius) && opposed(pair, x1, x2))
        pairs.push_back(std::move(pair));
    }
    IndexedVector<FacetPair> visible;
    for (const FacetPair& pair : pairs) {
      if (!occluded(pair, pairs, x1, x2)) visible.push_back(pair);
    }
    return visible;
  };
  in_order(primary_.count(), pairs_of, [&](Index /*facet*/, IndexedVector<FacetPair>& pairs) {
    for (FacetPair& pair : pairs) {
      paired_.push_back({pair.primary, pair.secondary});
      found.push_back(std::move(pair));
    }
  });
  return found;
}

IndexedVector<FacetPair> Segments::on_same_facets(const Matrix3Xd& x1, const Matrix3Xd& x2) const {
  IndexedVector<FacetPair> found;
  for (const Facing& facing : paired_) {
    FacetPair pair = pair_of(facing, x1, x2);
    if (!pair.points.empty()) found.push_back(std::move(pair));
  }
  return found;
}

std::vector<PointMotion> Segments::motions(const FacetPair& pair, const Matrix3Xd& x1, const Matrix3Xd& x2) const {
  const Facet& one = primary_[pair.primary];
  const Facet& two = secondary_[pair.secondary];
  const Index first = node_count(one.type);
  const Index nodes = first + node_count(two.type);
  const VaryingFacet primary{one.type, facet_coordinates(one, x1), 0, nodes};
  const VaryingFacet secondary{two.type, facet_coordinates(two, x2), first, nodes};
  std::vector<PointMotion> motions;
  motions.reserve(pair.points.size());
  sample_overlap(primary, secondary, order({pair.primary, pair.secondary}), [&](const Sample& sample) {
    motions.push_back(projection_motion(primary, sample, pair.points[motions.size()].xi));
  });
  return motions;
}

}  // namespace mixture_contact
