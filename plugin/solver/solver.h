/// The Newton solver and its model as helpers use them. FEBio's implementation is in solver/febio; tests have a fake
/// one.
#pragma once

#include "indexing/entries.h"

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace newton {

using indexing::at;
using indexing::entries;
using indexing::number_of;

/// Thrown if an element is inverted in a trial state.
struct InvertedElement : std::runtime_error {
  InvertedElement() : std::runtime_error("an element is inverted") {}
};

/// A nodal value: the number of its node, and its number among the dofs of the node.
struct Place {
  int node = 0;
  int dof = 0;
  bool operator==(const Place& other) const { return node == other.node && dof == other.dof; }
  bool operator<(const Place& other) const { return node != other.node ? node < other.node : dof < other.dof; }
};

/// The code of a prescribed value with equation n, -n-2. The code of a free value is n, and that of a value without an
/// equation is -1. The function is its own inverse.
inline int prescribed(int equation) { return -equation - 2; }

inline bool is_prescribed(int code) { return code < -1; }

/// The equation of a free or prescribed value, from its code; -1 if there is none.
inline int equation_of(int code) { return is_prescribed(code) ? prescribed(code) : code; }

/// The vectors of the solver, with one entry per equation.
struct Vectors {
  std::vector<double>& total;            ///< values at the start of the step
  std::vector<double>& change;           ///< change since the start of the step
  std::vector<double>& increment;        ///< last increment; before the first one, the prescribed increments
  std::vector<double>& residual;         ///< residual at the start of the iteration
  std::vector<double>& prescribed_load;  ///< part of the residual from prescribed increments
};

/// A Newton solver and its model.
class Solver {
 public:
  Solver() = default;
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;
  Solver(Solver&&) = delete;
  Solver& operator=(Solver&&) = delete;
  virtual ~Solver() = default;

  /// True if the present step is solved by Newton's method; otherwise no other function may be called.
  virtual bool is_newton() const = 0;

  // Access to the nodal values of the model.
  virtual int nodes() const = 0;
  /// The dofs of each variable: displacement, pressure, each concentration.
  virtual std::vector<std::vector<int>> variables() const = 0;
  /// Index of the displacements in variables().
  virtual std::size_t displacements() const = 0;
  /// The dofs of the concentrations.
  virtual std::vector<int> concentrations() const = 0;
  /// The code of a nodal value's equation, see prescribed().
  virtual int equation(Place place) const = 0;
  virtual void set_equation(Place place, int code) = 0;
  /// The present nodal value.
  virtual double value(Place place) const = 0;
  virtual void set_value(Place place, double value) = 0;
  /// The nodal value at the end of the last step.
  virtual double previous_value(Place place) const = 0;

  // Access to the solver.
  virtual Vectors vectors() = 0;
  /// Adds an increment to the change of the step, and evaluates the model at the new state. Throws InvertedElement.
  virtual void update(std::vector<double>& increment) = 0;
  /// Evaluates the residual at the present state.
  virtual std::vector<double> evaluate_residual() = 0;
  /// The product of the matrix with a vector.
  virtual std::vector<double> times_matrix(const std::vector<double>& vector) const = 0;
  /// True if set_totals() can set all quantities with which the convergence tests compare increments.
  virtual bool has_known_totals() const = 0;
  /// Sets the total change since the start of the step, per equation.
  virtual void set_totals(const std::vector<double>& change) = 0;
  /// Reactions at prescribed values per equation, from the last residual; null if the solver clamps no concentrations.
  virtual const std::vector<double>* reactions_of_clamp() const = 0;
  /// The settings of the solver's line search; null if it has none.
  struct LineSearch {
    double* tolerance = nullptr;        ///< 0 if the search is disabled [-]
    bool* halves_inversions = nullptr;  ///< true if the search halves increments that invert elements

    bool exists() const { return tolerance != nullptr; }
  };
  virtual LineSearch line_search() = 0;
  /// Squared norms of the residual in the last trial (`now`) and at the start of the step (`first`). The solver accepts
  /// a residual below `least`; null if the residual contains other quantities than forces.
  struct ResidualSquares {
    double now = 0;
    double first = 0;
    double* least = nullptr;  ///< squared norm below which the residual is accepted [N^2]
  };
  virtual ResidualSquares residual_squares() = 0;
  /// The number of iterations of the last step.
  virtual int iterations() const = 0;

  // Access to the other data of the model.
  /// True if the state consists of nodal values only, and the loads are known before a step.
  virtual bool is_predictable() const = 0;
  virtual double time_increment() const = 0;
  /// The number of the present step of the analysis.
  virtual int analysis_step() const = 0;
  /// The values of all load curves at the present time.
  virtual std::vector<double> load_values() const = 0;
  /// Saves the state of the model at the start of a step.
  virtual void save_state() = 0;
  /// Restores the saved state exactly.
  virtual void restore_state() = 0;

  virtual void log(const std::string& line) const = 0;
};

}  // namespace newton
