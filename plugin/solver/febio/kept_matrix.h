/// The matrix of FEBio's Newton methods, which those of quasi-Newton kind keep for several iterations, and what
/// contacts change of its use.
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

  /// FEBio has formed another one, as it said. It is solved with these deferred parts.
  void formed(const MatrixParts& parts);
  /// FEBio goes on after an iteration: the same of a matrix that it has formed silently, and of the one it has where
  /// iterations begin with it and without updates.
  void go_on(const MatrixParts& parts, bool begins);
  /// The solution with these conditions and the present deferred parts; none where that is singular or
  /// nothing is to be corrected with it.
  std::optional<Answer> answer(const std::vector<Condition>& conditions);
  /// FEBio's next solution is to meet these conditions and no others, and to be what it has answered: the right-hand
  /// side has changed with the conditions.
  void hold(const std::vector<Condition>& conditions, const MatrixParts& parts, Answer answer);
  /// Whether contacts may add rows of it to others.
  bool takes_operations() const { return !found_.loses_pivots; }
  /// FEBio has formed one to which contacts have done this.
  void take(RowOperations operations) { operations_ = std::move(operations); }
  /// FEBio is about to solve: its right-hand side takes the same, until there is a trial.
  void solve();
  /// FEBio's right-hand side is its own again: it is about to change.
  void give_back();
  /// A trial has been made of FEBio's solution: FEBio's right-hand side is its own again.
  void tried(const std::vector<double>& solution);
  /// Whether parts have been too large to be deferred. They are to be in the matrix from now on.
  bool needs_parts() const { return found_.needs_parts; }
  /// Whether another one is to be formed: where it has served as many iterations as FEBio's limit allows, and where
  /// nothing is to be corrected with it, or is to be with parts in it.
  bool is_due();
  /// An iteration with it has ended. Whether it has left too much of the residual for another one like it.
  bool is_spent();
  /// Has FEBio form another one after this trial, or takes that back: not what others ask for.
  void request(bool is_needed);
  /// An iteration with it has been corrected: the next one is without FEBio's updates, and holds these conditions.
  void correct(const std::vector<Condition>& conditions, const MatrixParts& parts);

  /// A converged state has been rejected, and the next iteration is to be with this matrix, corrected.
  void keep_next() { restore(); }
  /// A converged state has been accepted. The augmentation or step that follows has a matrix where FEBio's settings
  /// say so, and where conditions were held with this one.
  void accept();
  /// Has FEBio form a matrix before the next iteration, also where that follows an augmentation.
  void force_next();
  /// A time step has been solved: FEBio has its own setting again, whether augmentations form matrices.
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
    bool loses_pivots = false;  ///< they cannot be factorised after the row operations of contacts
  };
  /// FEBio does not announce the matrices that it forms after augmentations, but counts all within a step. Returns
  /// whether there is another one.
  bool follow();
  /// Begins with another one.
  void begin();
  /// Has FEBio's next solution meet conditions, and the parts with them.
  void prepare(const std::vector<Condition>& conditions, const MatrixParts& parts);
  /// Has FEBio's next solution meet conditions, once the right-hand side has been split.
  void finish(Split split, const MatrixParts& parts, const std::vector<Condition>& conditions);
  /// The solution for a right-hand side that has taken the row operations of the matrix. Zero, and nothing may be
  /// corrected from then on, where FEBio cannot solve.
  std::vector<double> solution_of_changed(std::vector<double> changed);
  /// The solution for a right-hand side that has taken no row operations.
  std::vector<double> solution(const std::vector<double>& right);
  /// The matrix has rows as they were where what contacts have done to them has lost pivots.
  std::vector<double> checked_solution(const std::vector<double>& right);
  /// Factorises the matrix as it is without that, and so do those that follow; says so once.
  void undo_operations();
  /// Has the next matrices hold the parts that were deferred, and says so once.
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
  std::vector<double> taken_;             ///< what the right-hand side is without until there is a trial
  Split split_;                           ///< how that was found, except conditions; its product is taken
  MatrixParts split_parts_;               ///< of that, until there is a trial
  double reduction_ = unknown_reduction;  ///< of splits, as the last trials have shown it
  std::vector<double> free_;            ///< the solution without conditions, with parts as they stood, once it is known
  std::optional<bool> reform_augment_;  ///< FEBio's own setting, while a matrix is forced
};

/// Has FEBio's right-hand side as it was once a trial is made.
class RightHandSide : public Helper {
 public:
  /// Keeps a reference.
  explicit RightHandSide(KeptMatrix& matrix) : matrix_(matrix) {}
  void try_increment(const std::vector<double>& increment) override { matrix_.tried(increment); }

 private:
  KeptMatrix& matrix_;
};

}  // namespace newton
