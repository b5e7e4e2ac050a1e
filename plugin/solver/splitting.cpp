#include "splitting.h"

#include "indexing/entries.h"

#include <algorithm>
#include <cmath>
#include <functional>

using indexing::at;

namespace newton {
namespace {

/// Each iteration has to reduce the change at least by this factor.
constexpr double least_reduction = 0.5;

using Eigen::VectorXd;

std::vector<double> difference(const std::vector<double>& one, const std::vector<double>& other) {
  std::vector<double> result(one.size());
  std::transform(one.begin(), one.end(), other.begin(), result.begin(), std::minus<>());
  return result;
}

/// The norm of the entries of x that D multiplies.
double length(const MatrixParts& parts, const std::vector<double>& x) {
  double squares = 0;
  for (const MatrixPart* part : parts) squares += part->squares(x);
  return std::sqrt(squares);
}

std::vector<double> product(const MatrixParts& parts, const std::vector<double>& x) {
  std::vector<double> sum(x.size());
  for (const MatrixPart* part : parts) part->add_product(x, sum);
  return sum;
}

/// The largest dimension of a Krylov space. Each dimension takes one back substitution. The size is a choice: a
/// factorisation takes as long as some ten to fifty of them.
constexpr int most_dimensions = 30;

/// A vector and its product with the matrix 1 + K^-1 D.
struct Direction {
  VectorXd vector;
  VectorXd image;

  void subtract(double factor, const Direction& other) {
    vector -= factor * other.vector;
    image -= factor * other.image;
  }
};

/// The solution of (1 + K^-1 D) x = K^-1 b of least residual in the Krylov space of K^-1 b, with orthogonal images
/// (Young and Jea 1980, Linear Algebra Appl 34:159-194, ORTHODIR). It converges for any regular K + D. `first`: K^-1 b.
/// The residual is at most `tolerance` times x, unless the space has most_dimensions.
std::vector<double> least_residual(const Solve& solve, const MatrixParts& parts, const std::vector<double>& first,
                                   double tolerance) {
  const auto image_of = [&](const VectorXd& x) -> VectorXd {
    return x + as_vector(solve(product(parts, {x.begin(), x.end()})));
  };
  VectorXd residual = as_vector(first);
  VectorXd x = VectorXd::Zero(residual.size());
  std::vector<Direction> known;
  VectorXd next = residual;
  for (int dimension = 0; dimension < most_dimensions; ++dimension) {
    Direction direction{next, image_of(next)};
    for (const Direction& each : known) direction.subtract(each.image.dot(direction.image), each);
    const double size = direction.image.norm();
    if (!(size > 0) || !std::isfinite(size)) break;
    direction.vector /= size;
    direction.image /= size;
    const double share = direction.image.dot(residual);
    x += share * direction.vector;
    residual -= share * direction.image;
    if (residual.norm() <= tolerance * x.norm()) break;
    next = direction.image;
    known.push_back(std::move(direction));
  }
  return {x.begin(), x.end()};
}

}  // namespace

void MatrixPart::add_product(const std::vector<double>& x, std::vector<double>& sum) const {
  for (const MatrixBlock& block : blocks_) {
    for (Eigen::Index i = 0; i < block.values.rows(); ++i) {
      const int row = at(block.rows, i);
      if (row < 0) continue;
      double entry = 0;
      for (Eigen::Index j = 0; j < block.values.cols(); ++j) {
        const int column = at(block.columns, j);
        if (column >= 0) entry += block.values(i, j) * at(x, column);
      }
      at(sum, row) += entry;
    }
  }
}

bool are_empty(const MatrixParts& parts) {
  return std::all_of(parts.begin(), parts.end(), [](const MatrixPart* part) { return part->empty(); });
}

double MatrixPart::squares(const std::vector<double>& x) const {
  double sum = 0;
  for (const MatrixBlock& block : blocks_) {
    for (const int column : block.columns) {
      if (column >= 0) sum += at(x, column) * at(x, column);
    }
  }
  return sum;
}

Split split(const Solve& solve, const MatrixParts& parts, const std::vector<double>& right, double tolerance,
            const SeenSweeps& seen) {
  if (are_empty(parts)) return {};
  const std::vector<double> first = solve(right);
  std::vector<double> x = first;
  double change = length(parts, x);
  if (!std::isfinite(change)) return {};  // the parts cannot be judged; the host detects the failure itself
  if (seen.are_enough()) return {product(parts, x), true, std::move(x), change, seen.reduction};
  while (true) {
    std::vector<double> made = product(parts, x);
    std::vector<double> next = solve(difference(right, made));
    const double next_change = length(parts, difference(next, x));
    if (!std::isfinite(next_change)) return {};
    if (next_change == 0) return {std::move(made), true, std::move(next)};
    const double reduction = next_change / change;
    if (reduction > least_reduction) return {product(parts, least_residual(solve, parts, first, tolerance)), false, {}};
    x = std::move(next);
    change = next_change;
    // The iteration by the caller reduces the error once more.
    if (change * reduction <= tolerance * length(parts, x))
      return {product(parts, x), true, std::move(x), change, reduction};
  }
}

Split split_near(const Split& last, std::vector<double> x, const Solve& solve, const MatrixParts& parts,
                 const std::vector<double>& right, double tolerance) {
  if (are_empty(parts)) return {};
  if (last.x.empty()) return split(solve, parts, right, tolerance);
  // The last solution was computed with the product of the x before it; another iteration would change it by this
  // amount.
  const double change = last.change + length(parts, difference(x, last.x));
  const bool is_near = last.reduction * last.reduction * change <= tolerance * length(parts, x);
  if (!is_near) return split(solve, parts, right, tolerance);
  return {product(parts, x), true, std::move(x), change, last.reduction};
}

double seen_reduction(const Split& split, const MatrixParts& parts, const std::vector<double>& solution) {
  const double seen = length(parts, difference(solution, split.x)) / split.change;
  return std::isfinite(seen) ? seen : unknown_reduction;  // also for 0/0
}

}  // namespace newton
