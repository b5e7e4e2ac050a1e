/// Solution of a system whose matrix is factorised only in part.
///
/// The system A x = b with A = K + D, of which only K is factorised, is solved by the iteration K x' = b - D x, a
/// matrix splitting (Varga 2000, Matrix Iterative Analysis, chapter 3). Each iteration takes one back substitution. It
/// converges if the spectral radius of K^-1 D is less than 1, that is, if D is small compared with K.
#pragma once

#include "solve.h"

#include <Eigen/Core>

#include <utility>
#include <vector>

namespace newton {

/// A dense block with its position in a matrix. Rows and columns with the equation -1 are ignored.
struct MatrixBlock {
  std::vector<int> rows;     ///< equations of the rows
  std::vector<int> columns;  ///< equations of the columns
  Eigen::MatrixXd values;    ///< shape (rows, columns)
};

/// A part D of a matrix that is not factorised, as the sum of blocks, which may overlap.
class MatrixPart {
 public:
  void clear() { blocks_.clear(); }
  void add(MatrixBlock block) { blocks_.push_back(std::move(block)); }
  bool empty() const { return blocks_.empty(); }

  /// Adds D x to `sum`.
  void add_product(const std::vector<double>& x, std::vector<double>& sum) const;
  /// The sum of the squares of the entries of x that D multiplies, once for each block that contains an entry.
  double squares(const std::vector<double>& x) const;

 private:
  std::vector<MatrixBlock> blocks_;
};

/// The parts of several contacts; D is their sum.
using MatrixParts = std::vector<const MatrixPart*>;

/// True if all parts are empty.
bool are_empty(const MatrixParts& parts);

/// The result of a splitting for one right-hand side.
struct Split {
  std::vector<double> product;  ///< D x, such that K x' = b - D x gives the solution of (K + D) x' = b; empty for zero
  bool converges = true;        ///< true if each iteration reduced the change to less than a half
  std::vector<double> x;        ///< the vector x of `product`; empty if D is zero, or without convergence
  double change = 0;            ///< norm of D times the change of x in the last iteration
  double reduction = 0;         ///< factor by which an iteration reduces this change
};

/// Value of Split::reduction if it is unknown.
inline constexpr double unknown_reduction = 1;

/// The convergence of the iteration for earlier right-hand sides.
struct SeenSweeps {
  double reduction = unknown_reduction;
  double tolerance = 0;  ///< relative error of x up to which a single iteration is accepted

  /// True if a single iteration reaches the tolerance with this reduction. split() then returns D x for its first x.
  bool are_enough() const { return reduction * reduction <= tolerance; }
};

/// Iterates for (K + D) x = b, except for the last iteration K x' = b - D x, which the caller has to perform. The
/// product D x' then has the relative error `tolerance`, or the tolerance of `seen`. If the iteration does not
/// converge, x is the solution of least residual in a Krylov space. `right`: b.
Split split(const Solve& solve, const MatrixParts& parts, const std::vector<double>& right, double tolerance,
            const SeenSweeps& seen = {});

/// Iterates for (K + D) x = b, as split() does, starting from the solution x of K for another right-hand side, which
/// was solved with the product of `last`. It performs no iteration if x is sufficiently near to the last one.
Split split_near(const Split& last, std::vector<double> x, const Solve& solve, const MatrixParts& parts,
                 const std::vector<double>& right, double tolerance);

/// The factor by which the iteration of the caller has reduced the change. `solution`: result of that iteration.
double seen_reduction(const Split& split, const MatrixParts& parts, const std::vector<double>& solution);

}  // namespace newton
