/// A matrix of which a part is deferred and not factorised.
///
/// A x = b, with A = K + D and the factors of K alone, is solved by iterating K x' = b - D x, a splitting (Varga
/// 2000, Matrix Iterative Analysis, chapter 3). Each iteration takes a back substitution. It converges if the spectral
/// radius of K^-1 D is less than 1: D is then small compared with K.
#pragma once

#include "solve.h"

#include <Eigen/Core>

#include <utility>
#include <vector>

namespace newton {

/// A dense block and its place in a matrix. Rows and columns with the equation -1 are left out.
struct MatrixBlock {
  std::vector<int> rows;     ///< equations
  std::vector<int> columns;  ///< equations
  Eigen::MatrixXd values;    ///< shape (rows, columns)
};

/// The part D, in blocks that may overlap.
class MatrixPart {
 public:
  void clear() { blocks_.clear(); }
  void add(MatrixBlock block) { blocks_.push_back(std::move(block)); }
  bool empty() const { return blocks_.empty(); }

  /// Adds D x to a vector.
  void add_product(const std::vector<double>& x, std::vector<double>& sum) const;
  /// Adds the squares of the entries of x that D multiplies to a sum, once for each block that has it.
  double squares(const std::vector<double>& x) const;

 private:
  std::vector<MatrixBlock> blocks_;
};

/// The parts of several contacts, of which D is the sum.
using MatrixParts = std::vector<const MatrixPart*>;

/// Whether all parts are empty.
bool are_empty(const MatrixParts& parts);

/// The result of splitting for one right-hand side.
struct Split {
  std::vector<double> product;  ///< D x: K x' = b - D x gives the solution of K + D; empty for zero
  bool converges = true;        ///< whether each iteration halved the change, at least
  std::vector<double> x;        ///< the x of `product`; empty if D is zero
  double change = 0;            ///< D times the change of x by the iteration that made it
  double reduction = 0;         ///< of such a change, by another iteration
};

/// Split::reduction of an unknown iteration.
inline constexpr double unknown_reduction = 1;

/// The convergence that other right-hand sides have shown.
struct SeenSweeps {
  double reduction = unknown_reduction;
  double tolerance = 0;  ///< of x, for a split that rests on this

  /// Whether the iteration that is left to the caller is, with the first product D x.
  bool are_enough() const { return reduction * reduction <= tolerance; }
};

/// Solves (K + D) x = b except for its last iteration, which is left to the caller: K x' = b - D x. The product D x' is
/// right to `tolerance`, a part of it, or to that of those `seen`; if the iterations do not converge, it is that before
/// the first iteration with a growing change.
Split split(const Solve& solve, const MatrixParts& parts, const std::vector<double>& right, double tolerance,
            const SeenSweeps& seen = {});

/// Solves (K + D) x = b except for the last iteration, as split() does, given the x that K has for another right-hand
/// side, solved as the x of `last` was. Takes no iteration where that x is near enough to the last one.
Split split_near(const Split& last, std::vector<double> x, const Solve& solve, const MatrixParts& parts,
                 const std::vector<double>& right, double tolerance);

/// The reduction of the change by the iteration that was left of a split, given the solution that it made.
double seen_reduction(const Split& split, const MatrixParts& parts, const std::vector<double>& solution);

}  // namespace newton
