/// Solutions of a factorised matrix with additional equations and unknowns.
///
/// Each condition borders the matrix K with a column of C, a row of R^T and a diagonal entry of D:
///
///     | K    C | | x |   | b |
///     | R^T  D | | z | = | d |
///
/// The solution x satisfies K x = b - C z, with (R^T K^-1 C - D) z = R^T K^-1 b - d. This takes one back substitution
/// for each condition and each matrix, and one for each right-hand side. Those of the conditions are performed
/// together. Columns K^-1 C are kept in the equations that rows of conditions can have, because whole columns would
/// take a tenth of the memory of a model.
#pragma once

#include "solve.h"

#include <Eigen/Core>

#include <functional>
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
double product(const std::vector<Condition::Entry>& entries, const std::vector<double>& values);

/// The solution of a matrix with conditions.
struct Answer {
  std::vector<double> x;    ///< solution; with conditions, NaN in equations that the border does not keep
  std::map<int, double> z;  ///< additional unknowns, by the keys of their conditions
};

/// The condition that an unknown of K has a given value, as if its row and column were removed. The key is the
/// equation.
Condition given_unknown(int equation, double value);

/// Lists equations of the present matrix, in any order; -1 and repetitions are ignored.
using ListEquations = std::function<std::vector<int>()>;

/// The border of a factorised matrix. It keeps K^-1 C for conditions that are used again.
class Border {
 public:
  /// `kept`: lists the equations that the rows of conditions can have. It is called once for each matrix that has
  /// conditions.
  explicit Border(ListEquations kept) : list_kept_(std::move(kept)) {}
  /// Discards the data of the last matrix, after a new factorisation.
  void forget() { *this = Border(std::move(list_kept_)); }
  /// True if hold() has been used with this matrix.
  bool has_held() const { return has_held_; }
  /// Subtracts C z from the right-hand side b in `right`, such that the solution of K meets these conditions. `free`:
  /// K^-1 b. Returns false without a change if the bordered matrix is singular, or if a row has an equation that is not
  /// kept.
  bool hold(const SolveAll& solve, const std::vector<Condition>& conditions, const std::vector<double>& free,
            std::vector<double>& right);
  /// The solution with these conditions; empty where hold() would return false. `free`: K^-1 b.
  std::optional<Answer> answer(const SolveAll& solve, const std::vector<Condition>& conditions,
                               const std::vector<double>& free);

 private:
  /// The unknowns z of these conditions; empty where hold() returns false. `free`: K^-1 b.
  Eigen::VectorXd unknowns(const SolveAll& solve, const std::vector<Condition>& conditions,
                           const std::vector<double>& free);
  /// Lists the kept equations, if this matrix has had no conditions. `size`: number of equations.
  void begin(Eigen::Index size);
  /// True if all equations of the conditions' rows are kept.
  bool keeps_rows(const std::vector<Condition>& conditions) const;
  /// Solves for the columns of these conditions that are not known yet. `size`: length of a column.
  void add_columns(const SolveAll& solve, const std::vector<Condition>& conditions, Eigen::Index size);

  /// The column K^-1 C of a condition, which is known, in the kept equations.
  Eigen::MatrixXd::ConstColXpr column(const Condition& condition) const;

  ListEquations list_kept_;
  std::vector<int> kept_;      ///< kept equations, in ascending order
  std::vector<int> position_;  ///< per equation, its position in `kept_`; -1 for equations that are not kept
  /// The columns K^-1 C in the kept equations, in the matrices in which they were solved for.
  std::vector<Eigen::MatrixXd> columns_;
  /// The matrix in `columns_` and the position in it, by the key of the condition.
  std::map<int, std::pair<std::size_t, Eigen::Index>> places_;
  bool has_held_ = false;
};

}  // namespace newton
