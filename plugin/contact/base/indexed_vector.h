/// Containers with Eigen's type of index, for data per node, facet, field or pair.
#pragma once

#include "base/types.h"
#include "indexing/entries.h"

#include <algorithm>
#include <type_traits>
#include <utility>
#include <vector>

namespace mixture_contact {

/// The number of entries of a container as Eigen's index type.
template <class Container>
Index count_of(const Container& entries) {
  return static_cast<Index>(entries.size());
}

using indexing::at;
using indexing::number_of;

/// A std::vector with operator[] for any integer type, such that Eigen's indices need no cast.
template <class T>
class IndexedVector : public std::vector<T> {
 public:
  using Base = std::vector<T>;
  using Base::Base;
  using Base::operator=;
  IndexedVector() = default;
  explicit IndexedVector(Base entries) : Base(std::move(entries)) {}
  template <class I, std::enable_if_t<std::is_integral_v<I>, bool> = true>
  explicit IndexedVector(I count, const T& entry = T()) : Base(static_cast<std::size_t>(count), entry) {}

  Index count() const { return count_of(*this); }

  /// Sets the vector to `count` copies of an entry.
  template <class I>
  void fill(I count, const T& entry) {
    this->assign(static_cast<std::size_t>(count), entry);
  }

  template <class I>
  typename Base::reference operator[](I index) {
    return Base::operator[](static_cast<std::size_t>(index));
  }
  template <class I>
  typename Base::const_reference operator[](I index) const {
    return Base::operator[](static_cast<std::size_t>(index));
  }
};

/// The position of an entry in a list; the number of entries if it is not in the list.
template <class T>
Index position_in(const IndexedVector<T>& list, const T& entry) {
  return std::find(list.begin(), list.end(), entry) - list.begin();
}

/// Adds to `list` the entries of `more` that it does not contain.
template <class Entries>
void merge_unique(IndexedVector<int>& list, const Entries& more) {
  for (const int entry : more) {
    if (std::find(list.begin(), list.end(), entry) == list.end()) list.push_back(entry);
  }
}

/// One boolean per node of a surface.
using NodeFlags = IndexedVector<bool>;

inline bool any(const NodeFlags& flags) { return std::find(flags.begin(), flags.end(), true) != flags.end(); }

}  // namespace mixture_contact
