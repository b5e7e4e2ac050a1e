#include "integration/facet_overlap.h"

#include "base/local_memory.h"
#include "integration/clipping.h"
#include "integration/facing_share.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace mixture_contact {
namespace {

/// Edges coincide if they are closer to each other than this fraction of a polygon's size.
constexpr double coincident_fraction = 1e-9;
/// An overlap below this fraction of its polygon's area is left out. Rounding would produce such overlaps where two
/// surfaces end at the same position.
constexpr double negligible_fraction = 1e-8;
/// Largest distance outside a facet of a point that is projected onto it, in parametric coordinates: the size of a
/// neighbour.
constexpr double reach_outside = 2;

/// The weight of a pair of facets by the angle between their normals (see facing_share.h), 0 to 1.
double share_of(const PlacedFacet& primary, const PlacedFacet& secondary) {
  return facing_share(middle_normal(primary.type, primary.x), middle_normal(secondary.type, secondary.x));
}

/// Weights of a facet's nodes at a corner of a linear piece that is not a node: the centre of an 8-node quadrilateral.
FacetVector node_weights(FacetType type, int corner) {
  return shape_functions(type, parametric_node(type, corner)).value;
}

/// Nodes of a facet that are the corners of a polygon.
using Corners = std::vector<int>;

/// True if the outline of a secondary facet clips as a whole. Quadrature of orders 1 and 2 uses moments and accepts
/// polygons of any shape; higher orders require convex polygons.
bool takes_outlines(int order) { return order <= 2; }

/// Number of corners of the polygons that for_each_window() uses.
int window_corners(FacetType type, int order) {
  return number_of(takes_outlines(order) ? outline(type) : sub_facets(type).front().nodes);
}

/// Calls use(corners) for each polygon of a secondary facet with which the pieces of a primary facet are clipped.
template <class Use>
void for_each_window(FacetType type, int order, const Use& use) {
  if (takes_outlines(order)) return use(outline(type));
  for (const SubFacet& piece : sub_facets(type)) use(piece.nodes);
}

Vector3d corner(const PlacedFacet& facet, const Corners& piece, int a) {
  const int node = at(piece, a);
  if (node < facet.x.cols()) return facet.x.col(node);
  return facet.x * node_weights(facet.type, node);
}

/// The projection of a part of a facet. Its corners are numbered from `first_corner`.
template <class Number>
Polygon<Number> seen(const View& view, const PlacedFacet& facet, const Corners& piece, int first_corner,
                     std::pmr::memory_resource* memory) {
  Polygon<Number> polygon(memory);
  polygon.reserve(piece.size());
  for (int a = 0; a < number_of(piece); ++a) {
    polygon.push_back(corner_place<Number>(view.seen(corner(facet, piece, a)), first_corner + a));
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

/// A quadrature point on the overlap of a linear piece with a secondary facet, before its projection onto the primary
/// facet.
template <class Number>
struct Sample {
  const PolygonPoint<Number>& point;
  const View& view;
  const Corners& primary;
  const Corners& secondary;
  int sub_facet;  ///< number of the primary piece in sub_facets()
};

/// The projection of a sample onto the primary facet along n: x1(xi) = y + s n. Empty if the line misses the facet.
std::optional<Vector2d> carried(const PlacedFacet& facet, const Sample<double>& sample) {
  const Vector3d place = sample.view.place(sample.point.place.value());
  const auto hit = intersect(facet.type, facet.x, place, sample.view.normal, reach_outside);
  return hit ? std::optional(hit->eta) : std::nullopt;
}

/// The quadrature weight of a sample that is projected to xi on the primary facet: area/(a.n).
double carried_weight(const PlacedFacet& facet, const Sample<double>& sample, const Vector2d& xi) {
  const Eigen::Matrix<double, 3, 2> tangents = facet.x * shape_functions(facet.type, xi).gradient;
  return sample.point.area / tangents.col(0).cross(tangents.col(1)).dot(sample.view.normal);
}

/// Adds the variation of numbers with respect to the corners of a piece of one facet. `first_node`: number of the
/// facet's first node in the pair. `by_corner`: derivatives of the numbers with respect to the projection of a corner.
template <int R, class ByCorner>
void add_corners(SeenVariation<R>& sum, const View& view, const PlacedFacet& facet, const Corners& piece,
                 Index first_node, const ByCorner& by_corner) {
  const auto add = [&](Index node, const auto& by_node) {
    sum.add(first_node + node, view.height(facet.x.col(node)), by_node);
  };
  for (int a = 0; a < number_of(piece); ++a) {
    const int corner = at(piece, a);
    if (corner < facet.x.cols()) {
      add(corner, by_corner(a));
      continue;
    }
    const FacetVector weights = node_weights(facet.type, corner);
    for (Index node = 0; node < weights.size(); ++node) {
      if (weights[node] != 0) add(node, weights[node] * by_corner(a));
    }
  }
}

/// Variation of the position xi and of the weight of a sample with respect to the nodal positions of both facets.
///
/// In the projection along n, the sample is at y and the primary facet at q(xi) = SUM N_a q_a. The condition q(xi) = y
/// gives xi; the weight is area/(q,1 x q,2).
template <class Number>
PointMotion projection_motion(const PlacedFacet& primary, const PlacedFacet& secondary, const Sample<Number>& sample,
                              const ViewTilt& tilt, const Vector2d& xi) {
  const View& view = sample.view;
  const auto& y = sample.point.place;
  const Number& area = sample.point.area;
  const ShapeFunctions shape = shape_functions(primary.type, xi);
  PointMotion motion;
  motion.curvature = primary.x * shape_hessian(primary.type, xi);
  const Eigen::Matrix2d slope = view.axes * (primary.x * shape.gradient);  // columns q,1 and q,2
  const Eigen::Matrix<double, 2, 3> bend = view.axes * motion.curvature;   // columns q,11, q,22 and q,12
  const double determinant = slope.determinant();
  // d(q,1 x q,2) = r1 dq,1 + r2 dq,2
  const Eigen::RowVector2d r1(slope(1, 1), -slope(0, 1));
  const Eigen::RowVector2d r2(-slope(1, 0), slope(0, 0));

  const Index nodes = primary.x.cols() + secondary.x.cols();
  SeenVariation<2> shift(nodes);  // variation of the point relative to the facet: dy - SUM N_a dq_a
  // Relative variation of the weight: d(area)/area - d(q,1 x q,2)/(q,1 x q,2) at fixed xi.
  SeenVariation<1> weight(nodes);
  const auto add_sides = [&](auto& sum, const auto& by) {
    add_corners(sum, view, primary, sample.primary, 0, by);
    add_corners(sum, view, secondary, sample.secondary, primary.x.cols(),
                [&](int a) { return by(number_of(sample.primary) + a); });
  };
  add_sides(shift, [&](int corner) -> Eigen::Matrix2d {
    return (Eigen::Matrix2d() << by_corner(y.x, corner), by_corner(y.y, corner)).finished();
  });
  add_sides(weight, [&](int corner) -> Eigen::RowVector2d { return by_corner(area, corner) / area.value(); });
  for (Index a = 0; a < primary.x.cols(); ++a) {
    const double height = view.height(primary.x.col(a));
    shift.add(a, height, -shape.value[a] * Eigen::Matrix2d::Identity());
    weight.add(a, height, -(shape.gradient(a, 0) * r1 + shape.gradient(a, 1) * r2) / determinant);
  }

  motion.xi = slope.inverse().lazyProduct(shift.with_nodes(view, tilt));
  const Eigen::RowVector2d by_xi(r1.dot(bend.col(0)) + r2.dot(bend.col(2)), r1.dot(bend.col(2)) + r2.dot(bend.col(1)));
  motion.weight = weight.with_nodes(view, tilt) - (by_xi / determinant).lazyProduct(motion.xi);
  return motion;
}

Circle circle_of(const PlacedFacet& facet, const Corners& piece) {
  FacetCoordinates corners(3, number_of(piece));
  for (int a = 0; a < number_of(piece); ++a) corners.col(a) = corner(facet, piece, a);
  return circle_around(corners);
}

template <class Number>
Pieces<Number> pieces_of(const PlacedFacet& facet, std::pmr::memory_resource* memory) {
  Pieces<Number> pieces(memory);
  pieces.reserve(sub_facets(facet.type).size());
  for (const SubFacet& part : sub_facets(facet.type)) {
    const View view = view_at(facet.type, facet.x, middle(facet.type, part));
    Polygon<Number> polygon = seen<Number>(view, facet, part.nodes, 0, memory);
    const double area = twice_area(polygon);
    const Alignment<Number> aligned = alignment(polygon);
    pieces.push_back({part, view, circle_of(facet, part.nodes), std::move(polygon), area, aligned});
  }
  return pieces;
}

/// The overlap of a piece with a part of a secondary facet; fewer than three corners if there is none.
template <class Number>
Polygon<Number> overlap(const Piece<Number>& piece, const PlacedFacet& facet, const Corners& part,
                        std::pmr::memory_resource* memory) {
  Polygon<Number> window = seen<Number>(piece.view, facet, part, number_of(piece.part.nodes), memory);
  if (twice_area(window) >= 0) return Polygon<Number>(memory);  // the facet faces away
  std::reverse(window.begin(), window.end());
  const double coincident = coincident_fraction * std::sqrt(piece.area);
  // The polygon with which the other one is clipped has to be convex; an outline with mid-edge nodes may be concave.
  const bool may_bend = number_of(part) > max_piece_corners;
  Polygon<Number> both = may_bend ? clip(std::move(window), piece.polygon, coincident)
                                  : clip({piece.polygon, memory}, window, coincident);
  if (both.size() >= 3 && twice_area(both) <= negligible_fraction * piece.area) both.clear();
  return both;
}

/// Upper bound for most overlaps of the memory of polygons while clipping [bytes].
template <class Number>
constexpr std::size_t bytes_of_overlap = 64 * sizeof(Place<Number>);

/// True if no piece of a facet overlaps with a circle in the projections of the pieces.
bool are_apart(const Pieces<double>& pieces, const Circle& circle) {
  return std::all_of(pieces.begin(), pieces.end(),
                     [&](const Piece<double>& piece) { return are_apart(piece.circle, circle, piece.view.normal); });
}

/// Calls use(sample) for the quadrature points on the overlap of a piece with a secondary facet, in a fixed order.
/// `sub_facet`: number of the piece.
template <class Number, class Use>
void sample_piece(const Piece<Number>& piece, int sub_facet, const PlacedFacet& secondary, int order, const Use& use) {
  for_each_window(secondary.type, order, [&](const Corners& window) {
    LocalMemory<bytes_of_overlap<Number>> memory;
    const Polygon<Number> both = overlap(piece, secondary, window, memory.resource());
    if (both.size() < 3) return;
    for (const PolygonPoint<Number>& point : polygon_quadrature(both, piece.aligned, order))
      use(Sample<Number>{point, piece.view, piece.part.nodes, window, sub_facet});
  });
}

/// Calls use(sample) for the quadrature points on the overlaps of all pieces of a facet with a secondary facet. Pieces
/// that are apart from the secondary facet's `circle` are skipped.
template <class Number, class Use>
void sample_overlap(const Pieces<Number>& pieces, const PlacedFacet& secondary, const Circle& circle, int order,
                    const Use& use) {
  int sub_facet = -1;
  for (const Piece<Number>& piece : pieces) {
    ++sub_facet;
    if (!are_apart(piece.circle, circle, piece.view.normal)) sample_piece(piece, sub_facet, secondary, order, use);
  }
}

/// A triangle in the projection along n: its parametric coordinates are linear in the projected position.
class SeenTriangle {
 public:
  SeenTriangle(const View& view, const FacetCoordinates& x) : corner_(view.seen(x.col(0))) {
    Eigen::Matrix2d sides;
    sides << view.seen(x.col(1)) - corner_, view.seen(x.col(2)) - corner_;
    inverse_ = sides.inverse();
  }
  Vector2d place(const Vector2d& seen) const { return inverse_ * (seen - corner_); }

 private:
  Vector2d corner_;
  Eigen::Matrix2d inverse_;
};

/// Adds the points between two triangles, as add_points_between() does, in closed form. The view is along the normal of
/// the primary triangle.
bool add_points_between_triangles(const SampledFacet& primary, const PlacedFacet& secondary, double share, int order,
                                  FacetPairs& pairs) {
  const Piece<double>& piece = primary.pieces.front();
  const SeenTriangle one(piece.view, primary.placed.x);
  const SeenTriangle two(piece.view, secondary.x);
  sample_piece(piece, 0, secondary, order, [&](const Sample<double>& sample) {
    const Vector2d seen = sample.point.place.value();
    pairs.add_point({one.place(seen), two.place(seen), share * sample.point.area / piece.area, sample.sub_facet});
  });
  return pairs.pairs().back().points > 0;
}

/// Calls use(motion) with the motion of each point of a pair, at a constant facing share. Number: a VaryingNumber with
/// enough corners.
template <class Number>
void for_each_varying_motion(const PointsOfPair& points, const PlacedFacet& primary, const PlacedFacet& secondary,
                             int order, const UseMotion& use) {
  LocalMemory<bytes_of_pieces<Number>> memory;
  const Pieces<Number> pieces = pieces_of<Number>(primary, memory.resource());
  std::pmr::vector<ViewTilt> tilts(memory.resource());
  tilts.reserve(pieces.size());
  for (const Piece<Number>& piece : pieces)
    tilts.push_back(view_tilt(piece.view, primary.type, primary.x, middle(primary.type, piece.part)));
  const IntegrationPoint* point = points.begin();
  sample_overlap(pieces, secondary, circle_around(secondary.x), order, [&](const Sample<Number>& sample) {
    const ViewTilt& tilt = at(tilts, sample.sub_facet);
    use(projection_motion(primary, secondary, sample, tilt, (point++)->xi));
  });
}

/// Calls use(motion) as for_each_varying_motion() does, with the smallest VaryingNumber that is sufficient for the
/// facets.
void for_each_motion_of(const PointsOfPair& points, const PlacedFacet& primary, const PlacedFacet& secondary, int order,
                        const UseMotion& use) {
  const int corners = number_of(sub_facets(primary.type).front().nodes) + window_corners(secondary.type, order);
  if (corners <= corners_of_triangles)
    return for_each_varying_motion<VaryingNumber<corners_of_triangles>>(points, primary, secondary, order, use);
  if (corners <= corners_of_pieces)
    return for_each_varying_motion<VaryingNumber<corners_of_pieces>>(points, primary, secondary, order, use);
  for_each_varying_motion<VaryingNumber<most_corners>>(points, primary, secondary, order, use);
}

}  // namespace

PlacedFacet placed(const Facet& facet, const Matrix3Xd& x) { return {facet.type, facet_coordinates(facet, x)}; }

SampledFacet sampled(const Facet& facet, const Matrix3Xd& x, std::pmr::memory_resource* memory) {
  const PlacedFacet here = placed(facet, x);
  return {here, pieces_of<double>(here, memory), middle_normal(here.type, here.x)};
}

bool add_points_between(const SampledFacet& primary, const Facet& two, const Matrix3Xd& x2, const Circle& circle,
                        int order, FacetPairs& pairs) {
  if (are_apart(primary.pieces, circle)) return false;
  const PlacedFacet secondary = placed(two, x2);
  const double share = facing_share(primary.normal, middle_normal(secondary.type, secondary.x));
  if (share == 0) return false;
  if (is_flat(primary.placed.type) && is_flat(two.type))
    return add_points_between_triangles(primary, secondary, share, order, pairs);
  bool complete = true;
  sample_overlap(primary.pieces, secondary, circle, order, [&](const Sample<double>& sample) {
    const std::optional<Vector2d> xi = carried(primary.placed, sample);
    if (!xi) return void(complete = false);
    const Ray ray = normal_ray(primary.placed.type, primary.placed.x, *xi, 0, reach_outside);
    const auto hit = intersect(two.type, secondary.x, ray.origin, ray.direction, ray.tolerance);
    if (!hit) return void(complete = false);
    pairs.add_point({*xi, hit->eta, share * carried_weight(primary.placed, sample, *xi), sample.sub_facet});
  });
  return complete && pairs.pairs().back().points > 0;
}

bool lies_over(const Piece<double>& piece, const Vector2d& from, const Vector2d& to) {
  const double coincident = coincident_fraction * std::sqrt(piece.area);
  double first = 0;  // start of the part of the segment that is over the piece, 0 to 1
  double last = 1;
  Vector2d start = piece.polygon.back().value();
  for (const Place<double>& corner : piece.polygon) {
    const Vector2d along = corner.value() - start;
    const auto height = [&](const Vector2d& x) { return along[0] * (x[1] - start[1]) - along[1] * (x[0] - start[0]); };
    const double at_from = height(from);
    const double at_to = height(to);
    const double on_line = coincident * along.norm();
    if (at_from <= on_line && at_to <= on_line) return false;
    if (at_from < 0) first = std::max(first, at_from / (at_from - at_to));
    if (at_to < 0) last = std::min(last, at_from / (at_from - at_to));
    start = corner.value();
  }
  return last - first > coincident_fraction;
}

void for_each_overlap_motion(const PointsOfPair& points, const PlacedFacet& primary, const PlacedFacet& secondary,
                             int order, const UseMotion& use) {
  if (share_of(primary, secondary) == 1) return for_each_motion_of(points, primary, secondary, order, use);
  const PairVariation<1> share = facing_share_variation(primary.type, primary.x, secondary.type, secondary.x);
  for_each_motion_of(points, primary, secondary, order, [&](PointMotion motion) {
    motion.weight += share;
    use(motion);
  });
}

}  // namespace mixture_contact
