#include "segments.h"

#include "parallel.h"
#include "quadrature.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace mixture_contact {
namespace {

/// Edges closer than this part of a polygon's size coincide.
constexpr double coincident_fraction = 1e-9;
/// A piece smaller than this part of the polygon that it was cut from is left out.
constexpr double negligible_fraction = 1e-14;
/// How far outside a facet a point may be carried, in parametric coordinates: as far as a neighbour reaches.
constexpr double reach_outside = 2;

/// A place on the primary facet with its weight, and how they move.
struct Place {
  Vector2d xi;
  double weight = 0;
  PointMotion motion;
  int sub_facet = 0;  ///< of the primary facet
};

/// Nodal coordinates of a facet, and the columns of its nodes in variations; no columns: values only.
struct VaryingFacet {
  FacetType type;
  FacetCoordinates x;
  Index first_node;  ///< of the facet within the pair
  Index nodes;       ///< of the pair; 0: no variations

  VaryingVector at(const Vector2d& xi) const {
    const FacetVector shape = shape_functions(type, xi).value;
    VaryingVector point{x * shape, PairVariation<3>::Zero(3, 3 * nodes)};
    for (Index a = 0; nodes > 0 && a < shape.size(); ++a) {
      point.variation.middleCols<3>(3 * (first_node + a)) = shape[a] * Eigen::Matrix3d::Identity();
    }
    return point;
  }
};

using ParametricPolygon = std::vector<Vector2d>;

/// Convex polygons that make up a facet, by the parametric coordinates of their corners: its linear pieces.
std::vector<ParametricPolygon> polygons(FacetType type) {
  std::vector<ParametricPolygon> result;
  for (const SubFacet& piece : sub_facets(type)) {
    result.emplace_back();
    for (int a = 0; a < node_count(piece.type); ++a) {
      result.back().push_back(parametric_node(type, piece.nodes[static_cast<std::size_t>(a)]));
    }
  }
  return result;
}

Vector2d middle(const ParametricPolygon& polygon) {
  Vector2d sum(0, 0);
  for (const Vector2d& corner : polygon) sum += corner;
  return sum / static_cast<double>(polygon.size());
}

Polygon in_space(const VaryingFacet& facet, const ParametricPolygon& corners) {
  Polygon polygon;
  for (const Vector2d& corner : corners) polygon.push_back(facet.at(corner));
  return polygon;
}

/// Unit normal at a place on the facet that comes first in its pair.
VaryingVector normal_at(const VaryingFacet& facet, const Vector2d& xi) {
  const FacetGradient gradient = shape_functions(facet.type, xi).gradient;
  const Eigen::Matrix<double, 3, 2> tangents = facet.x * gradient;
  VaryingVector area{tangents.col(0).cross(tangents.col(1)), PairVariation<3>::Zero(3, 0)};
  if (facet.nodes > 0) area.variation = area_vector_variation(tangents, gradient, facet.nodes);
  return normalized(area);
}

/// Carries a point y of a piece along n to the primary facet: x1(xi) = y + s n. `area`: the part of the area seen
/// along n that belongs to the point; weight = area/(a.n). Empty if the line misses the facet.
std::optional<Place> carry(const VaryingFacet& facet, const VaryingVector& y, const VaryingVector& n,
                           const VaryingNumber& area) {
  const std::optional<RayHit> hit = intersect(facet.type, facet.x, y.value, n.value, reach_outside);
  if (!hit) return std::nullopt;
  const ShapeFunctions shape = shape_functions(facet.type, hit->eta);
  const Eigen::Matrix<double, 3, 2> tangents = facet.x * shape.gradient;
  const Vector3d area_vector = tangents.col(0).cross(tangents.col(1));
  const double facing = area_vector.dot(n.value);
  Place place{hit->eta, area.value / facing, {}, 0};
  if (facet.nodes == 0) return place;

  // x1,alpha dxi_alpha - n ds = dy + s dn - N dx1
  Eigen::Matrix3d slope;
  slope << tangents, -n.value;
  PairVariation<3> shift = y.variation + hit->gap * n.variation;
  for (Index a = 0; a < shape.value.size(); ++a) {
    shift.middleCols<3>(3 * (facet.first_node + a)) -= shape.value[a] * Eigen::Matrix3d::Identity();
  }
  place.motion.xi = (slope.inverse() * shift).topRows<2>();
  place.motion.curvature = facet.x * shape_hessian(facet.type, hit->eta);
  const PairVariation<3> area_variation = area_vector_variation(tangents, shape.gradient, facet.nodes) +
                                          area_vector_slope(tangents, place.motion.curvature) * place.motion.xi;
  place.motion.weight = area.variation / area.value -
                        (n.value.transpose() * area_variation + area_vector.transpose() * n.variation) / facing;
  return place;
}

/// Sum of the corners of a polygon with given weights.
VaryingVector combined(const Polygon& corners, const Eigen::Ref<const VectorXd>& weights) {
  VaryingVector sum = weights[0] * corners[0];
  for (std::size_t a = 1; a < corners.size(); ++a) sum = sum + weights[static_cast<Index>(a)] * corners[a];
  return sum;
}

/// A convex polygon as triangles around its centroid: integrals over it change smoothly where it gains or loses a
/// corner, and those of a mirrored polygon are mirrored.
std::vector<Polygon> pieces(const Polygon& polygon, const VaryingVector& n, double negligible) {
  std::vector<Polygon> result;
  if (polygon.size() < 3 || twice_area(polygon, n.value) <= negligible) return result;
  const VaryingVector centre = centroid(polygon, n);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    result.push_back({centre, polygon[i], polygon[(i + 1) % polygon.size()]});
  }
  return result;
}

