/// Access to container entries and sizes with any integer type, without casts: standard containers use std::size_t,
/// hosts int and Eigen a signed index.
#pragma once

#include <cstddef>
#include <utility>

namespace indexing {

/// The entry of an array or a std::vector with this number.
template <class Container, class Number>
constexpr decltype(auto) at(Container&& entries, Number number) {
  return std::forward<Container>(entries)[static_cast<std::size_t>(number)];
}

/// The number of entries as an int.
template <class Container>
int number_of(const Container& entries) {
  return static_cast<int>(entries.size());
}

/// A number of entries as std::size_t.
template <class Number>
constexpr std::size_t entries(Number number) {
  return static_cast<std::size_t>(number);
}

/// A number as an int, which has to be large enough for it.
template <class Number>
constexpr int as_int(Number number) {
  return static_cast<int>(number);
}

}  // namespace indexing
