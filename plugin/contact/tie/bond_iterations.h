/// The part of softening that the derivative of cohesive bonds includes in each iteration of a step.
#pragma once

#include "tie/tie.h"

namespace mixture_contact {

/// Selects the part s of softening for each iteration of a step.
///
/// Newton's method leads away from the solutions of a step if bonds soften by more than the bodies around them are
/// stiff, as happens when a crack proceeds from one node to the next. Bonds that soften therefore have a constant
/// traction at first (s = 0): iterations then reduce the energy, by small moves. Bonds that shear may overshoot at a
/// constant traction, and open and close again. Once a move turns back at s = 0, bonds have a constant damage in place
/// of a constant traction until the end of the step.
///
/// Let rho be the quotient of softening and the remaining stiffness in the mode that dominates. The moves of iterations
/// with the parts s_1 and s_2 have the quotient q = rho (1 - s_1)/(1 - rho s_2), which gives rho as long as no bond
/// changes its phase. s halves its distance from 1, so that iterations converge faster and faster to a solution. If
/// rho > 1, there is no stable solution in these phases: s is such that moves double, until they lead to other phases.
/// A negative q indicates a mode with rho s_2 > 1 that other modes have concealed, and s is zero again: the iterations
/// would otherwise converge to an unstable solution. Once a bond changes its phase, s is zero again.
class BondIterations {
 public:
  /// Begins an iteration at the state whose tangent is computed next. It has no effect on a tie that is not cohesive.
  void begin(const Tie& tie, const PerSide<SurfaceFields>& fields);
  /// The softening that the next derivative includes.
  Softening softening() const { return {softening_, turned_back_ ? Constant::damage : Constant::traction}; }
  /// True if the damage of a bond has grown since the last accepted state, at the start of the last iteration.
  bool is_any_softening() const;

 private:
  /// Whether the damage of a bond grows from the last accepted state to the present one, or has reached 1.
  enum class Phase { constant, growing, failed };
  /// The phases of all tied nodes.
  static IndexedVector<Phase> phases_of(const Tie& tie, const TieLoads& loads);
  /// The quotient q of a move and the move before it: the projection of the one on the other, over the size of the
  /// other.
  static double quotient(const Matrix3Xd& move, const Matrix3Xd& last);
  /// The part of softening after a move in which no bond has changed its phase. `quotient`: q of this move.
  double next_softening(double quotient) const;

  IndexedVector<Phase> phases_;  ///< per tied node, at the start of the previous iteration; empty before the first
  Matrix3Xd gaps_;               ///< gap vectors at the start of the previous iteration [mm]
  Matrix3Xd move_;               ///< change of the gap vectors in that iteration [mm]
  bool turned_back_ = false;     ///< true once a move has turned back at s = 0
  int quiet_ = 0;                ///< successive iterations without a change of phase
  double softening_ = 0;         ///< s of the last iteration
  double before_ = 0;            ///< s of the iteration before it
};

}  // namespace mixture_contact
