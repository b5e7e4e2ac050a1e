/// Tests that blocks are inserted into the profile of FEBio's matrix as by FEBio's own insertion.
#include "solver/febio/matrix_profile.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

using newton::CoupledBlocks;
using newton::RowIntervals;
using newton::unite;

namespace {

constexpr int equations = 60;

SparseMatrixProfile diagonal() {
  SparseMatrixProfile profile(equations, equations);
  profile.CreateDiagonal();
  return profile;
}

/// The equations of some nodes, three each, in random order; every fourth is missing.
std::vector<int> random_block(std::mt19937& random) {
  std::uniform_int_distribution<int> node(0, equations / 3 - 1);
  std::vector<int> block;
  for (int n = 0; n < 5; ++n) {
    const int first = 3 * node(random);
    for (const int equation : {first, first + 1, first + 2}) block.push_back(block.size() % 4 == 3 ? -1 : equation);
  }
  std::shuffle(block.begin(), block.end(), random);
  return block;
}

void check_equal(SparseMatrixProfile& ours, SparseMatrixProfile& theirs) {
  for (int column = 0; column < equations; ++column) {
    BOOST_TEST_REQUIRE(ours.Column(column).size() == theirs.Column(column).size());
    for (int i = 0; i < ours.Column(column).size(); ++i) {
      BOOST_TEST(ours.Column(column)[i].start == theirs.Column(column)[i].start);
      BOOST_TEST(ours.Column(column)[i].end == theirs.Column(column)[i].end);
    }
  }
}

void check_as_febio(std::vector<std::vector<int>> present, std::vector<std::vector<int>> blocks) {
  SparseMatrixProfile ours = diagonal();
  ours.UpdateProfile(present, static_cast<int>(present.size()));
  SparseMatrixProfile theirs = ours;
  CoupledBlocks coupled(equations);
  for (const std::vector<int>& block : blocks) coupled.add(block);
  coupled.insert_into(ours);
  theirs.UpdateProfile(blocks, static_cast<int>(blocks.size()));
  check_equal(ours, theirs);
}

}  // namespace

BOOST_AUTO_TEST_CASE(intervals_are_united) {
  RowIntervals result{{7, 8}, {0, 1}, {2, 2}, {10, 14}, {11, 12}};
  unite(result);
  const std::vector<std::pair<int, int>> expected{{0, 2}, {7, 8}, {10, 14}};
  BOOST_TEST_REQUIRE(result.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    BOOST_TEST(result[i].start == expected[i].first);
    BOOST_TEST(result[i].end == expected[i].second);
  }
  RowIntervals none;
  unite(none);
  BOOST_TEST(none.empty());
}

BOOST_AUTO_TEST_CASE(the_profile_is_the_one_that_febio_makes) {
  std::mt19937 random(1);
  for (int run = 0; run < 20; ++run) {
    std::vector<std::vector<int>> present;
    std::vector<std::vector<int>> blocks;
    for (int i = 0; i < 4; ++i) present.push_back(random_block(random));
    for (int i = 0; i < run; ++i) blocks.push_back(random_block(random));
    check_as_febio(present, blocks);
  }
}

BOOST_AUTO_TEST_CASE(a_star_couples_its_centre_with_each_of_the_others) {
  std::mt19937 random(2);
  std::uniform_int_distribution<int> any(0, equations - 1);
  for (int run = 0; run < 20; ++run) {
    SparseMatrixProfile ours = diagonal();
    SparseMatrixProfile theirs = ours;
    CoupledBlocks coupled(equations);
    for (int star = 0; star < run; ++star) {
      const int centre = any(random);
      const std::vector<int> others = random_block(random);
      coupled.add_star(centre, others);
      for (const int other : others) {
        std::vector<std::vector<int>> pair{{centre, other}};
        theirs.UpdateProfile(pair, 1);
      }
    }
    coupled.insert_into(ours);
    check_equal(ours, theirs);
  }
}

BOOST_AUTO_TEST_CASE(rows_have_entries_in_columns_and_not_the_other_way_round) {
  SparseMatrixProfile profile = diagonal();
  CoupledBlocks coupled(equations);
  coupled.add_rows({4, -1, 3}, {9, 3, -1, 20});
  coupled.insert_into(profile);
  SparseMatrixProfile expected = diagonal();
  for (const int column : {3, 9, 20}) expected.Column(column).insertRow(3);
  for (const int column : {3, 9, 20}) expected.Column(column).insertRow(4);
  check_equal(profile, expected);
}

BOOST_AUTO_TEST_CASE(equations_that_are_left_out_and_blocks_without_any) {
  check_as_febio({}, {{}, {-1, -1}, {0, -1, equations - 1}});
}

BOOST_AUTO_TEST_CASE(equations_that_stand_in_a_block_more_than_once) {
  check_as_febio({}, {{7, 3, 7, 4, 3}, {3, 9, 3}});
}

BOOST_AUTO_TEST_CASE(an_equation_beyond_the_matrix_is_an_error) {
  CoupledBlocks blocks(equations);
  BOOST_CHECK_THROW(blocks.add({0, equations}), std::out_of_range);
}

BOOST_AUTO_TEST_CASE(a_sum_of_rows_has_the_columns_of_each) {
  std::vector<std::vector<int>> present{{3, 4, 10}};
  SparseMatrixProfile profile = diagonal();
  profile.UpdateProfile(present, 1);
  CoupledBlocks coupled(equations);
  coupled.add({4, 20, 21});
  coupled.add_rows({3}, {30});
  coupled.add_rows({40}, {3});
  coupled.add_sum(50, {3, 4, -1});
  coupled.insert_into(profile);
  const auto has = [&](int row, int column) {
    SparseMatrixProfile::ColumnProfile& rows = profile.Column(column);
    for (int i = 0; i < rows.size(); ++i) {
      if (rows[i].start <= row && row <= rows[i].end) return true;
    }
    return false;
  };
  for (int column = 0; column < equations; ++column)
    BOOST_TEST(has(50, column) == (column == 50 || has(3, column) || has(4, column)));
  BOOST_TEST(has(50, 30));
  BOOST_TEST(has(50, 21));
  BOOST_TEST(has(50, 10));
  BOOST_TEST(!has(30, 50));
}
