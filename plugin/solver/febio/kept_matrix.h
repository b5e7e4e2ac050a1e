/// The matrix of FEBio's solver over several iterations, and its corrections for contacts: conditions, deferred parts
/// and row operations.
#pragma once

#include "solver/border.h"
#include "solver/febio/febio_system.h"
#include "solver/helper.h"
#include "solver/row_operations.h"
#include "solver/splitting.h"

#include <optional>
#include <utility>
#include <vector>

class DumpStream;

namespace newton {

/// Corrects FEBio's right-hand side such that FEBio's solution with the present matrix also meets conditions and
/// includes deferred parts.
class KeptMatrix {
 public:
  /// Keeps a reference to the equation system. `read`: lists the equations that conditions and deferred parts read.
  KeptMatrix(const FEBioSystem& system, ListEquations read) : system_(system), border_(std::move(read)) {}

  /// Notes that FEBio has assembled a new matrix after an announcement. The next solution includes the deferred parts
  /// `parts`.
  void formed(const MatrixParts& parts);
  /// Notes that FEBio continues after an iteration. The next solution includes the deferred parts, if FEBio has
  /// assembled a matrix without an announcement, or if iterations begin with the same matrix without updates.
  void go_on(const MatrixParts& parts, bool begins);
  /// The solution with these conditions and the present deferred parts; empty if the system is singular or the matrix
  /// cannot be corrected.
  std::optional<Answer> answer(const std::vector<Condition>& conditions);
  /// Makes FEBio's next solution meet exactly these conditions, for a right-hand side that has changed with the
  /// conditions. `answer`: result of answer() with these conditions.
  void hold(const std::vector<Condition>& conditions, const MatrixParts& parts, Answer answer);
  /// True if row operations may be applied to the matrix.
  bool takes_operations() const { return !found_.loses_pivots; }
  /// Notes that FEBio has assembled a new matrix, to which these row operations have been applied. Discards the
  /// solutions with the last matrix, whose memory FEBio's factorisation needs.
  void take(RowOperations operations);
  /// Applies the row operations to FEBio's right-hand side before FEBio solves, until a trial.
  void solve();
  /// Restores FEBio's right-hand side, before it is changed.
  void give_back();
  /// Notes that FEBio has made a trial with this solution, and restores its right-hand side.
  void tried(const std::vector<double>& solution);
  /// True if deferred parts were too large for stationary iteration, such that later matrices have to include them.
  bool needs_parts() const { return found_.needs_parts; }
  /// True if FEBio has to assemble a new matrix: at FEBio's limit of iterations, if the matrix cannot be corrected, or
  /// if it has to include the deferred parts.
  bool is_due();
  /// Notes that an iteration has ended. Returns true if it has left too much of the residual for another iteration with
  /// this matrix.
  bool is_spent();
  /// Requests a new matrix after this trial, or withdraws the request. Requests by others are not affected.
  void request(bool is_needed);
  /// Notes that the linearisation has been corrected for another iteration with this matrix. The next solution omits
  /// FEBio's updates and meets these conditions.
  void correct(const std::vector<Condition>& conditions, const MatrixParts& parts);

  /// Notes that a converged state has been rejected, and that the next iteration uses this matrix with corrections.
  void keep_next() { restore(); }
  /// Notes that a converged state has been accepted. The next augmentation or step gets a new matrix if FEBio's
  /// settings require it, or if this matrix had conditions.
  void accept();
  /// Makes FEBio assemble a matrix before the next iteration, also after an augmentation.
  void force_next();
  /// Ends a time step: restores FEBio's setting for matrices after augmentations, and resets the count of matrices
  /// after which too much of the residual was left.
  void end_step();

  void serialize(DumpStream& ar);

 private:
  /// The iterations with the matrix, and a count for the step.
  struct Served {
    int iterations = 0;  ///< number of iterations up to the last one that was corrected
    double left = 0;     ///< norm of the residual after the last iteration; 0 before any
    int spent = 0;       ///< number of matrices in this step with which corrections left too much of the residual

    /// True if the last iteration was corrected and has left too much of the residual. Notes the norm of the residual.
    bool leave_too_much(double residual);
  };
  /// Properties of the model's matrices that have been found so far.
  struct Found {
    bool needs_parts = false;   ///< true if deferred parts are too large for stationary iteration
    bool loses_pivots = false;  ///< true if factorisations fail after row operations
  };
  /// Detects a new matrix that FEBio has assembled without an announcement, as after augmentations, by FEBio's count of
  /// matrices in the step. Returns true if there is one.
  bool follow();
  /// Resets the data of the last matrix.
  void begin();
  /// Changes FEBio's right-hand side such that the next solution meets conditions and includes the deferred parts.
  void prepare(const std::vector<Condition>& conditions, const MatrixParts& parts);
  /// Changes FEBio's right-hand side for the result of a splitting, and such that the next solution meets conditions.
  void finish(Split split, const MatrixParts& parts, const std::vector<Condition>& conditions);
  /// The solutions for right-hand sides to which the row operations have been applied. If FEBio cannot solve, they are
  /// zero, and the matrix cannot be corrected any more.
  Eigen::MatrixXd solutions_of_changed(Eigen::MatrixXd changed);
  /// Solves for right-hand sides to which the row operations have not been applied.
  SolveAll solve_all();
  /// The solution for a right-hand side to which the row operations have not been applied. If row operations have
  /// caused inaccurate pivots, it restores the rows of the matrix and solves again.
  std::vector<double> checked_solution(const std::vector<double>& right);
  /// Reverses the row operations of this matrix, allows none for later matrices, and logs this once.
  void undo_operations();
  /// Makes later matrices include the deferred parts, and logs this once.
  void take_parts_in();
  /// Restores FEBio's setting for matrices after augmentations.
  void restore();

  const FEBioSystem& system_;
  Border border_;
  int number_ = 0;             ///< number of the matrix in FEBio's count of the step
  Served served_;              ///< iterations with this matrix
  bool is_requested_ = false;  ///< true if request() has requested a new matrix
  bool may_correct_ = true;    ///< true if the matrix can be solved with conditions
  Found found_;
  RowOperations operations_;
  std::vector<double> taken_;             ///< part subtracted from FEBio's right-hand side until a trial
  Split split_;                           ///< result of the splitting in `taken_`, without conditions
  MatrixParts split_parts_;               ///< deferred parts of `split_`, until a trial
  double reduction_ = unknown_reduction;  ///< reduction by a stationary iteration, as the last trials have shown
  std::vector<double> free_;              ///< solution without conditions, with the deferred parts; empty if unknown
  std::optional<bool> reform_augment_;    ///< FEBio's setting, while a matrix after augmentations is forced
};

/// Restores FEBio's right-hand side after a trial.
class RightHandSide : public Helper {
 public:
  /// Keeps a reference to the matrix.
  explicit RightHandSide(KeptMatrix& matrix) : matrix_(matrix) {}
  void try_increment(Solver& /*solver*/, const std::vector<double>& increment) override { matrix_.tried(increment); }

 private:
  KeptMatrix& matrix_;
};

}  // namespace newton
