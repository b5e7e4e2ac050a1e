#include "clipping.h"

#include <Eigen/Geometry>

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

/// The part of a polygon on the left of the line through two points.
Polygon left_of(const Polygon& polygon, const VaryingVector& from, const VaryingVector& to, const VaryingVector& n,
                double coincident) {
  const VaryingVector edge = to - from;
  const double on_line = coincident * edge.value.norm();
  std::vector<double> side;
  side.reserve(polygon.size());
  for (const VaryingVector& corner : polygon) side.push_back(n.value.dot(edge.value.cross(corner.value - from.value)));
  const auto varying_side = [&](std::size_t i) { return triple(n, edge, polygon[i] - from); };
  Polygon rest;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::size_t next = (i + 1) % polygon.size();
    if (side[i] >= -on_line) rest.push_back(polygon[i]);
    const bool leaves = side[i] > on_line && side[next] < -on_line;
    const bool enters = side[i] < -on_line && side[next] > on_line;
    if (leaves || enters) rest.push_back(crossing(polygon[i], polygon[next], varying_side(i), varying_side(next)));
  }
  return rest;
}

}  // namespace

VaryingVector operator+(const VaryingVector& one, const VaryingVector& two) {
  return {one.value + two.value, one.variation + two.variation};
}

VaryingVector operator-(const VaryingVector& one, const VaryingVector& two) {
  return {one.value - two.value, one.variation - two.variation};
}

VaryingVector operator*(double factor, const VaryingVector& vector) {
  return {factor * vector.value, factor * vector.variation};
}

VaryingVector operator*(const VaryingNumber& factor, const VaryingVector& vector) {
  return {factor.value * vector.value, factor.value * vector.variation + vector.value * factor.variation};
}

VaryingNumber triple(const VaryingVector& n, const VaryingVector& a, const VaryingVector& b) {
  const Vector3d ab = a.value.cross(b.value);
  const Vector3d bn = b.value.cross(n.value);
  const Vector3d na = n.value.cross(a.value);
  return {n.value.dot(ab), ab.transpose() * n.variation + bn.transpose() * a.variation + na.transpose() * b.variation};
}

VaryingVector normalized(const VaryingVector& vector) {
  const double length = vector.value.norm();
  const Vector3d unit = vector.value / length;
  return {unit, (vector.variation - unit * (unit.transpose() * vector.variation)) / length};
}

double twice_area(const Polygon& polygon, const Vector3d& n) {
  double sum = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    sum += n.dot((polygon[i - 1].value - polygon[0].value).cross(polygon[i].value - polygon[0].value));
  }
  return sum;
}

VaryingVector centroid(const Polygon& polygon, const VaryingVector& n) {
  VaryingNumber area = triple(n, polygon[1] - polygon[0], polygon[2] - polygon[0]);
  VaryingVector moment = area * (polygon[1] + polygon[2] - 2 * polygon[0]);
  for (std::size_t i = 3; i < polygon.size(); ++i) {
    const VaryingVector one = polygon[i - 1] - polygon[0];
    const VaryingVector two = polygon[i] - polygon[0];
    const VaryingNumber part = triple(n, one, two);
    area = {area.value + part.value, area.variation + part.variation};
    moment = moment + part * (one + two);
  }
  const VaryingNumber share{1 / (3 * area.value), -area.variation / (3 * area.value * area.value)};
  return polygon[0] + share * moment;
}

Polygon clip(Polygon polygon, const Polygon& window, const VaryingVector& n, double coincident) {
  for (std::size_t i = 0; i < window.size() && !polygon.empty(); ++i) {
    polygon = left_of(polygon, window[i], window[(i + 1) % window.size()], n, coincident);
  }
  return polygon;
}

}  // namespace mixture_contact
