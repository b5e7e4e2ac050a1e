/// Many lists in one contiguous piece of memory.
#pragma once

#include "base/indexed_vector.h"

#include <iterator>
#include <numeric>

namespace mixture_contact {

/// A view of successive entries of a container, which has to outlive it.
template <class T>
class Span {
 public:
  Span() = default;
  Span(const T* first, Index count) : first_(first), count_(count) {}

  const T* begin() const { return first_; }
  const T* end() const { return std::next(first_, count_); }
  Index count() const { return count_; }
  bool empty() const { return count_ == 0; }
  const T& front() const { return *first_; }
  const T& operator[](Index entry) const { return *std::next(first_, entry); }

 private:
  const T* first_ = nullptr;
  Index count_ = 0;
};

/// Lists whose entries are stored contiguously, each in the order in which they were added.
template <class T>
class Lists {
 public:
  Lists() : first_(1, 0) {}
  /// Makes `count` lists. for_each(add) has to call add(list, entry) for all entries, in any order; it is called twice
  /// and has to do the same both times.
  template <class ForEach>
  Lists(Index count, const ForEach& for_each) : first_(count + 1, 0) {
    for_each([&](Index list, const T& /*entry*/) { ++first_[list + 1]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    entries_.resize(indexing::entries(first_.back()));
    IndexedVector<Index> next(first_);
    for_each([&](Index list, const T& entry) { entries_[next[list]++] = entry; });
  }

  Index count() const { return first_.count() - 1; }
  /// Appends a list.
  template <class Entries>
  void add(const Entries& entries) {
    entries_.insert(entries_.end(), entries.begin(), entries.end());
    end_next();
  }
  /// Adds an entry to the list that end_next() will append.
  void add_to_next(const T& entry) { entries_.push_back(entry); }
  /// Appends the list of the entries that add_to_next() has added.
  void end_next() { first_.push_back(entries_.count()); }
  void clear() {
    first_.resize(1);
    entries_.clear();
  }
  Span<T> operator[](Index list) const {
    return {std::next(entries_.data(), first_[list]), first_[list + 1] - first_[list]};
  }

 private:
  IndexedVector<Index> first_;  ///< per list, index of its first entry; last: the number of all entries
  IndexedVector<T> entries_;
};

}  // namespace mixture_contact
