/// The part of softening that the derivative of cohesive bonds includes in each iteration of a step.
#pragma once

#include "tie/tie.h"

#include <limits>

namespace mixture_contact {

/// Selects the part s of softening for each iteration of a step.
///
/// Newton's method leads away from the solutions of a step if bonds soften by more than the bodies around them are
/// stiff, as happens when a crack proceeds from one node to the next. Bonds that soften therefore yield at first
/// (s = 0): iterations then reduce the energy, by small moves.
///
/// Let rho be the quotient of softening and the remaining stiffness in the mode that dominates. The moves of iterations
/// with the parts s_1 and s_2 have the quotient q = rho (1 - s_1)/(1 - rho s_2), which gives rho as long as no bond
/// changes its phase. s halves its distance from 1, so that iterations converge faster and faster to a solution. If
/// rho > 1, there is no solution in these phases: s is such that moves double, until they lead to other phases. Once a
/// bond changes its phase, s is zero again.
class BondIterations {
 public:
  /// Begins an iteration at the state whose tangent is computed next. It has no effect on a tie that is not cohesive.
  void begin(const Tie& tie, const PerSide<SurfaceFields>& fields);
  /// The part of softening that the next derivative includes, between 0 and 1.
  double softening() const { return softening_; }

 private:
  /// Whether the damage of a bond grows from the last accepted state to the present one, or has reached 1.
  enum class Phase { constant, growing, failed };
  /// The phases of all tied nodes.
  static IndexedVector<Phase> phases_of(const Tie& tie, const TieLoads& loads);
  /// The part of softening after a move in which no bond has changed its phase. `quotient`: the size of this move over
  /// that of the move before it.
  double next_softening(double quotient) const;

  IndexedVector<Phase> phases_;  ///< per tied node, at the start of the previous iteration; empty before the first
  Matrix3Xd gaps_;               ///< gap vectors at the start of the previous iteration [mm]
  double move_ = std::numeric_limits<double>::infinity();  ///< norm of the gap vectors' change in that iteration [mm]
  int quiet_ = 0;                                          ///< successive iterations without a change of phase
  double softening_ = 0;                                   ///< s of the last iteration
  double before_ = 0;                                      ///< s of the iteration before it
};

}  // namespace mixture_contact