/// Adds the points of a triangle in space seen along n. `primary`: the facet that it is carried to.
void add_places(std::vector<Place>& places, const VaryingFacet& primary, const Polygon& triangle,
                const VaryingVector& n, int order, double negligible) {
  const VaryingNumber area = triple(n, triangle[1] - triangle[0], triangle[2] - triangle[0]);
  if (area.value <= negligible) return;
  for (const QuadraturePoint& q : quadrature(FacetType::tri3, order)) {
    const auto place = carry(primary, combined(triangle, shape_functions(FacetType::tri3, q.xi).value), n,
                             {q.weight * area.value, q.weight * area.variation});
    if (place) places.push_back(*place);
  }
}

/// Integration points on the overlap of two facets, with their motion if the facets vary.
std::vector<Place> overlap(const VaryingFacet& primary, const VaryingFacet& secondary, int order) {
  std::vector<Place> places;
  const std::vector<ParametricPolygon> parts = polygons(primary.type);
  for (std::size_t part = 0; part < parts.size(); ++part) {
    const ParametricPolygon& corners = parts[part];
    const std::size_t first = places.size();
    const Polygon polygon = in_space(primary, corners);
    const VaryingVector n = normal_at(primary, middle(corners));
    const double area = twice_area(polygon, n.value);
    for (const ParametricPolygon& other : polygons(secondary.type)) {
      Polygon window = in_space(secondary, other);
      if (twice_area(window, n.value) >= 0) continue;  // it faces away
      std::reverse(window.begin(), window.end());
      const Polygon both = clip(polygon, window, n, coincident_fraction * std::sqrt(area));
      const double negligible = negligible_fraction * area;
      for (const Polygon& piece : pieces(both, n, negligible)) {
        add_places(places, primary, piece, n, order, negligible);
      }
    }
    for (std::size_t i = first; i < places.size(); ++i) places[i].sub_facet = static_cast<int>(part);
  }
  return places;
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
  return std::max(default_quadrature_order(primary), default_quadrature_order(secondary));
}

Segments::Segments(const std::vector<Facet>& primary, const std::vector<Facet>& secondary, int order)
    : primary_(primary), secondary_(secondary), order_(order) {}

int Segments::order(const Facing& facing) const {
  if (order_ > 0) return order_;
  return default_segment_order(primary_[static_cast<std::size_t>(facing.primary)].type,
                               secondary_[static_cast<std::size_t>(facing.secondary)].type);
}

FacetPair Segments::pair_of(const Facing& facing, const Matrix3Xd& x1, const Matrix3Xd& x2) const {
  const Facet& one = primary_[static_cast<std::size_t>(facing.primary)];
  const Facet& two = secondary_[static_cast<std::size_t>(facing.secondary)];
  const VaryingFacet primary{one.type, facet_coordinates(one, x1), 0, 0};
  const VaryingFacet secondary{two.type, facet_coordinates(two, x2), 0, 0};
  FacetPair pair{facing.primary, facing.secondary, {}};
  for (const Place& place : overlap(primary, secondary, order(facing))) {
    const Ray ray = normal_ray(one, x1, place.xi, 0, reach_outside);
    const auto hit = intersect(two.type, secondary.x, ray.origin, ray.direction, ray.tolerance);
    if (!hit) return {facing.primary, facing.secondary, {}};
    pair.points.push_back({place.xi, hit->eta, place.weight, place.sub_facet});
  }
  return pair;
}

