/// A matrix of which a part stands beside it and is not factorised.
///
/// With A = K + D and the factors of K alone, A x = b is solved by the iteration K x' = b - D x of the splitting (Varga
/// 2000, Matrix Iterative Analysis, chapter 3). Each sweep costs a back substitution. It converges where the spectral
/// radius of K^-1 D is less than 1: where D is small beside K.
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
  /// Adds the squares of what D multiplies of x to a sum, once for each block that has it.
  double squares(const std::vector<double>& x) const;

 private:
  std::vector<MatrixBlock> blocks_;
};

/// The parts of several contacts, of which D is the sum.
using MatrixParts = std::vector<const MatrixPart*>;

/// Whether there is nothing in any of them.
bool are_empty(const MatrixParts& parts);

/// What splitting comes to for one right-hand side.
struct Split {
  std::vector<double> product;  ///< D x: with b - D x for b, K has the solution of K + D; empty for zero
  bool converges = true;        ///< whether each sweep halved the change, at least
  std::vector<double> x;        ///< that of the product; empty where there is nothing to multiply
  double change = 0;            ///< what D multiplies of the change of x by the sweep that made it
  double reduction = 0;         ///< of such a change, by another sweep
};

/// Split::reduction of an iteration of which nothing is known.
inline constexpr double unknown_reduction = 1;

/// What other right-hand sides have shown of sweeps.
struct SeenSweeps {
  double reduction = unknown_reduction;
  double tolerance = 0;  ///< of x, for a split that rests on this

  /// Whether the sweep that is left to the caller is, with the first product D x.
  bool are_enough() const { return reduction * reduction <= tolerance; }
};

/// Solves (K + D) x = b but for its last sweep, which is left to the caller: K x' = b - D x. What D multiplies of x' is
/// right to `tolerance`, a part of it, or to that of what has been `seen`; where sweeps do not converge it is as it was
/// before the first that made the change larger, if there is one.
Split split(const Solve& solve, const MatrixParts& parts, const std::vector<double>& right, double tolerance,
            const SeenSweeps& seen = {});

/// Solves (K + D) x = b but for the last iteration, as split() does, given the x that K has for another right-hand
/// side, solved as the x of `last` was. Takes no iteration where that x is near enough to the last one.
Split split_near(const Split& last, std::vector<double> x, const Solve& solve, const MatrixParts& parts,
                 const std::vector<double>& right, double tolerance);

/// What the sweep that was left of a split has left of the change before it, given the solution that it made.
double seen_reduction(const Split& split, const MatrixParts& parts, const std::vector<double>& solution);

}  // namespace newton
