#include "integration/clipping.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <utility>

namespace mixture_contact {
namespace {

/// The point of the segment from a to b at which a number that is va at a and vb at b, of opposite signs, is zero.
VaryingVector crossing(const VaryingVector& a, const VaryingVector& b, const VaryingNumber& va,
                       const VaryingNumber& vb) {
  const double drop = va.value - vb.value;
  const double t = va.value / drop;
  const PairVariation<1> dt = (va.value * vb.variation - vb.value * va.variation) / (drop * drop);
  const Vector3d along = b.value - a.value;
  return {a.value + t * along, (1 - t) * a.variation + t * b.variation + along * dt};
}

/// Cuts off what of a polygon is not on the left of the line through two points.
void keep_left(Polygon& polygon, const VaryingVector& from, const VaryingVector& to, const VaryingVector& n,
               double coincident) {
  const Vector3d along = to.value - from.value;
  const double on_line = coincident * along.norm();
  std::vector<double> side;
  side.reserve(polygon.size());
  for (const VaryingVector& corner : polygon) side.push_back(n.value.dot(along.cross(corner.value - from.value)));
  if (*std::min_element(side.begin(), side.end()) >= -on_line) return;
  const VaryingVector edge = to - from;
  const auto varying_side = [&](std::size_t i) { return triple(n, edge, polygon[i] - from); };
  Polygon rest;
  rest.reserve(polygon.size() + 1);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::size_t next = (i + 1) % polygon.size();
    if (side[i] >= -on_line) rest.push_back(polygon[i]);
    const bool leaves = side[i] > on_line && side[next] < -on_line;
    const bool enters = side[i] < -on_line && side[next] > on_line;
    if (leaves || enters) rest.push_back(crossing(polygon[i], polygon[next], varying_side(i), varying_side(next)));
  }
  polygon = std::move(rest);
}

}  // namespace

double twice_area(const Polygon& polygon, const Vector3d& n) {
  double sum = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    sum += n.dot((polygon[i - 1].value - polygon[0].value).cross(polygon[i].value - polygon[0].value));
  }
  return sum;
}

Polygon clip(Polygon polygon, const Polygon& window, const VaryingVector& n, double coincident) {
  for (std::size_t i = 0; i < window.size() && !polygon.empty(); ++i) {
    keep_left(polygon, window[i], window[(i + 1) % window.size()], n, coincident);
  }
  return polygon;
}

}  // namespace mixture_contact
