#include "matrix_profile.h"

#include "contact/base/in_order.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

using namespace mixture_contact;

namespace newton {

namespace {

using Interval = SparseMatrixProfile::RowEntry;

bool is_before(const Interval& one, const Interval& two) { return one.start < two.start; }

void append(SparseMatrixProfile::ColumnProfile& column, RowIntervals& rows) {
  for (int i = 0; i < column.size(); ++i) rows.push_back(column[i]);
}

/// Joins adjacent and overlapping intervals, which are in the order of their starts.
void join(RowIntervals& ascending) {
  if (ascending.empty()) return;
  auto last = ascending.begin();
  for (auto next = last + 1; next != ascending.end(); ++next) {
    if (next->start > last->end + 1) {
      *++last = *next;
    } else {
      last->end = std::max(last->end, next->end);
    }
  }
  ascending.erase(last + 1, ascending.end());
}

/// Sets `both` to the union of two ascending lists.
void set_merged(const RowIntervals& one, const RowIntervals& two, RowIntervals& both) {
  both.resize(one.size() + two.size());
  std::merge(one.begin(), one.end(), two.begin(), two.end(), both.begin(), is_before);
  join(both);
}

/// Sets `rows` to the intervals of equations, which may be in any order. `sorted`: working memory.
void set_intervals(Span<int> equations, std::vector<int>& sorted, RowIntervals& rows) {
  sorted.assign(equations.begin(), equations.end());
  std::sort(sorted.begin(), sorted.end());
  rows.clear();
  for (const int equation : sorted) {
    if (rows.empty() || equation > rows.back().end + 1) rows.push_back({equation, equation});
    rows.back().end = equation;
  }
}

/// The equations that the profile couples with any of the given equations, each once.
std::vector<int> coupled_with(Span<int> equations, SparseMatrixProfile& profile) {
  RowIntervals all;
  for (const int equation : equations) append(profile.Column(equation), all);
  unite(all);
  std::vector<int> found;
  for (const Interval& interval : all) {
    for (int row = interval.start; row <= interval.end; ++row) found.push_back(row);
  }
  return found;
}

/// Successive columns that belong to the same blocks, as the columns of one node usually do.
struct Columns {
  Index first;
  Index end;
};

/// All groups of successive columns that belong to the same blocks, except columns that belong to no block.
IndexedVector<Columns> alike(const Lists<Index>& blocks_of) {
  const auto are_alike = [&](Index one, Index other) {
    return std::equal(blocks_of[one].begin(), blocks_of[one].end(), blocks_of[other].begin(), blocks_of[other].end());
  };
  IndexedVector<Columns> found;
  for (Index column = 0; column < blocks_of.count(); ++column) {
    if (blocks_of[column].empty()) continue;
    const bool goes_on = !found.empty() && found.back().end == column && are_alike(column - 1, column);
    if (!goes_on) found.push_back({column, column});
    ++found.back().end;
  }
  return found;
}

/// Working memory of a thread for one group of columns; it is reused for the next group.
struct ColumnMemory {
  RowIntervals rows;
  RowIntervals present;
  RowIntervals both;
};

}  // namespace

void unite(RowIntervals& intervals) {
  std::sort(intervals.begin(), intervals.end(), is_before);
  join(intervals);
}

void CoupledBlocks::check(int equation) const {
  if (equation >= columns_)
    throw std::out_of_range("equation " + std::to_string(equation) + " of " + std::to_string(columns_));
}

Index CoupledBlocks::list_of(const std::vector<int>& equations) {
  for (const int equation : equations) {
    check(equation);
    if (equation >= 0) lists_.add_to_next(equation);
  }
  lists_.end_next();
  return lists_.count() - 1;
}

void CoupledBlocks::add(const std::vector<int>& equations) {
  const Index all = list_of(equations);
  blocks_.push_back({all, all});
}

void CoupledBlocks::add_star(int centre, const std::vector<int>& equations) {
  const Index own = list_of({centre});
  const Index others = list_of(equations);
  blocks_.push_back({others, own});
  blocks_.push_back({own, others});
  blocks_.push_back({own, own});
}

void CoupledBlocks::add_rows(const std::vector<int>& rows, const std::vector<int>& columns) {
  const Index own = list_of(rows);
  blocks_.push_back({list_of(columns), own});
}

void CoupledBlocks::add_sum(int row, const std::vector<int>& others) { sums_.push_back({row, list_of(others)}); }

void CoupledBlocks::add_sums(SparseMatrixProfile& profile) {
  if (sums_.empty()) return;
  const Lists<int> sums_of(columns_, [&](const auto& add) {  // per row, the rows that get its columns
    for (const auto& [row, others] : sums_) {
      for (const int other : lists_[others]) add(other, row);
    }
  });
  std::vector<int> extended;
  for (Block& block : blocks_) {
    const Span<int> rows = lists_[block.rows];
    extended.assign(rows.begin(), rows.end());
    for (const int row : rows) extended.insert(extended.end(), sums_of[row].begin(), sums_of[row].end());
    if (count_of(extended) > rows.count()) block.rows = list_of(extended);
  }
  for (const auto& [row, others] : sums_) add_rows({row}, coupled_with(lists_[others], profile));
}

Lists<Index> CoupledBlocks::blocks_of_columns() const {
  return {columns_, [&](const auto& add) {
            // Nodes of a rigid body share equations, so that a block may contain an equation several times.
            IndexedVector<Index> last(columns_, -1);
            for (Index block = 0; block < blocks_.count(); ++block) {
              for (const int column : lists_[blocks_[block].columns]) {
                if (std::exchange(last[column], block) != block) add(column, block);
              }
            }
          }};
}

Lists<Interval> CoupledBlocks::rows_of_blocks() const {
  Lists<Interval> found;
  in_order_with(
      std::vector<int>(), RowIntervals(), blocks_.count(),
      [&](Index block, RowIntervals& rows, std::vector<int>& sorted) {
        set_intervals(lists_[blocks_[block].rows], sorted, rows);
      },
      [&](Index /*block*/, const RowIntervals& rows) { found.add(rows); });
  return found;
}

void CoupledBlocks::insert_into(SparseMatrixProfile& profile) {
  add_sums(profile);
  const Lists<Index> blocks_of = blocks_of_columns();
  const IndexedVector<Columns> columns = alike(blocks_of);
  const Lists<Interval> rows_of = rows_of_blocks();
  const auto column_of_profile = [&](Index column) -> SparseMatrixProfile::ColumnProfile& {
    return profile.Column(indexing::as_int(column));
  };
  const auto unite_with_present = [&](Index n, Lists<Interval>& all, ColumnMemory& own) {
    own.rows.clear();
    for (const Index block : blocks_of[columns[n].first])
      own.rows.insert(own.rows.end(), rows_of[block].begin(), rows_of[block].end());
    unite(own.rows);
    all.clear();
    for (Index column = columns[n].first; column < columns[n].end; ++column) {
      own.present.clear();
      append(column_of_profile(column), own.present);
      set_merged(own.present, own.rows, own.both);
      all.add(own.both);
    }
  };
  in_order_with(ColumnMemory(), Lists<Interval>(), columns.count(), unite_with_present,
                [&](Index n, const Lists<Interval>& all) {
                  for (Index i = 0; i < all.count(); ++i) {
                    SparseMatrixProfile::ColumnProfile& present = column_of_profile(columns[n].first + i);
                    present.clear();
                    for (const Interval& interval : all[i]) present.push_back(interval.start, interval.end);
                  }
                });
}

}  // namespace newton
