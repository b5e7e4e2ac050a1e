/// Entries and sizes of vectors by numbers that are not negative, which hosts count as int: the one place that casts.
#pragma once

#include <cstddef>
#include <utility>

namespace newton {

/// The entry of a vector at a number.
template <class Vector, class Number>
decltype(auto) at(Vector&& vector, Number number) {
  return std::forward<Vector>(vector)[static_cast<std::size_t>(number)];
}

/// The number of entries.
template <class Vector>
int count(const Vector& vector) {
  return static_cast<int>(vector.size());
}

/// A number of entries, as vectors take it.
template <class Number>
std::size_t entries(Number number) {
  return static_cast<std::size_t>(number);
}

/// A number that an int can hold.
template <class Number>
int as_int(Number number) {
  return static_cast<int>(number);
}

}  // namespace newton
