/// FEBio's solver of the present step behind the interface that the helpers use.
#pragma once

#include "solver/solver.h"

#include <memory>

class DumpMemStream;
class FEModel;
class FENewtonSolver;

namespace newton {

/// Implements Solver with FEBio's model and the solver of its present step.
class FEBioSolver : public Solver {
 public:
  explicit FEBioSolver(FEModel& fem);
  ~FEBioSolver() override;

  /// FEBio's Newton solver; null if the present step is not solved by Newton's method.
  FENewtonSolver* febio() const;

  bool is_newton() const override { return febio() != nullptr; }
  int nodes() const override;
  std::vector<std::vector<int>> variables() const override;
  std::size_t displacements() const override;
  std::vector<int> concentrations() const override;
  int equation(Place place) const override;
  void set_equation(Place place, int code) override;
  double value(Place place) const override;
  void set_value(Place place, double value) override;
  double previous_value(Place place) const override;
  Vectors vectors() override;
  void update(std::vector<double>& increment) override;
  std::vector<double> evaluate_residual() override;
  std::vector<double> times_matrix(const std::vector<double>& vector) const override;
  bool has_known_totals() const override;
  void set_totals(const std::vector<double>& change) override;
  const std::vector<double>* reactions_of_clamp() const override;
  LineSearch line_search() override;
  ResidualSquares residual_squares() override;
  int iterations() const override;
  bool is_predictable() const override;
  double time_increment() const override;
  int analysis_step() const override;
  std::vector<double> load_values() const override;
  void save_state() override;
  void restore_state() override;
  void log(const std::string& line) const override;

 private:
  FEModel& fem_;
  std::unique_ptr<DumpMemStream> saved_;
  bool forces_matrix_ = false;  ///< the solver's plan to assemble a matrix, when its state was saved
};

}  // namespace newton
