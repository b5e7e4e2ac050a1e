#include "integration/clipping.h"

#include "base/indexed_vector.h"

#include <algorithm>
#include <utility>

namespace mixture_contact {
namespace {

double cross_of_values(const Vector2d& one, const Vector2d& two) { return one[0] * two[1] - one[1] * two[0]; }

/// The zero on the segment from a to b of a linear function with the values va at a and vb at b, which have opposite
/// signs.
template <class Number>
Place<Number> crossing(const Place<Number>& a, const Place<Number>& b, const Number& va, const Number& vb) {
  const Number t = va / (va - vb);
  return a + t * (b - a);
}

/// Removes the part of a polygon that is on the right of the line through two points.
template <class Number>
void keep_left(Polygon<Number>& polygon, const Place<Number>& from, const Place<Number>& to, double coincident) {
  const Vector2d along = to.value() - from.value();
  const double on_line = coincident * along.norm();
  std::pmr::vector<double> heights(polygon.get_allocator().resource());
  heights.reserve(polygon.size());
  for (const Place<Number>& corner : polygon) heights.push_back(cross_of_values(along, corner.value() - from.value()));
  const auto is_kept = [&](double height) { return height >= -on_line; };
  if (std::all_of(heights.begin(), heights.end(), is_kept)) return;
  const Place<Number> edge = to - from;
  const auto side = [&](const Place<Number>& corner) -> Number { return cross(edge, Place<Number>(corner - from)); };
  Polygon<Number> rest(polygon.get_allocator());
  rest.reserve(polygon.size() + 1);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::size_t j = (i + 1) % polygon.size();
    const Place<Number>& corner = polygon[i];
    const Place<Number>& next = polygon[j];
    if (is_kept(heights[i])) rest.push_back(corner);
    const bool leaves = heights[i] > on_line && heights[j] < -on_line;
    const bool enters = heights[i] < -on_line && heights[j] > on_line;
    if (leaves || enters) rest.push_back(crossing(corner, next, side(corner), side(next)));
  }
  polygon = std::move(rest);
}

}  // namespace

template <class Number>
double twice_area(const Polygon<Number>& polygon) {
  double sum = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    sum += cross_of_values(polygon[i - 1].value() - polygon[0].value(), polygon[i].value() - polygon[0].value());
  }
  return sum;
}

template <class Number>
Polygon<Number> clip(Polygon<Number> polygon, const Polygon<Number>& window, double coincident) {
  for (std::size_t i = 0; i < window.size() && !polygon.empty(); ++i) {
    keep_left(polygon, window[i], window[(i + 1) % window.size()], coincident);
  }
  return polygon;
}

template double twice_area(const Polygon<double>&);
template double twice_area(const Polygon<VaryingNumber<corners_of_triangles>>&);
template double twice_area(const Polygon<VaryingNumber<corners_of_pieces>>&);
template double twice_area(const Polygon<VaryingNumber<most_corners>>&);

template <class Number>
using Clip = Polygon<Number>(Polygon<Number>, const Polygon<Number>&, double);
template Clip<double> clip;
template Clip<VaryingNumber<corners_of_triangles>> clip;
template Clip<VaryingNumber<corners_of_pieces>> clip;
template Clip<VaryingNumber<most_corners>> clip;

}  // namespace mixture_contact