bool Segments::within_reach(const FacetPair& pair, const Matrix3Xd& x1, const Matrix3Xd& x2, double radius) const {
  const IntegrationPoint& point = heaviest(pair);
  const Facet& one = primary_[static_cast<std::size_t>(pair.primary)];
  const Facet& two = secondary_[static_cast<std::size_t>(pair.secondary)];
  const Ray ray = normal_ray(one, x1, point.xi, radius, 0);
  return (facet_coordinates(two, x2) * shape_functions(two.type, point.eta).value - ray.origin).norm() <= radius;
}

bool Segments::hidden(const FacetPair& pair, const std::vector<FacetPair>& all, const Matrix3Xd& x1,
                      const Matrix3Xd& x2) const {
  const Facet& one = primary_[static_cast<std::size_t>(pair.primary)];
  const Facet& two = secondary_[static_cast<std::size_t>(pair.secondary)];
  const IntegrationPoint& point = heaviest(pair);
  const Ray ray = normal_ray(one, x1, point.xi, 0, 0);
  const Vector3d seen = facet_coordinates(two, x2) * shape_functions(two.type, point.eta).value;
  return std::any_of(all.begin(), all.end(), [&](const FacetPair& rival) {
    const Facet& facet = secondary_[static_cast<std::size_t>(rival.secondary)];
    if (share_a_node(facet, two)) return false;
    const auto hit = intersect(facet.type, facet_coordinates(facet, x2), ray.origin, ray.direction, ray.tolerance);
    return hit && std::abs(hit->gap) < (seen - ray.origin).norm();
  });
}

std::vector<FacetPair> Segments::search(const Matrix3Xd& x1, const Matrix3Xd& x2, double radius) {
  std::vector<FacetPair> found;
  seen_.clear();
  if (!surfaces_within_reach(x1, x2, radius)) return found;
  const FacetTree tree(secondary_, x2, box_margin);
  const auto pairs_of = [&](std::size_t f) {
    const Ray ray = normal_ray(primary_[f], x1, parametric_centre(primary_[f].type), radius, 0);
    const double width = radius_around(facet_coordinates(primary_[f], x1), ray.origin);
    std::vector<FacetPair> pairs;
    for (const int candidate : tree.candidates(ray.origin, ray.direction, radius, width)) {
      FacetPair pair = pair_of({static_cast<int>(f), candidate}, x1, x2);
      if (!pair.points.empty() && within_reach(pair, x1, x2, radius)) pairs.push_back(std::move(pair));
    }
    std::vector<FacetPair> visible;
    for (const FacetPair& pair : pairs) {
      if (!hidden(pair, pairs, x1, x2)) visible.push_back(pair);
    }
    return visible;
  };
  in_order(primary_.size(), pairs_of, [&](std::size_t /*facet*/, std::vector<FacetPair>& pairs) {
    for (FacetPair& pair : pairs) {
      seen_.push_back({pair.primary, pair.secondary});
      found.push_back(std::move(pair));
    }
  });
  return found;
}

std::vector<FacetPair> Segments::on_same_facets(const Matrix3Xd& x1, const Matrix3Xd& x2) const {
  std::vector<FacetPair> found;
  for (const Facing& facing : seen_) {
    FacetPair pair = pair_of(facing, x1, x2);
    if (!pair.points.empty()) found.push_back(std::move(pair));
  }
  return found;
}

std::vector<PointMotion> Segments::motions(const FacetPair& pair, const Matrix3Xd& x1, const Matrix3Xd& x2) const {
  const Facet& one = primary_[static_cast<std::size_t>(pair.primary)];
  const Facet& two = secondary_[static_cast<std::size_t>(pair.secondary)];
  const Index first = node_count(one.type);
  const Index nodes = first + node_count(two.type);
  const VaryingFacet primary{one.type, facet_coordinates(one, x1), 0, nodes};
  const VaryingFacet secondary{two.type, facet_coordinates(two, x2), first, nodes};
  std::vector<PointMotion> motions;
  for (const Place& place : overlap(primary, secondary, order({pair.primary, pair.secondary}))) {
    motions.push_back(place.motion);
  }
  return motions;
}

}  // namespace mixture_contact
