/// Lists of entries side by side in memory: one piece of it for all, not one for each.
#pragma once

#include "base/indexed_vector.h"

#include <iterator>
#include <numeric>

namespace mixture_contact {

/// Entries that follow each other in a container that lives longer.
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

/// Lists of entries, each in the order in which they were added.
template <class T>
class Lists {
 public:
  Lists() : first_(1, 0) {}
  /// Lists, as many as given, filled in any order: for_each(add) calls add(list, entry) for all entries; it is called
  /// twice, and does the same both times.
  template <class ForEach>
  Lists(Index count, const ForEach& for_each) : first_(count + 1, 0) {
    for_each([&](Index list, const T& /*entry*/) { ++first_[list + 1]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    entries_.resize(indexing::entries(first_.back()));
    IndexedVector<Index> next(first_);
    for_each([&](Index list, const T& entry) { entries_[next[list]++] = entry; });
  }

  Index count() const { return first_.count() - 1; }
  /// Adds a list behind the others.
  template <class Entries>
  void add(const Entries& entries) {
    entries_.insert(entries_.end(), entries.begin(), entries.end());
    end_next();
  }
  /// Adds an entry to the list that is to be the next one, and ends that list.
  void add_to_next(const T& entry) { entries_.push_back(entry); }
  void end_next() { first_.push_back(entries_.count()); }
  void clear() {
    first_.resize(1);
    entries_.clear();
  }
  Span<T> operator[](Index list) const {
    return {std::next(entries_.data(), first_[list]), first_[list + 1] - first_[list]};
  }

 private:
  IndexedVector<Index> first_;  ///< per list the place of its first entry; behind them all, how many entries there are
  IndexedVector<T> entries_;
};

}  // namespace mixture_contact
