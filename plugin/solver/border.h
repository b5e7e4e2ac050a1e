/// Solutions of a factorised matrix with additional equations and unknowns.
///
/// Each condition borders the matrix K with a column of C, a row of R^T and a diagonal entry of D:
///
///     | K    C | | x |   | b |
///     | R^T  D | | z | = | d |
///
/// The solution x satisfies K x = b - C z, with (R^T K^-1 C - D) z = R^T K^-1 b - d. This takes one back substitution
/// for each condition and each matrix, and one for each right-hand side. Those of the conditions are performed
/// together.
#pragma once

#include "solve.h"

#include <Eigen/Core>

#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace newton {

/// A condition: one row and one column of the border. Entries with the same equation add up.
struct Condition {
  struct Entry {
    int equation;
    double value;
  };
  int key = 0;  ///< identifies the column: conditions with the same key have the same column
  std::vector<Entry> column;
  std::vector<Entry> row;
  double diagonal = 0;
  double value = 0;  ///< right-hand side d
};

/// Product of a row or column of a condition with a vector of one value per equation.
double product(const std::vector<Condition::Entry>& entries, const Eigen::Ref<const Eigen::VectorXd>& values);
double product(const std::vector<Condition::Entry>& entries, const std::vector<double>& values);

/// The solution of a matrix with conditions.
struct Answer {
  std::vector<double> x;
  std::map<int, double> z;  ///< additional unknowns, by the keys of their conditions
};

/// The condition that an unknown of K has a given value, as if its row and column were removed. The key is the
/// equation.
Condition given_unknown(int equation, double value);

/// The border of a factorised matrix. It keeps K^-1 C for conditions that are used again.
class Border {
 public:
  /// Discards the data of the last matrix, after a new factorisation.
  void forget() { *this = {}; }
  /// True if hold() has been used with this matrix.
  bool has_held() const { return has_held_; }
  /// Subtracts C z from the right-hand side b in `right`, such that the solution of K meets these conditions. `free`:
  /// K^-1 b. Returns false without a change if the bordered matrix is singular.
  bool hold(const SolveAll& solve, const std::vector<Condition>& conditions, const std::vector<double>& free,
            std::vector<double>& right);
  /// The solution x with these conditions, or without them if the bordered matrix is singular. `free`: K^-1 b.
  std::vector<double> solution(const SolveAll& solve, const std::vector<Condition>& conditions,
                               std::vector<double> free);
  /// The solution with these conditions; empty if the bordered matrix is singular. `free`: K^-1 b.
  std::optional<Answer> answer(const SolveAll& solve, const std::vector<Condition>& conditions,
                               std::vector<double> free);

 private:
  /// The unknowns z of these conditions; empty if the bordered matrix is singular. `free`: K^-1 b.
  Eigen::VectorXd unknowns(const SolveAll& solve, const std::vector<Condition>& conditions,
                           const std::vector<double>& free);
  /// Solves for the columns of these conditions that are not known yet. `size`: length of a column.
  void add_columns(const SolveAll& solve, const std::vector<Condition>& conditions, Eigen::Index size);

  /// The column K^-1 C of a condition, which is known.
  Eigen::MatrixXd::ConstColXpr column(const Condition& condition) const;

  /// The columns K^-1 C, in the matrices in which they were solved for.
  std::vector<Eigen::MatrixXd> columns_;
  /// The matrix in `columns_` and the position in it, by the key of the condition.
  std::map<int, std::pair<std::size_t, Eigen::Index>> places_;
  bool has_held_ = false;
};

}  // namespace newton
