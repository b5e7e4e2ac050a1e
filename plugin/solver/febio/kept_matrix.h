/// The matrix of FEBio's Newton methods, which quasi-Newton methods keep for several iterations, and its corrections by
/// contacts.
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

class KeptMatrix {
 public:
  /// Keeps a reference.
  explicit KeptMatrix(const FEBioSystem& system) : system_(system) {}

  /// FEBio has formed a new matrix, as announced. Solutions include these deferred parts.
  void formed(const MatrixParts& parts);
  /// FEBio continues after an iteration. Solutions include the deferred parts, with a matrix that FEBio has formed
  /// silently, and with one that it keeps at the start of iterations without updates.
  void go_on(const MatrixParts& parts, bool begins);
  /// The solution with these conditions and the present deferred parts; none if the system is singular or the matrix
  /// allows no correction.
  std::optional<Answer> answer(const std::vector<Condition>& conditions);
  /// Makes FEBio's next solution meet these conditions and no others: the right-hand side has changed with the
  /// conditions.
  void hold(const std::vector<Condition>& conditions, const MatrixParts& parts, Answer answer);
  /// Whether contacts may add rows of the matrix to others.
  bool takes_operations() const { return !found_.loses_pivots; }
  /// FEBio has formed a matrix to which contacts have applied these row operations.
  void take(RowOperations operations) { operations_ = std::move(operations); }
  /// FEBio is about to solve: its right-hand side takes the same row operations until a trial.
  void solve();
  /// Restores FEBio's right-hand side, which is about to change.
  void give_back();
  /// FEBio has made a trial of its solution. Restores its right-hand side.
  void tried(const std::vector<double>& solution);
  /// Whether parts were too large to be deferred. The matrix must include them from now on.
  bool needs_parts() const { return found_.needs_parts; }
  /// Whether FEBio has to form a new matrix: after FEBio's limit of iterations, if the matrix allows no correction, or
  /// if it must include the deferred parts.
  bool is_due();
  /// An iteration with the matrix has ended. Returns whether too much of the residual remains for another one.
  bool is_spent();
  /// Requests a new matrix after this trial, or withdraws the request. Requests by others remain.
  void request(bool is_needed);
  /// An iteration with the matrix has been corrected: the next one omits FEBio's updates and meets these conditions.
  void correct(const std::vector<Condition>& conditions, const MatrixParts& parts);

  /// A converged state has been rejected, and the next iteration uses this matrix, corrected.
  void keep_next() { restore(); }
  /// A converged state has been accepted. The next augmentation or step forms a matrix if FEBio's settings require it,
  /// or if this one had conditions.
  void accept();
  /// Makes FEBio form a matrix before the next iteration, also after an augmentation.
  void force_next();
  /// A time step has been solved. Restores FEBio's own setting for matrices after augmentations, and resets the count
  /// of spent matrices.
  void end_step();

  void serialize(DumpStream& ar);

 private:
  /// The record of iterations with the matrix, and of the step's earlier ones.
  struct Served {
    int iterations = 0;  ///< up to the last that was corrected
    double left = 0;     ///< of the residual, by the last one; 0 before any
    int spent = 0;       ///< matrices in this step with which corrections have left too much
  };
  /// The properties that matrices of the model have shown.
  struct Found {
    bool needs_parts = false;   ///< deferred parts are too large
    bool loses_pivots = false;  ///< factorisations fail after the row operations of contacts
  };
  /// FEBio does not announce the matrices that it forms after augmentations, but counts all within a step. Returns
  /// whether FEBio has formed a new one.
  bool follow();
  /// Begins with a new matrix.
  void begin();
  /// Makes FEBio's next solution meet conditions, and include the deferred parts.
  void prepare(const std::vector<Condition>& conditions, const MatrixParts& parts);
  /// Makes FEBio's next solution meet conditions after the right-hand side has been split.
  void finish(Split split, const MatrixParts& parts, const std::vector<Condition>& conditions);
  /// The solution for a right-hand side that has taken the row operations of the matrix. If FEBio cannot solve, the
  /// solution is zero, and the matrix allows no further correction.
  std::vector<double> solution_of_changed(std::vector<double> changed);
  /// The solution for a right-hand side that has taken no row operations.
  std::vector<double> solution(const std::vector<double>& right);
  /// Restores the original rows if the row operations of contacts have lost pivots.
  std::vector<double> checked_solution(const std::vector<double>& right);
  /// Factorises this and later matrices without row operations, and logs this once.
  void undo_operations();
  /// Includes the deferred parts in later matrices, and logs this once.
  void take_parts_in();
  void restore();

  const FEBioSystem& system_;
  Border border_;
  int number_ = 0;  ///< of the matrix, as FEBio counts them in a step
  Served served_;
  bool is_requested_ = false;  ///< another one, by request()
  bool may_correct_ = true;    ///< whether conditions can be held with it
  Found found_;
  RowOperations operations_;
  std::vector<double> taken_;             ///< part subtracted from the right-hand side until a trial
  Split split_;                           ///< the split behind `taken_`, without conditions
  MatrixParts split_parts_;               ///< of that, until there is a trial
  double reduction_ = unknown_reduction;  ///< of splits, as the last trials have shown it
  std::vector<double> free_;            ///< the solution without conditions, with parts as they stood, once it is known
  std::optional<bool> reform_augment_;  ///< FEBio's own setting, while a matrix is forced
};

/// Restores FEBio's right-hand side after a trial.
class RightHandSide : public Helper {
 public:
  /// Keeps a reference.
  explicit RightHandSide(KeptMatrix& matrix) : matrix_(matrix) {}
  void try_increment(const std::vector<double>& increment) override { matrix_.tried(increment); }

 private:
  KeptMatrix& matrix_;
};

}  // namespace newton
