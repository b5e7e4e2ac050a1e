#include "integration/segments.h"

#include "base/in_order.h"
#include "base/local_memory.h"
#include "geometry/circle.h"
#include "geometry/quadrature.h"
#include "integration/facing_share.h"
#include "integration/polygon_quadrature.h"
#include "integration/view.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <iterator>
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
/// Largest number of linear pieces of a facet.
constexpr std::size_t max_pieces = 6;

/// A facet of a pair with its nodal coordinates.
struct PlacedFacet {
  FacetType type;
  FacetCoordinates x;
};

PlacedFacet placed(const Facet& facet, const Matrix3Xd& x) { return {facet.type, facet_coordinates(facet, x)}; }

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
  const auto& [y, area] = sample.point;
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

/// The projection of a linear piece of the primary facet, with which secondary facets are clipped.
template <class Number>
struct Piece {
  const SubFacet& part;
  View view;
  Circle circle;
  Polygon<Number> polygon;
  double area = 0;  ///< twice the area of the polygon
  Alignment<Number> aligned;
};

template <class Number>
using Pieces = std::pmr::vector<Piece<Number>>;

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

/// Upper bound for most facets of the memory of all pieces, with their polygons and tilts [bytes].
template <class Number>
constexpr std::size_t bytes_of_pieces = max_pieces * (sizeof(Piece<Number>) +
                                                      max_piece_corners * sizeof(Place<Number>) + sizeof(ViewTilt));

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

/// A primary facet with the quantities that all its overlaps have in common.
struct SampledFacet {
  PlacedFacet placed;
  Pieces<double> pieces;
  Vector3d normal;  ///< unit normal in the middle of the facet
};

