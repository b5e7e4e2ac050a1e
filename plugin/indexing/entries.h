/// Entries and sizes of containers by integers of any kind, where containers count in std::size_t, hosts in int and
/// Eigen in its own index: their callers need no cast.
#pragma once

#include <cstddef>
#include <utility>

namespace indexing {

/// An entry of an array or a std::vector.
template <class Container, class Number>
constexpr decltype(auto) at(Container&& entries, Number number) {
  return std::forward<Container>(entries)[static_cast<std::size_t>(number)];
}

/// The number of entries as an int, for hosts and files that count in ints.
template <class Container>
int number_of(const Container& entries) {
  return static_cast<int>(entries.size());
}

/// A number of entries, as containers take it.
template <class Number>
constexpr std::size_t entries(Number number) {
  return static_cast<std::size_t>(number);
}

/// A number that an int can hold.
template <class Number>
constexpr int as_int(Number number) {
  return static_cast<int>(number);
}

}  // namespace indexing
