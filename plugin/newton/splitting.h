/// A matrix of which a part stands beside it and is not factorised.
///
/// With A = K + D and the factors of K alone, A x = b is solved by the iteration K x' = b - D x of the splitting (Varga
/// 2000, Matrix Iterative Analysis, chapter 3). Each sweep costs a back substitution. It converges where the spectral
/// radius of K^-1 D is less than 1: where D is small beside K.
#pragma once

#include <Eigen/Core>

#include <functional>
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

/// Solves (K + D) x = b, one right-hand side after the other. What sweeps have reduced before tells how many of them
/// the next one needs.
class Splitting {
 public:
  /// K^-1 times a right-hand side.
  using Solve = std::function<std::vector<double>(const std::vector<double>& right)>;

  /// `tolerance`: how far what D multiplies of x may be off, as a part of it.
  explicit Splitting(double tolerance) : tolerance_(tolerance) {}

  /// All sweeps but the last, which is left to the caller: K x' = b - D x. Returns D x, empty for zero; where sweeps do
  /// not converge it is that before the first one that made the change larger, if there is one. Keeps the parts until
  /// swept().
  std::vector<double> product(const Solve& solve, MatrixParts parts, const std::vector<double>& right);
  /// The last sweep has come to this x'.
  void swept(const std::vector<double>& x);
  /// Whether each sweep for the present right-hand side halved the change, at least.
  bool converges() const { return converges_; }

  /// The change by the last sweep that was seen, as a part of the change before; 1 if none was.
  double reduction() const { return reduction_; }
  void set_reduction(double reduction) { reduction_ = reduction; }

 private:
  /// Whether another sweep leaves what is within the tolerance.
  bool is_last_sweep() const;

  double tolerance_;
  double reduction_ = 1;
  bool converges_ = true;
  MatrixParts parts_;      ///< empty where no sweep is left
  std::vector<double> x_;  ///< of the last sweep
  double change_ = 0;      ///< by it
};

}  // namespace newton
