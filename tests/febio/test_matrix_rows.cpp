/// Tests that blocks are added to FEBio's matrix as by FEBio's own assembly, for any number of threads.
#include "solver/febio/matrix_rows.h"

#include "contact/base/parallel.h"

#include <FECore/CompactSymmMatrix.h>
#include <FECore/CompactUnSymmMatrix.h>
#include <FECore/FEGlobalMatrix.h>
#include <FECore/MatrixProfile.h>

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <limits>
#include <numeric>
#include <optional>
#include <random>
#include <utility>

#ifdef _OPENMP
#include <omp.h>
#endif

using namespace mixture_contact;
using namespace newton;

namespace {

constexpr int equations = 200;  // enough for rows on several threads
constexpr int left_out = -1;

void use_threads([[maybe_unused]] int threads) {
#ifdef _OPENMP
  omp_set_num_threads(threads);
  BOOST_TEST_REQUIRE(thread_count() == threads);
#endif
}

/// Some equations in random order, and some that are missing.
std::vector<int> random_equations(std::mt19937& random) {
  std::vector<int> all(equations);
  std::iota(all.begin(), all.end(), 0);
  std::shuffle(all.begin(), all.end(), random);
  all.resize(30);
  all[2] = left_out;
  all[7] = left_out;
  return all;
}

/// Makes a matrix whose profile contains the couplings within each list of equations.
void form(CRSSparseMatrix& matrix, const std::vector<std::vector<int>>& lists) {
  SparseMatrixProfile profile(equations, equations);
  profile.CreateDiagonal();
  std::vector<std::vector<int>> couplings = lists;
  profile.UpdateProfile(couplings, static_cast<int>(couplings.size()));
  matrix.Create(profile);
  matrix.Zero();
}

/// Equations of two nodes that are coupled with all others, and a load that depends on the second node and others.
const std::vector<int> nodes_and_load{0, 1, 2, 3, 4, 5, 9};
constexpr int load = 9;
const std::vector<int> node{3, 4, 5};
constexpr int lacking = 6;  ///< coupled with the first node only

MatrixXd entries_of(CRSSparseMatrix& matrix, int count) {
  return MatrixXd::NullaryExpr(count, count,
                               [&](Index i, Index j) { return matrix.get(static_cast<int>(i), static_cast<int>(j)); });
}

/// Sets the entries that the profile contains.
void fill(CRSSparseMatrix& matrix, const MatrixXd& values) {
  for (int i = 0; i < values.rows(); ++i) {
    for (int j = 0; j < values.cols(); ++j) {
      if (matrix.check(i, j)) matrix.set(i, j, values(i, j));
    }
  }
}

constexpr int part = 10;  ///< number of equations in these tests

}  // namespace

