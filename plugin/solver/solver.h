/// The Newton solver and its model as the helpers need them. FEBio's is in solver/febio, the tests have a fake one.
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

/// An element of a trial state is inverted.
struct InvertedElement : std::runtime_error {
  InvertedElement() : std::runtime_error("an element is inverted") {}
};

/// A nodal value: its node, and its number among the values of the node.
struct Place {
  int node = 0;
  int dof = 0;
  bool operator==(const Place& other) const { return node == other.node && dof == other.dof; }
  bool operator<(const Place& other) const { return node != other.node ? node < other.node : dof < other.dof; }
};

/// Codes for the equation of a nodal value: n where it is free, -n-2 where it is prescribed, -1 where there is none.
/// The map is its own inverse.
inline int prescribed(int equation) { return -equation - 2; }

inline bool is_prescribed(int code) { return code < -1; }

/// The equation behind a code, free or prescribed; -1 where there is none.
inline int equation_of(int code) { return is_prescribed(code) ? prescribed(code) : code; }

/// The vectors of the solver, an entry per equation.
struct Vectors {
  std::vector<double>& total;            ///< values at the start of the step
  std::vector<double>& change;           ///< since the start of the step
  std::vector<double>& increment;        ///< the last increment; before the first one, the prescribed increments
  std::vector<double>& residual;         ///< at the start of the iteration
  std::vector<double>& prescribed_load;  ///< part of the residual by prescribed increments
};

class Solver {
 public:
  Solver() = default;
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;
  Solver(Solver&&) = delete;
  Solver& operator=(Solver&&) = delete;
  virtual ~Solver() = default;

  /// Whether the present step is solved by Newton's method; nothing else below may be called where it is not.
  virtual bool is_newton() const = 0;

  // Nodal values
  virtual int nodes() const = 0;
  /// The dofs of each variable: displacement, pressure, one concentration.
  virtual std::vector<std::vector<int>> variables() const = 0;
  /// The position of the displacements among the variables().
  virtual std::size_t displacements() const = 0;
  /// The dofs that are concentrations.
  virtual std::vector<int> concentrations() const = 0;
  virtual int equation(Place place) const = 0;
  virtual void set_equation(Place place, int code) = 0;
  virtual double value(Place place) const = 0;
  virtual void set_value(Place place, double value) = 0;
  /// The value at the end of the last step.
  virtual double previous_value(Place place) const = 0;

  // The solver
  virtual Vectors vectors() = 0;
  /// Adds an increment to the change of the step, and evaluates the model there. Throws InvertedElement.
  virtual void update(std::vector<double>& increment) = 0;
  virtual std::vector<double> evaluate_residual() = 0;
  virtual std::vector<double> times_matrix(const std::vector<double>& vector) const = 0;
  /// Whether set_totals() reaches all that the convergence tests compare increments with.
  virtual bool has_known_totals() const = 0;
  virtual void set_totals(const std::vector<double>& change) = 0;
  /// Reactions at prescribed values, per equation, as of the last residual; none where the solver clamps nothing.
  virtual const std::vector<double>* reactions_of_clamp() const = 0;
  /// The tolerance of the line search, 0 for none; null if there is no line search.
  virtual double* line_search_tolerance() = 0;
  /// Squares of the residual: of the last trial, over that which the step began with. Below `least` the solver takes
  /// equations as solved; null if the residual has other parts than forces.
  struct ResidualSquares {
    double now = 0;
    double first = 0;
    double* least = nullptr;  ///< [N^2]
  };
  virtual ResidualSquares residual_squares() = 0;
  /// Iterations of the last step.
  virtual int iterations() const = 0;

  // The model
  /// Whether all that moves are nodal values, under loads that are known before a step.
  virtual bool is_predictable() const = 0;
  virtual double time_increment() const = 0;
  /// The number of the present step of the analysis.
  virtual int analysis_step() const = 0;
  virtual std::vector<double> load_values() const = 0;
  /// Keeps the state of the model at the start of a step, and restores it exactly.
  virtual void save_state() = 0;
  virtual void restore_state() = 0;

  virtual void log(const std::string& line) const = 0;
};

}  // namespace newton
