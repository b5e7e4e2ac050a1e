/// The system of equations of FEBio's solver: its matrix, when that is formed, and its tolerances.
#pragma once

#include "febio_solver.h"

class FEGlobalMatrix;

namespace newton {

/// FEBio's use of a matrix once it is formed.
enum class MatrixStrategy {
  none,            ///< the present step forms none
  updated,         ///< updates of a quasi-Newton method, as many as most_updates(); 0: each iteration has its own
  unchanged,       ///< modified Newton
  preconditioner,  ///< of differences of residuals (JFNK)
  residuals_alone  ///< the same without a matrix
};

class FEBioSystem {
 public:
  /// Keeps references.
  FEBioSystem(FEModel& fem, FEBioSolver& solver) : fem_(fem), solver_(solver) {}

  FEBioSolver& solver() const { return solver_; }

  /// The smallest of FEBio's tolerances on increments that are tested, each a part of the change of the step;
  /// infinite where none is.
  double increment_tolerance() const;

  // The system of equations. FEBio solves for the residual at the start of an iteration, vectors().residual.
  FEGlobalMatrix& matrix() const;
  /// Returns false where FEBio cannot solve.
  bool solve(std::vector<double>& solution, std::vector<double> right) const;
  /// Factorises the matrix as it is. Throws FEBio's error where that fails.
  void factorise() const;
  /// Forms a matrix at the present state, as FEBio does within its iterations, and informs everybody.
  void form_matrix() const;
  /// Evaluates the residual at the present state again.
  void renew_residual() const;

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

 private:
  FEModel& fem_;
  FEBioSolver& solver_;
};

}  // namespace newton