BOOST_AUTO_TEST_CASE(blocks_are_where_febio_puts_them) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<std::vector<int>> lists;
  for (int i = 0; i < 12; ++i) lists.push_back(random_equations(random));
  for (const auto& [offset, threads] : {std::pair(0, 1), std::pair(1, 2), std::pair(1, 3)}) {
    use_threads(threads);
    auto* ours = new CRSSparseMatrix(offset);  // the global matrix deletes it
    CRSSparseMatrix theirs(offset);
    form(*ours, lists);
    form(theirs, lists);
    FEGlobalMatrix global(ours);
    const MatrixRows rows(global);
    BOOST_TEST(static_cast<bool>(rows));
    IndexedVector<MatrixBlock> blocks;
    for (const std::vector<int>& list : lists) {
      const std::vector<int> columns(list.rbegin(), list.rend() - 3);
      const MatrixXd block = MatrixXd::NullaryExpr(static_cast<Index>(list.size()), static_cast<Index>(columns.size()),
                                                   [&] { return number(random); });
      blocks.push_back({list, columns, block});
      matrix negative(static_cast<int>(block.rows()), static_cast<int>(block.cols()));
      for (int i = 0; i < negative.rows(); ++i) {
        for (int j = 0; j < negative.columns(); ++j) negative[i][j] = -block(i, j);
      }
      theirs.Assemble(negative, list, columns);
    }
    rows.subtract(blocks);
    BOOST_TEST(theirs.infNorm() > 0);
    for (int i = 0; i < equations; ++i) {
      for (int j = 0; j < equations; ++j) BOOST_TEST(ours->get(i, j) == theirs.get(i, j));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_symmetric_matrix_is_left_to_febio) {
  FEGlobalMatrix global(new CompactSymmMatrix(1));
  BOOST_TEST(!MatrixRows(global));
}

BOOST_AUTO_TEST_CASE(unknowns_are_eliminated_from_a_row_by_their_own) {
  for (const int offset : {0, 1}) {
    auto* matrix = new CRSSparseMatrix(offset);  // the global matrix deletes it
    form(*matrix, {nodes_and_load, {0, 1, 2, lacking}});
    fill(*matrix, MatrixXd::Random(part, part) + 3 * MatrixXd::Identity(part, part));
    FEGlobalMatrix global(matrix);
    const MatrixXd before = entries_of(*matrix, part);
    const std::optional<newton::RowOperation> operation = MatrixRows(global).eliminate(node, load);
    BOOST_TEST_REQUIRE(operation.has_value());
    BOOST_TEST(operation->row == load);
    MatrixXd expected = before;
    for (const newton::RowOperation::Term& term : operation->terms)
      expected.row(load) += term.factor * before.row(term.row);
    const MatrixXd after = entries_of(*matrix, part);
    // Each entry is a sum of four products.
    const double bound = 4 * std::numeric_limits<double>::epsilon() * before.cwiseAbs().maxCoeff() *
                         (1 + before.middleRows<3>(3).cwiseAbs().colwise().sum().maxCoeff());
    BOOST_TEST((after - expected).cwiseAbs().maxCoeff() < bound);
    // The factors come from the elimination of three equations with pivoting, whose error is several times larger.
    BOOST_TEST(after.row(load).segment<3>(3).cwiseAbs().maxCoeff() < 10 * bound);
    BOOST_TEST(before.row(load).segment<3>(3).cwiseAbs().minCoeff() > 10 * bound);
  }
}

BOOST_AUTO_TEST_CASE(what_a_row_has_taken_is_taken_back) {
  auto* matrix = new CRSSparseMatrix(1);  // the global matrix deletes it
  form(*matrix, {nodes_and_load, {0, 1, 2, lacking}});
  fill(*matrix, MatrixXd::Random(part, part) + 3 * MatrixXd::Identity(part, part));
  FEGlobalMatrix global(matrix);
  const MatrixRows rows(global);
  const MatrixXd before = entries_of(*matrix, part);
  const std::optional<newton::RowOperation> operation = rows.eliminate(node, load);
  BOOST_TEST_REQUIRE(operation.has_value());
  BOOST_TEST((entries_of(*matrix, part) != before));
  rows.undo(*operation);
  // Three products are added and three subtracted.
  const double bound = 6 * std::numeric_limits<double>::epsilon() * before.cwiseAbs().maxCoeff() *
                       (1 + before.middleRows<3>(3).cwiseAbs().colwise().sum().maxCoeff());
  BOOST_TEST((entries_of(*matrix, part) - before).cwiseAbs().maxCoeff() < bound);
}

BOOST_AUTO_TEST_CASE(the_backward_error_is_that_of_the_worst_row) {
  auto* matrix = new CRSSparseMatrix(1);  // the global matrix deletes it
  form(*matrix, {{0, 1, 2}});
  fill(*matrix, 2 * MatrixXd::Identity(3, 3));
  matrix->set(1, 2, -1e6);
  FEGlobalMatrix global(matrix);
  const MatrixRows rows(global);
  std::vector<double> solution(equations);
  std::vector<double> right(equations);
  solution[1] = 5e5;
  solution[2] = 1;
  right[2] = 2;
  BOOST_TEST(rows.backward_error(solution, right) == 0);
  solution[1] *= 1 + 1e-3;  // the error in 2 x1 - 1e6 x2 = 0 is 1e3, relative to products of 2e6
  BOOST_TEST(rows.backward_error(solution, right) == 1e3 / (2e6 + 1e3), boost::test_tools::tolerance(1e-12));
  for (const int unanswered : {0, equations - 1}) {
    std::vector<double> further = right;
    indexing::at(further, unanswered) = 1e-30;
    BOOST_TEST(rows.backward_error(solution, further) == 1);
  }
}

BOOST_AUTO_TEST_CASE(a_row_that_cannot_take_others_is_as_it_was) {
  auto* matrix = new CRSSparseMatrix(1);  // the global matrix deletes it
  form(*matrix, {nodes_and_load, {0, 1, 2, lacking}});
  MatrixXd values = MatrixXd::Random(part, part);
  values.row(4) = 2 * values.row(3);
  fill(*matrix, values);
  FEGlobalMatrix global(matrix);
  const MatrixXd before = entries_of(*matrix, part);
  const MatrixRows rows(global);
  BOOST_TEST(!rows.eliminate({0, 1, 2}, load).has_value());  // the row has no entries in their columns
  BOOST_TEST(!rows.eliminate(node, load).has_value());       // two of their rows are equal
  BOOST_TEST(!rows.eliminate({}, load).has_value());
  BOOST_TEST((entries_of(*matrix, part) == before));
  matrix->set(4, 4, 1);
  matrix->set(load, load, 1e-6 * before(load, load));
  const MatrixXd small = entries_of(*matrix, part);
  BOOST_TEST(!rows.eliminate(node, load).has_value());  // its diagonal would be lost
  BOOST_TEST((entries_of(*matrix, part) == small));
  matrix->set(load, load, before(load, load));
  BOOST_TEST(rows.eliminate(node, load).has_value());
}
