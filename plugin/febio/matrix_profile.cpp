#include "matrix_profile.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

using namespace mixture_contact;

namespace {

using Interval = SparseMatrixProfile::RowEntry;

bool is_before(const Interval& one, const Interval& two) { return one.start < two.start; }

RowIntervals intervals_of(SparseMatrixProfile::ColumnProfile& column) {
  RowIntervals intervals;
  for (int i = 0; i < column.size(); ++i) intervals.push_back(column[i]);
  return intervals;
}

/// The same rows, those that follow each other in one interval, given intervals in the order of their starts.
RowIntervals joined(const RowIntervals& ascending) {
  RowIntervals result;
  for (const Interval& next : ascending) {
    if (result.empty() || next.start > result.back().end + 1) {
      result.push_back(next);
    } else {
      result.back().end = std::max(result.back().end, next.end);
    }
  }
  return result;
}

/// The union of two ascending lists.
RowIntervals merged(const RowIntervals& one, const RowIntervals& two) {
  RowIntervals both(one.size() + two.size());
  std::merge(one.begin(), one.end(), two.begin(), two.end(), both.begin(), is_before);
  return joined(both);
}

}  // namespace

RowIntervals united(RowIntervals intervals) {
  std::sort(intervals.begin(), intervals.end(), is_before);
  return joined(intervals);
}

RowIntervals CoupledBlocks::in_matrix(const std::vector<int>& equations) const {
  RowIntervals rows;
  for (const int equation : equations) {
    if (equation < 0) continue;
    if (equation >= blocks_of_.count())
      throw std::out_of_range("equation " + std::to_string(equation) + " of " + std::to_string(blocks_of_.count()));
    rows.push_back({equation, equation});
  }
  return united(std::move(rows));
}

void CoupledBlocks::add(const RowIntervals& columns, RowIntervals rows) {
  for (const Interval& interval : columns) {
    for (int column = interval.start; column <= interval.end; ++column) blocks_of_[column].push_back(blocks_.count());
  }
  blocks_.push_back(std::move(rows));
}

void CoupledBlocks::add(const std::vector<int>& equations) {
  const RowIntervals all = in_matrix(equations);
  add(all, all);
}

void CoupledBlocks::add_star(int centre, const std::vector<int>& equations) {
  const RowIntervals own = in_matrix({centre});
  RowIntervals others = in_matrix(equations);
  add(others, own);
  others.insert(others.end(), own.begin(), own.end());
  add(own, united(std::move(others)));
}

void CoupledBlocks::insert_into(SparseMatrixProfile& profile) const {
  RowIntervals rows;
  for (Index column = 0; column < blocks_of_.count(); ++column) {
    const std::vector<Index>& blocks = blocks_of_[column];
    if (blocks.empty()) continue;
    if (column == 0 || blocks != blocks_of_[column - 1]) {  // columns of one node mostly stand in the same blocks
      rows.clear();
      for (const Index block : blocks) rows.insert(rows.end(), blocks_[block].begin(), blocks_[block].end());
      rows = united(std::move(rows));
    }
    SparseMatrixProfile::ColumnProfile& present = profile.Column(static_cast<int>(column));
    const RowIntervals all = merged(intervals_of(present), rows);
    present.clear();
    for (const Interval& interval : all) present.push_back(interval.start, interval.end);
  }
}
