/// Conditions that a factorised matrix does not have.
///
/// Each borders the matrix K by a column of C, a column of R and an entry of the diagonal D:
///
///     | K    C | | x |   | b |
///     | R^T  D | | z | = | d |
///
/// Its x solves K x = b - C z, with (R^T K^-1 C - D) z = R^T K^-1 b - d. It costs a back substitution for each
/// condition once, and one for each right-hand side.
#pragma once

#include "solve.h"

#include <Eigen/Core>

#include <map>
#include <optional>
#include <vector>

namespace newton {

/// One row and column of a border. Entries of the same equation add up.
struct Condition {
  struct Entry {
    int equation;
    double value;
  };
  int key = 0;  ///< the same key, the same column
  std::vector<Entry> column;
  std::vector<Entry> row;
  double diagonal = 0;
  double value = 0;  ///< d
};

/// Product of a row or a column of a condition with a vector over the same equations.
double product(const std::vector<Condition::Entry>& entries, const std::vector<double>& values);

/// The solution of a matrix with conditions.
struct Answer {
  std::vector<double> x;
  std::map<int, double> z;  ///< by the keys of the conditions
};

/// An unknown of K that is given, as if its row and column had been taken out: its key is its equation.
Condition given_unknown(int equation, double value);

class Border {
 public:
  /// Drops the data of the last matrix after a new factorisation.
  void forget() { *this = {}; }
  /// Whether any conditions have been held with it.
  bool has_held() const { return has_held_; }
  /// Subtracts C z from a right-hand side b, so that the solution meets these conditions, given K^-1 b. Returns false,
  /// without a change, if the matrix with them is singular.
  bool hold(const Solve& solve, const std::vector<Condition>& conditions, const std::vector<double>& free,
            std::vector<double>& right);
  /// The solution x with these conditions; the one without them where the matrix with them is singular.
  std::vector<double> solution(const Solve& solve, const std::vector<Condition>& conditions,
                               const std::vector<double>& right);
  /// The solution with these conditions, given K^-1 b; none where the matrix with them is singular.
  std::optional<Answer> answer(const Solve& solve, const std::vector<Condition>& conditions, std::vector<double> free);

 private:
  /// The z of these conditions, given K^-1 b; empty if the matrix with them is singular.
  Eigen::VectorXd unknowns(const Solve& solve, const std::vector<Condition>& conditions,
                           const std::vector<double>& free);
  /// K^-1 C of a condition.
  const std::vector<double>& column(const Solve& solve, const Condition& condition, std::size_t size);

  std::map<int, std::vector<double>> columns_;
  bool has_held_ = false;
};

}  // namespace newton
