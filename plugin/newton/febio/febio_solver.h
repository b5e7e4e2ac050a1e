/// FEBio's solver of the present step, as the helpers know it.
#pragma once

#include "newton/solver.h"

#include <memory>

class DumpMemStream;
class FEGlobalMatrix;
class FEModel;
class FENewtonSolver;

namespace newton {

/// What FEBio makes of a matrix once it is formed.
enum class MatrixStrategy {
  none,            ///< the present step forms none
  updated,         ///< updates of a quasi-Newton method, as many as most_updates(); 0: each iteration has its own
  unchanged,       ///< modified Newton
  preconditioner,  ///< of differences of residuals (JFNK)
  residuals_alone  ///< the same without a matrix
};

/// FEBio's tolerances of squares of the residual, and of energy; 0 for none.
struct ResidualTolerances {
  double residual;        ///< over the first one
  double energy;          ///< over the first one
  double least_residual;  ///< below it no force is left
};

class FEBioSolver : public Solver {
 public:
  explicit FEBioSolver(FEModel& fem);
  ~FEBioSolver() override;

  /// Null where the present step is not solved by Newton's method.
  FENewtonSolver* febio() const;

  /// The smallest of FEBio's tolerances on increments that are tested, each a part of what the step has changed by;
  /// infinite where none is.
  double increment_tolerance() const;
  ResidualTolerances residual_tolerances() const;

  // The system of equations. FEBio solves for the residual at the start of an iteration, vectors().residual.
  FEGlobalMatrix& matrix() const;
  /// Returns false where FEBio cannot solve.
  bool solve(std::vector<double>& solution, std::vector<double> right) const;
  /// Factorises the matrix as it is. Throws FEBio's error where that fails.
  void factorise() const;
  /// Forms a matrix at the present state, as FEBio does within its iterations, and informs everybody.
  void form_matrix() const;
  /// Evaluates the residual at the present state anew.
  void renew_residual();

  // When FEBio forms a matrix
  MatrixStrategy strategy() const;
  /// How many matrices it has formed in this step.
  int matrices() const;
  /// Its limit on those between two augmentations.
  int most_matrices() const;
  bool may_form_matrix() const;
  int updates() const;
  int most_updates() const;
  /// Takes updates of the matrix back. Returns how many there were.
  int drop_updates() const;
  /// Whether it is to form one after the present trial.
  bool is_matrix_forced() const;
  void force_matrix(bool is_forced) const;
  /// Whether it forms one after each augmentation.
  bool& forms_matrix_after_augmentations() const;

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
  double* line_search_tolerance() override;
  ResidualSquares residual_squares() const override;
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
  bool forces_matrix_ = false;  ///< what the solver had planned when its state was saved
};

}  // namespace newton
