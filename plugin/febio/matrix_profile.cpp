#include "matrix_profile.h"

#include "contact/base/in_order.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

using namespace mixture_contact;

namespace {

using Interval = SparseMatrixProfile::RowEntry;

bool is_before(const Interval& one, const Interval& two) { return one.start < two.start; }

void append(SparseMatrixProfile::ColumnProfile& column, RowIntervals& rows) {
  for (int i = 0; i < column.size(); ++i) rows.push_back(column[i]);
}

/// Joins intervals that follow each other, given in the order of their starts.
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

/// The same rows in as few intervals as there can be, ascending.
void unite(RowIntervals& intervals) {
  std::sort(intervals.begin(), intervals.end(), is_before);
  join(intervals);
}

/// Sets `both` to the union of two ascending lists.
void set_merged(const RowIntervals& one, const RowIntervals& two, RowIntervals& both) {
  both.resize(one.size() + two.size());
  std::merge(one.begin(), one.end(), two.begin(), two.end(), both.begin(), is_before);
  join(both);
}

/// Sets `rows` to those of equations in any order. `sorted`: memory for these.
void set_intervals(Span<int> equations, std::vector<int>& sorted, RowIntervals& rows) {
  sorted.assign(equations.begin(), equations.end());
  std::sort(sorted.begin(), sorted.end());
  rows.clear();
  for (const int equation : sorted) {
    if (rows.empty() || equation > rows.back().end + 1) rows.push_back({equation, equation});
    rows.back().end = equation;
  }
}

/// The equations that some have rows for in a profile, each once.
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

/// What a thread remembers of columns, whose memory serves the next ones.
struct ColumnMemory {
  RowIntervals rows;
  RowIntervals present;
  RowIntervals both;
};

}  // namespace

RowIntervals united(RowIntervals intervals) {
  unite(intervals);
  return intervals;
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
  const Lists<int> sums_of(columns_, [&](const auto& add) {  // per row
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

/// The blocks that each column stands in.
class CoupledBlocks::BlocksOfColumns {
 public:
  BlocksOfColumns(int columns, const Lists<int>& lists, const IndexedVector<Block>& blocks) : first_(columns, 0) {
    IndexedVector<Index> most(columns, 0);  // a block that has a column twice counts twice
    for (const Block& block : blocks) {
      for (const int column : lists[block.columns]) ++most[column];
    }
    blocks_.resize(indexing::entries(std::accumulate(most.begin(), most.end(), Index{0})));
    std::exclusive_scan(most.begin(), most.end(), first_.begin(), Index{0});
    end_ = first_;
    for (Index block = 0; block < blocks.count(); ++block) {
      for (const int column : lists[blocks[block].columns]) add(column, block);
    }
  }

  /// Calls use(block) for each, ascending.
  template <class Use>
  void for_each(Index column, const Use& use) const {
    for (Index place = first_[column]; place < end_[column]; ++place) use(blocks_[place]);
  }
  IndexedVector<Columns> alike() const {
    IndexedVector<Columns> found;
    for (Index column = 0; column < end_.count(); ++column) {
      if (count(column) == 0) continue;
      const bool goes_on = !found.empty() && found.back().end == column && are_alike(column - 1, column);
      if (!goes_on) found.push_back({column, column});
      ++found.back().end;
    }
    return found;
  }

 private:
  void add(Index column, Index block) {
    const bool is_there = count(column) > 0 && blocks_[end_[column] - 1] == block;  // nodes of a body share equations
    if (!is_there) blocks_[end_[column]++] = block;
  }
  Index count(Index column) const { return end_[column] - first_[column]; }
  bool are_alike(Index one, Index other) const {
    const auto place = [&](Index n) { return blocks_.begin() + n; };
    return std::equal(place(first_[one]), place(end_[one]), place(first_[other]), place(end_[other]));
  }

  IndexedVector<Index> first_;   ///< place of a column's first block
  IndexedVector<Index> end_;     ///< behind its last one
  IndexedVector<Index> blocks_;  ///< those of one column after those of the other
};

void CoupledBlocks::insert_into(SparseMatrixProfile& profile) {
  add_sums(profile);
  const BlocksOfColumns blocks_of(columns_, lists_, blocks_);
  const IndexedVector<Columns> columns = blocks_of.alike();
  Lists<Interval> rows_of_block;
  in_order_with(
      std::vector<int>(), RowIntervals(), blocks_.count(),
      [&](Index block, RowIntervals& rows, std::vector<int>& sorted) {
        set_intervals(lists_[blocks_[block].rows], sorted, rows);
      },
      [&](Index /*block*/, const RowIntervals& rows) { rows_of_block.add(rows); });
  const auto column_of_profile = [&](Index column) -> SparseMatrixProfile::ColumnProfile& {
    return profile.Column(indexing::as_int(column));
  };
  const auto unite_with_present = [&](Index n, Lists<Interval>& all, ColumnMemory& own) {
    own.rows.clear();
    blocks_of.for_each(columns[n].first, [&](Index block) {
      own.rows.insert(own.rows.end(), rows_of_block[block].begin(), rows_of_block[block].end());
    });
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
