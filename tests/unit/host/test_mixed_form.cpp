/// Tests that loads in mixed form give the same increments as with their products in the matrix.
#include "host/mixed_form.h"

#include "random_contact.h"

#include <boost/test/unit_test.hpp>

#include <Eigen/LU>
#include <Eigen/SVD>

#include <limits>

using namespace test;

namespace {

constexpr Index size = 9;

/// A load that acts on the first three unknowns and depends on all unknowns.
LoadBlock random_load(std::mt19937& random, double factor) {
  LoadBlock load;
  load.work = random_values(3, -1, 1, random);
  load.variation = random_values(size, -1, 1, random);
  load.factor = factor;
  return load;
}

/// A well-conditioned matrix, with or without the product of a load.
MatrixXd random_matrix(std::mt19937& random) {
  return MatrixXd::Identity(size, size) + 0.1 / size * random_values(size * size, -1, 1, random).reshaped(size, size);
}

MatrixXd with_product(MatrixXd matrix, const LoadBlock& load) {
  matrix.topRows<3>() += load.product().values;
  return matrix;
}

MatrixXd with_mixed_form(const MatrixXd& matrix, const LoadBlock& load) {
  const MixedForm mixed = mixed_form(load);
  MatrixXd larger = MatrixXd::Zero(size + 1, size + 1);
  larger.topLeftCorner<size, size>() = matrix;
  larger.block<3, 1>(0, size) = mixed.column;
  larger.block<1, size>(size, 0) = mixed.row.transpose();
  larger(size, size) = mixed.diagonal;
  return larger;
}

/// Solves like a linear solver that scales columns and chooses pivots.
VectorXd solve(const MatrixXd& matrix, const VectorXd& right_hand_side) {
  const VectorXd scale = matrix.colwise().norm();
  const MatrixXd scaled = matrix * scale.cwiseInverse().asDiagonal();
  return scaled.partialPivLu().solve(right_hand_side).cwiseQuotient(scale);
}

VectorXd with_zero(const VectorXd& values) {
  VectorXd larger(size + 1);
  larger << values, 0;
  return larger;
}

}  // namespace

BOOST_AUTO_TEST_CASE(increments_are_those_of_the_product) {
  std::mt19937 random(1);
  for (const double factor : {1e-3, 1.0, -1.0, 1e3, 1e6}) {
    const LoadBlock load = random_load(random, factor);
    const MatrixXd matrix = random_matrix(random);
    const VectorXd residual = random_values(size, -1, 1, random);
    // The rounding error of the factors is multiplied by the condition number of the matrix.
    const MatrixXd product = with_product(matrix, load);
    const Eigen::VectorXd singular = product.jacobiSvd().singularValues();
    const VectorXd expected = solve(product, residual);
    const VectorXd found = solve(with_mixed_form(matrix, load), with_zero(residual));
    BOOST_TEST((found.head(size) - expected).norm() <= rounding * singular[0] / singular[size - 1] * expected.norm());
  }
}

BOOST_AUTO_TEST_CASE(the_unknown_of_a_load_is_lost_beside_increments) {
  std::mt19937 random(2);
  for (const double factor : {1e-9, 1.0, 1e9}) {
    const LoadBlock load = random_load(random, factor);
    const MixedForm mixed = mixed_form(load);
    const VectorXd change = random_values(size, -1, 1, random);
    const double unknown = -mixed.row.dot(change) / mixed.diagonal;
    BOOST_TEST(change.squaredNorm() + unknown * unknown == change.squaredNorm());
    // The unknown is the change of the load in its own unit.
    const VectorXd work = unknown * mixed.column;
    const VectorXd expected = factor * load.variation.dot(change) * load.work;
    BOOST_TEST((work - expected).norm() <= rounding * expected.norm());
  }
}

BOOST_AUTO_TEST_CASE(a_load_that_depends_on_nothing_has_no_mixed_form) {
  LoadBlock load;
  load.work = VectorXd::Ones(3);
  load.variation = VectorXd::Zero(size);
  load.factor = 1;
  BOOST_TEST(!has_mixed_form(load));
  for (const double value : {1e-30, std::numeric_limits<double>::quiet_NaN()}) {
    load.variation[4] = value;
    BOOST_TEST(has_mixed_form(load));  // NaN has to reach the linear solver, which reports it
  }
}
