/// The equation system of FEBio's solver: its matrix, the strategy for new matrices, and its tolerances.
#pragma once

#include "febio_solver.h"

#include <Eigen/Core>

class FEGlobalMatrix;

namespace newton {

/// The use that FEBio makes of a matrix after its assembly.
enum class MatrixStrategy {
  none,            ///< no matrix is assembled in the present step
  updated,         ///< quasi-Newton with up to most_updates() updates; 0: a new matrix in each iteration
  unchanged,       ///< modified Newton: the same matrix for all iterations
  preconditioner,  ///< preconditioner of a Jacobian-free method (JFNK)
  residuals_alone  ///< Jacobian-free method without a preconditioner
};

/// Access to the equation system of FEBio's solver.
class FEBioSystem {
 public:
  /// Keeps a reference to the solver.
  explicit FEBioSystem(FEBioSolver& solver) : solver_(solver) {}

  FEBioSolver& solver() const { return solver_; }

  /// The smallest tolerance on increments that FEBio tests, relative to the change in the step; infinite if FEBio tests
  /// none.
  double increment_tolerance() const;

  // The equation system. FEBio solves for the residual at the start of an iteration, vectors().residual.
  FEGlobalMatrix& matrix() const;
  /// Solves for right-hand sides, which are the columns of a matrix, with the present factorisation. Returns a matrix
  /// without entries if FEBio's linear solver fails.
  Eigen::MatrixXd solve(Eigen::MatrixXd rights) const;
  /// Factorises the present matrix. Throws FEBio's error if that fails.
  void factorise() const;
  /// Assembles a matrix at the present state, as FEBio does within its iterations, with all callbacks.
  void form_matrix() const;
  /// Evaluates the residual at the present state again.
  void renew_residual() const;

  /// Makes FEBio use the profile of the present matrix for the next one too. In a model with contacts, FEBio otherwise
  /// builds a new profile for each matrix.
  void keep_profile() const;

  // FEBio's decisions to assemble a matrix.
  MatrixStrategy strategy() const;
  /// The number of matrices that FEBio has assembled in this step.
  int matrices() const;
  /// FEBio's limit on the number of matrices between two augmentations.
  int most_matrices() const;
  /// True if the limit on the number of matrices is not reached.
  bool may_form_matrix() const;
  /// The number of quasi-Newton updates since the last matrix.
  int updates() const;
  /// The largest number of quasi-Newton updates.
  int most_updates() const;
  /// Discards the quasi-Newton updates of the matrix. Returns their number.
  int drop_updates() const;
  /// True if FEBio will assemble a matrix after the present trial in any case.
  bool is_matrix_forced() const;
  /// Makes FEBio assemble a matrix after the present trial, or not.
  void force_matrix(bool is_forced) const;
  /// FEBio's setting whether a matrix is assembled after each augmentation.
  bool& forms_matrix_after_augmentations() const;

 private:
  FEBioSolver& solver_;
};

}  // namespace newton
