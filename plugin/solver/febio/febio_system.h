/// The system of equations of FEBio's solver: its matrix, when that is formed, and its tolerances.
#pragma once

#include "febio_solver.h"

class FEGlobalMatrix;

namespace newton {

/// FEBio's use of a matrix once it is formed.
enum class MatrixStrategy {
  none,            ///< the present step forms none
  updated,         ///< at most most_updates() updates of a quasi-Newton method; 0: a matrix for each iteration
  unchanged,       ///< modified Newton
  preconditioner,  ///< of differences of residuals (JFNK)
  residuals_alone  ///< differences of residuals without a preconditioner
};

class FEBioSystem {
 public:
  /// Keeps references.
  FEBioSystem(FEModel& fem, FEBioSolver& solver) : fem_(fem), solver_(solver) {}

  FEBioSolver& solver() const { return solver_; }

  /// The smallest of FEBio's tolerances on increments that are tested, each a part of the change of the step; infinite
  /// if FEBio tests none.
  double increment_tolerance() const;

  // The system of equations. FEBio solves for the residual at the start of an iteration, vectors().residual.
  FEGlobalMatrix& matrix() const;
  /// Returns false if FEBio cannot solve.
  bool solve(std::vector<double>& solution, std::vector<double> right) const;
  /// Factorises the present matrix. Throws FEBio's error after a failure.
  void factorise() const;
  /// Forms a matrix at the present state, as FEBio does within its iterations, and calls all callbacks.
  void form_matrix() const;
  /// Evaluates the residual at the present state again.
  void renew_residual() const;

  // When FEBio forms a matrix
  MatrixStrategy strategy() const;
  /// Number of matrices that FEBio has formed in this step.
  int matrices() const;
  /// FEBio's limit on matrices between two augmentations.
  int most_matrices() const;
  bool may_form_matrix() const;
  int updates() const;
  int most_updates() const;
  /// Drops the updates of the matrix. Returns their number.
  int drop_updates() const;
  /// Whether FEBio must form a matrix after the present trial.
  bool is_matrix_forced() const;
  void force_matrix(bool is_forced) const;
  /// Whether FEBio forms a matrix after each augmentation.
  bool& forms_matrix_after_augmentations() const;

 private:
  FEModel& fem_;
  FEBioSolver& solver_;
};

}  // namespace newton
