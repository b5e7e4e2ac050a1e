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

RowIntervals intervals_of(SparseMatrixProfile::ColumnProfile& column) {
  RowIntervals intervals;
  intervals.reserve(indexing::entries(column.size()));
  for (int i = 0; i < column.size(); ++i) intervals.push_back(column[i]);
  return intervals;
}

/// The same rows, those that follow each other in one interval, given intervals in the order of their starts.
RowIntervals joined(RowIntervals ascending) {
  if (ascending.empty()) return ascending;
  auto last = ascending.begin();
  for (auto next = last + 1; next != ascending.end(); ++next) {
    if (next->start > last->end + 1) {
      *++last = *next;
    } else {
      last->end = std::max(last->end, next->end);
    }
  }
  ascending.erase(last + 1, ascending.end());
  return ascending;
}

/// The union of two ascending lists.
RowIntervals merged(const RowIntervals& one, const RowIntervals& two) {
  RowIntervals both(one.size() + two.size());
  std::merge(one.begin(), one.end(), two.begin(), two.end(), both.begin(), is_before);
  return joined(std::move(both));
}

/// The rows of equations in any order.
RowIntervals intervals_of(std::vector<int> equations) {
  std::sort(equations.begin(), equations.end());
  RowIntervals rows;
  rows.reserve(equations.size());
  for (const int equation : equations) {
    if (rows.empty() || equation > rows.back().end + 1) rows.push_back({equation, equation});
    rows.back().end = equation;
  }
  return rows;
}

/// The equations that some have rows for in a profile, each once.
std::vector<int> coupled_with(const std::vector<int>& equations, SparseMatrixProfile& profile) {
  RowIntervals all;
  for (const int equation : equations) {
    const RowIntervals own = intervals_of(profile.Column(equation));
    all.insert(all.end(), own.begin(), own.end());
  }
  std::vector<int> found;
  for (const Interval& interval : united(std::move(all))) {
    for (int row = interval.start; row <= interval.end; ++row) found.push_back(row);
  }
  return found;
}

}  // namespace

RowIntervals united(RowIntervals intervals) {
  std::sort(intervals.begin(), intervals.end(), is_before);
  return joined(std::move(intervals));
}

std::vector<int> CoupledBlocks::in_matrix(const std::vector<int>& equations) const {
  std::vector<int> found;
  found.reserve(equations.size());
  for (const int equation : equations) {
    if (equation < 0) continue;
    if (equation >= columns_)
      throw std::out_of_range("equation " + std::to_string(equation) + " of " + std::to_string(columns_));
    found.push_back(equation);
  }
  return found;
}

void CoupledBlocks::add(const std::vector<int>& equations) {
  const std::vector<int> all = in_matrix(equations);
  blocks_.push_back({all, all});
}

void CoupledBlocks::add_star(int centre, const std::vector<int>& equations) {
  const std::vector<int> own = in_matrix({centre});
  std::vector<int> others = in_matrix(equations);
  blocks_.push_back({others, own});
  others.push_back(centre);
  blocks_.push_back({own, std::move(others)});
}

void CoupledBlocks::add_rows(const std::vector<int>& rows, const std::vector<int>& columns) {
  blocks_.push_back({in_matrix(columns), in_matrix(rows)});
}

void CoupledBlocks::add_sum(int row, const std::vector<int>& others) { others_of_[row] = in_matrix(others); }

void CoupledBlocks::add_sums(SparseMatrixProfile& profile) {
  if (others_of_.empty()) return;
  IndexedVector<std::vector<int>> sums_of(columns_);  // per row
  for (const auto& [row, others] : others_of_) {
    for (const int other : others) sums_of[other].push_back(row);
  }
  for (Block& block : blocks_) {
    std::vector<int> more;
    for (const int row : block.rows) more.insert(more.end(), sums_of[row].begin(), sums_of[row].end());
    block.rows.insert(block.rows.end(), more.begin(), more.end());
  }
  for (const auto& [row, others] : others_of_) add_rows({row}, coupled_with(others, profile));
}

/// The blocks that each column stands in.
class CoupledBlocks::BlocksOfColumns {
 public:
  BlocksOfColumns(int columns, const IndexedVector<Block>& blocks) : first_(columns, 0) {
    IndexedVector<Index> most(columns, 0);  // a block that has a column twice counts twice
    for (const Block& block : blocks) {
      for (const int column : block.columns) ++most[column];
    }
    blocks_.resize(indexing::entries(std::accumulate(most.begin(), most.end(), Index{0})));
    std::exclusive_scan(most.begin(), most.end(), first_.begin(), Index{0});
    end_ = first_;
    for (Index block = 0; block < blocks.count(); ++block) {
      for (const int column : blocks[block].columns) add(column, block);
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
  const BlocksOfColumns blocks_of(columns_, blocks_);
  const IndexedVector<Columns> columns = blocks_of.alike();
  IndexedVector<RowIntervals> rows_of_block(blocks_.count());
  in_parallel(blocks_.count(), [&](Index block) { rows_of_block[block] = intervals_of(blocks_[block].rows); });
  const auto rows_of = [&](Index column) {
    RowIntervals rows;
    blocks_of.for_each(column, [&](Index block) {
      rows.insert(rows.end(), rows_of_block[block].begin(), rows_of_block[block].end());
    });
    return united(std::move(rows));
  };
  const auto column_of_profile = [&](Index column) -> SparseMatrixProfile::ColumnProfile& {
    return profile.Column(indexing::as_int(column));
  };
  const auto united_with_present = [&](Index n) {
    const RowIntervals rows = rows_of(columns[n].first);
    IndexedVector<RowIntervals> all;
    for (Index column = columns[n].first; column < columns[n].end; ++column)
      all.push_back(merged(intervals_of(column_of_profile(column)), rows));
    return all;
  };
  in_order(columns.count(), united_with_present, [&](Index n, const IndexedVector<RowIntervals>& all) {
    for (Index i = 0; i < all.count(); ++i) {
      SparseMatrixProfile::ColumnProfile& present = column_of_profile(columns[n].first + i);
      present.clear();
      for (const Interval& interval : all[i]) present.push_back(interval.start, interval.end);
    }
  });
}