SampledFacet sampled(const Facet& facet, const Matrix3Xd& x, std::pmr::memory_resource* memory) {
  const PlacedFacet here = placed(facet, x);
  return {here, pieces_of<double>(here, memory), middle_normal(here.type, here.x)};
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

/// Adds the points between a primary facet at x1 and a secondary facet at x2 to the last pair. `circle`: around the
/// secondary facet. Returns true if there is a point and all points were projected.
bool add_points_between(const Facet& one, const SampledFacet& primary, const Facet& two, const Circle& circle,
                        int order, const Matrix3Xd& x1, const Matrix3Xd& x2, FacetPairs& pairs) {
  if (are_apart(primary.pieces, circle)) return false;
  const PlacedFacet secondary = placed(two, x2);
  const double share = facing_share(primary.normal, middle_normal(secondary.type, secondary.x));
  if (share == 0) return false;
  if (is_flat(one.type) && is_flat(two.type))
    return add_points_between_triangles(primary, secondary, share, order, pairs);
  bool complete = true;
  sample_overlap(primary.pieces, secondary, circle, order, [&](const Sample<double>& sample) {
    const std::optional<Vector2d> xi = carried(primary.placed, sample);
    if (!xi) return void(complete = false);
    const Ray ray = normal_ray(one, x1, *xi, 0, reach_outside);
    const auto hit = intersect(two.type, secondary.x, ray.origin, ray.direction, ray.tolerance);
    if (!hit) return void(complete = false);
    pairs.add_point({*xi, hit->eta, share * carried_weight(primary.placed, sample, *xi), sample.sub_facet});
  });
  return complete && pairs.pairs().back().points > 0;
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

/// True if a segment is over the interior of a piece, not only along its outline.
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

/// True if the secondary surface continues, in other pairs of the same primary facet, across every edge of its facets
/// that lies over the facet. `piece`: the only linear piece of the primary facet.
bool goes_on(const FacetPairs& of_facet, const Piece<double>& piece, const IndexedVector<Facet>& others,
             const EdgeNeighbours& neighbours, const Matrix3Xd& x2) {
  const auto is_paired = [&](int other) {
    return std::any_of(of_facet.pairs().begin(), of_facet.pairs().end(),
                       [&](const FacetPair& pair) { return pair.secondary == other; });
  };
  return std::all_of(of_facet.pairs().begin(), of_facet.pairs().end(), [&](const FacetPair& pair) {
    const Facet& facet = others[pair.secondary];
    for (int corner = 0; corner < facet.count(); ++corner) {
      const std::optional<int> next = neighbours.across(pair.secondary, corner);
      if (next && is_paired(*next)) continue;
      const auto seen = [&](int node) { return piece.view.seen(x2.col(facet.node(node % facet.count()))); };
      if (lies_over(piece, seen(corner), seen(corner + 1))) return false;
    }
    return true;
  });
}

/// True if all shape functions of a facet are polynomials of total degree 2 at most.
bool is_quadratic(FacetType type) {
  return type == FacetType::tri3 || type == FacetType::tri6 || type == FacetType::quad4;
}

bool share_a_node(const Facet& one, const Facet& two) {
  return std::any_of(one.nodes.begin(), one.nodes.begin() + node_count(one.type), [&](int node) {
    const auto* end = two.nodes.begin() + node_count(two.type);
    return std::find(two.nodes.begin(), end, node) != end;
  });
}

const IntegrationPoint& heaviest(const PointsOfPair& points) {
  return *std::max_element(points.begin(), points.end(),
                           [](const auto& one, const auto& two) { return one.weight < two.weight; });
}

/// Removes the pairs for which `leaves` is true; all are tested before any is removed. `rest`: memory for the remaining
/// pairs.
template <class Leaves>
void remove_pairs(FacetPairs& pairs, FacetPairs& rest, const Leaves& leaves) {
  if (std::none_of(pairs.pairs().begin(), pairs.pairs().end(), leaves)) return;
  rest.clear();
  for (const FacetPair& pair : pairs.pairs()) {
    if (!leaves(pair)) rest.add(pairs, pair);
  }
  std::swap(pairs, rest);
}

}  // namespace

int default_segment_order(FacetType primary, FacetType secondary) {
  return is_quadratic(primary) && is_quadratic(secondary) ? 2 : 3;
}

Segments::Segments(const IndexedVector<Facet>& primary, const IndexedVector<Facet>& secondary, int order,
                   SelfContact self, EdgeNeighbours neighbours, Visibility visibility)
    : primary_(primary),
      secondary_(secondary),
      order_(order),
      self_(std::move(self)),
      neighbours_(std::move(neighbours)),
      visibility_(std::move(visibility)) {}

int Segments::order(const Facing& facing) const {
  if (order_ > 0) return order_;
  return default_segment_order(primary_[facing.primary].type, secondary_[facing.secondary].type);
}

bool Segments::is_exact(const FacetPair& pair) const {
  const bool flat = is_flat(primary_[pair.primary].type) && is_flat(secondary_[pair.secondary].type);
  return flat && order({pair.primary, pair.secondary}) >= 2;
}

bool Segments::sees(const FacetPair& pair, const IntegrationPoint& point, const Matrix3Xd& x1, const Matrix3Xd& x2,
                    const Reach& reach) const {
  const Facet& one = primary_[pair.primary];
  const Facet& two = secondary_[pair.secondary];
  const Ray ray = normal_ray(one, x1, point.xi, reach.distance, 0);
  const Vector3d apart = facet_coordinates(two, x2) * shape_functions(two.type, point.eta).value - ray.origin;
  const double gap = apart.dot(ray.direction);
  const double tilted = tilted_reach(middle_normal(one.type, facet_coordinates(one, x1)),
                                     middle_normal(two.type, facet_coordinates(two, x2)));
  const bool is_near = self_.is_active() || gap <= tilted * reach.ahead(one, x1);
  return apart.norm() <= reach.distance && is_near && gap >= -self_.largest_overlap(pair.primary) &&
         !visibility_.is_hidden(ray.origin, ray.direction, gap, pair.primary, pair.secondary);
}

std::vector<int> Segments::candidates(int facet, const FacetTree& tree, const Matrix3Xd& x1, const Reach& reach) const {
  const Ray ray = normal_ray(primary_[facet], x1, parametric_centre(primary_[facet].type), reach.distance, 0);
  const double width = radius_around(facet_coordinates(primary_[facet], x1), ray.origin);
  std::vector<int> found = tree.candidates(ray.origin, ray.direction, reach.distance, width);
  self_.keep_visible(facet, found);
  return found;
}

bool Segments::occluded(const FacetPair& pair, const FacetPairs& all, const Matrix3Xd& x1, const Matrix3Xd& x2,
                        const IndexedVector<Circle>& circles) const {
  const Facet& one = primary_[pair.primary];
  const Facet& two = secondary_[pair.secondary];
  const IntegrationPoint& point = heaviest(all.points(pair));
  const Ray ray = normal_ray(one, x1, point.xi, 0, 0);
  const Vector3d paired = facet_coordinates(two, x2) * shape_functions(two.type, point.eta).value;
  return std::any_of(all.pairs().begin(), all.pairs().end(), [&](const FacetPair& rival) {
    const Facet& facet = secondary_[rival.secondary];
    if (is_flat(facet.type) && is_passed(circles[rival.secondary], ray.origin, ray.direction)) return false;
    if (share_a_node(facet, two)) return false;
    const auto hit = intersect(facet.type, facet_coordinates(facet, x2), ray.origin, ray.direction, ray.tolerance);
    return hit && std::abs(hit->gap) < (paired - ray.origin).norm();
  });
}

bool Segments::is_kept(const FacetPair& pair) const {
  const auto found = losses_.find({pair.primary, pair.secondary});
  return found != losses_.end() && found->second >= most_losses;
}

bool Segments::begin_iteration() {
  std::vector<Facing> lost;
  std::set_difference(at_iteration_.begin(), at_iteration_.end(), paired_.begin(), paired_.end(),
                      std::back_inserter(lost));
  bool finds_more = false;
  for (const Facing& pair : lost) finds_more = ++losses_[pair] == most_losses || finds_more;
  at_iteration_ = paired_;
  return finds_more;
}

bool Segments::end_iterations() {
  const bool kept_any = std::any_of(losses_.begin(), losses_.end(),
                                    [](const auto& pair) { return pair.second >= most_losses; });
  at_iteration_.clear();
  losses_.clear();
  return kept_any;
}

FacetPairs Segments::search(const Matrix3Xd& x1, const Matrix3Xd& x2, const Reach& reach) {
  FacetPairs found;
  paired_.clear();
  if (!surfaces_within_reach(x1, x2, reach.distance)) return found;
  visibility_.move_to(x1, x2);
  const FacetTree tree(secondary_, x2, box_margin);
  const IndexedVector<Circle> circles = circles_around(secondary_, x2);
  const auto add_near = [&](int facet, int other, const SampledFacet& one, FacetPairs& near) {
    near.add_pair(facet, other);
    const FacetPair& pair = near.pairs().back();
    if (!add_points_between(primary_[facet], one, secondary_[other], circles[other], order({facet, other}), x1, x2,
                            near))
      return near.remove_last_pair();
    if (!is_kept(pair) && !sees(pair, heaviest(near.points(pair)), x1, x2, reach)) near.remove_last_pair();
  };
  const auto set_visible = [&](Index index, FacetPairs& near, FacetPairs& visible) {
    near.clear();
    const int facet = static_cast<int>(index);
    const std::vector<int> others = candidates(facet, tree, x1, reach);
    if (others.empty()) return;
    LocalMemory<bytes_of_pieces<double>> memory;
    const SampledFacet one = sampled(primary_[facet], x1, memory.resource());
    for (const int other : others) add_near(facet, other, one, near);
    // Hidden pairs count in the test of the other pairs: a hidden facet hides others as well.
    const auto is_hidden = [&](const FacetPair& pair) {
      return !is_kept(pair) && occluded(pair, near, x1, x2, circles);
    };
    remove_pairs(near, visible, is_hidden);
    const auto exact = [&](const FacetPair& pair) {
      return is_exact(pair) && share_of(one.placed, placed(secondary_[pair.secondary], x2)) == 1;
    };
    if (std::all_of(near.pairs().begin(), near.pairs().end(), exact) &&
        goes_on(near, one.pieces.front(), secondary_, neighbours_, x2))
      near.set_unbroken();
  };
  const auto add_all = [&](Index /*facet*/, const FacetPairs& visible) {
    for (const FacetPair& pair : visible.pairs()) {
      paired_.push_back({pair.primary, pair.secondary});
      found.add(visible, pair);
    }
  };
  in_order_with(FacetPairs(), FacetPairs(), primary_.count(), set_visible, add_all);
  return found;
}

FacetPairs Segments::on_same_facets(const Matrix3Xd& x1, const Matrix3Xd& x2) {
  FacetPairs found;
  for (const Facing& facing : paired_) {
    const Facet& one = primary_[facing.primary];
    const Facet& two = secondary_[facing.secondary];
    LocalMemory<bytes_of_pieces<double>> memory;
    found.add_pair(facing.primary, facing.secondary);
    if (!add_points_between(one, sampled(one, x1, memory.resource()), two, circle_around(facet_coordinates(two, x2)),
                            order(facing), x1, x2, found))
      found.remove_last_pair();
  }
  return found;
}

void Segments::for_each_motion(const FacetPair& pair, const PointsOfPair& points, const Matrix3Xd& x1,
                               const Matrix3Xd& x2, const UseMotion& use) const {
  if (pair.unbroken) return use_no_motion(points.count(), use);
  const PlacedFacet primary = placed(primary_[pair.primary], x1);
  const PlacedFacet secondary = placed(secondary_[pair.secondary], x2);
  const int rule = order({pair.primary, pair.secondary});
  if (share_of(primary, secondary) == 1) return for_each_motion_of(points, primary, secondary, rule, use);
  const PairVariation<1> share = facing_share_variation(primary.type, primary.x, secondary.type, secondary.x);
  for_each_motion_of(points, primary, secondary, rule, [&](PointMotion motion) {
    motion.weight += share;
    use(motion);
  });
}

}  // namespace mixture_contact
