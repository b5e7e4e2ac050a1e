/// Points and polygons in a plane. Their coordinates are numbers, or numbers with exact first derivatives.
#pragma once

#include "base/types.h"

#include <unsupported/Eigen/AutoDiff>

#include <memory_resource>
#include <type_traits>
#include <vector>

namespace mixture_contact {

/// A number with its derivatives with respect to the two coordinates of each of `Corners` corners.
template <int Corners>
using VaryingNumber = Eigen::AutoDiffScalar<Eigen::Matrix<double, 2 * Corners, 1>>;

/// Largest number of corners of a linear piece of a facet, and of the outline of a whole facet.
inline constexpr int max_piece_corners = 4;
inline constexpr int max_outline_corners = 8;

/// Largest number of corners of two polygons together: two triangles, two linear pieces, a piece and an outline.
inline constexpr int corners_of_triangles = 2 * 3;
inline constexpr int corners_of_pieces = 2 * max_piece_corners;
inline constexpr int most_corners = max_piece_corners + max_outline_corners;

/// The value of a number without its derivatives.
inline double value_of(double number) { return number; }
template <class Variation>
double value_of(const Eigen::AutoDiffScalar<Variation>& number) {
  return number.value();
}

/// A point or a direction in the plane. Number: double or a VaryingNumber.
template <class Number>
struct Place {
  Number x{0};
  Number y{0};

  /// The coordinates without their derivatives.
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

/// Cross product of two vectors in the plane: twice the signed area of their triangle, positive if the second vector is
/// counter-clockwise of the first.
template <class Number>
Number cross(const Place<Number>& one, const Place<Number>& two) {
  return one.x * two.y - one.y * two.x;
}

/// A corner as an independent variable: the given coordinates, whose derivatives with respect to themselves are 1.
/// `corner` is its number.
template <class Number>
Place<Number> corner_place(const Vector2d& value, int corner) {
  if constexpr (std::is_same_v<Number, double>) {
    return {value[0], value[1]};
  } else {
    constexpr int columns = Number::DerType::SizeAtCompileTime;
    return {{value[0], columns, 2 * corner}, {value[1], columns, 2 * corner + 1}};
  }
}

/// Derivatives of a number with respect to the two coordinates of a corner.
template <class Variation>
Eigen::RowVector2d by_corner(const Eigen::AutoDiffScalar<Variation>& number, Index corner) {
  return number.derivatives().template segment<2>(2 * corner).transpose();
}

/// Corners of a polygon in counter-clockwise order, in memory of a given resource.
template <class Number>
using Polygon = std::pmr::vector<Place<Number>>;

}  // namespace mixture_contact
