/// Places in a plane, whose coordinates are numbers or numbers with their exact first variations.
#pragma once

#include "base/types.h"

#include <unsupported/Eigen/AutoDiff>

#include <vector>

namespace mixture_contact {

/// Corners of the two polygons that an overlap is made of, each of three or four.
inline constexpr int max_polygon_corners = 4;
inline constexpr int max_overlap_corners = 2 * max_polygon_corners;

/// A number with its variation with the places of these corners, two columns for each.
using VaryingNumber = Eigen::AutoDiffScalar<Eigen::Matrix<double, 2 * max_overlap_corners, 1>>;

inline double value_of(double number) { return number; }
inline double value_of(const VaryingNumber& number) { return number.value(); }

/// A place or a direction; Number: double or VaryingNumber.
template <class Number>
struct Place {
  Number x{0};
  Number y{0};

  Vector2d value() const { return {value_of(x), value_of(y)}; }
};

template <class Number>
Place<Number> operator+(const Place<Number>& one, const Place<Number>& two) {
  return {one.x + two.x, one.y + two.y};
}

template <class Number>
Place<Number> operator-(const Place<Number>& one, const Place<Number>& two) {
  return {one.x - two.x, one.y - two.y};
}

template <class Number, class Factor>
Place<Number> operator*(const Factor& factor, const Place<Number>& place) {
  return {factor * place.x, factor * place.y};
}

/// Of two edges of a triangle twice its area, positive where they turn counter-clockwise.
template <class Number>
Number cross(const Place<Number>& one, const Place<Number>& two) {
  return one.x * two.y - one.y * two.x;
}

/// The place of a corner, given by its number, where it varies.
template <class Number>
Place<Number> corner_place(const Vector2d& value, int corner);
template <>
inline Place<double> corner_place(const Vector2d& value, int /*corner*/) {
  return {value[0], value[1]};
}
template <>
inline Place<VaryingNumber> corner_place(const Vector2d& value, int corner) {
  return {{value[0], 2 * max_overlap_corners, 2 * corner}, {value[1], 2 * max_overlap_corners, 2 * corner + 1}};
}

/// Variation of a number with the place of a corner.
inline Eigen::RowVector2d by_corner(const VaryingNumber& number, Index corner) {
  return number.derivatives().segment<2>(2 * corner).transpose();
}

/// Corners in counter-clockwise order.
template <class Number>
using Polygon = std::vector<Place<Number>>;

}  // namespace mixture_contact
