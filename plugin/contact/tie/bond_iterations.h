/// The part of softening that the derivative of bonds includes in the iterations of a step.
#pragma once

#include "tie/tie.h"

#include <limits>

namespace mixture_contact {

/// Chooses the part s of softening for each iteration of a step.
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
  /// Begins an iteration at a state whose tangent is taken next. Nothing happens to bonds that do not soften.
  void begin(const Tie& tie, const PerSide<SurfaceFields>& fields);
  double softening() const { return softening_; }

 private:
  enum class Phase { constant, growing, failed };
  static IndexedVector<Phase> phases_of(const Tie& tie, const TieLoads& loads);
  /// The part of softening after a move in which no bond has changed its phase, given its quotient with the move before
  /// it.
  double next_softening(double quotient) const;

  IndexedVector<Phase> phases_;  ///< per tied node where the last iteration began; empty: none has
  Matrix3Xd gaps_;               ///< gap vectors where the last iteration began [mm]
  double move_ = std::numeric_limits<double>::infinity();  ///< change of the gap vectors by the iteration before [mm]
  int quiet_ = 0;                                          ///< iterations in a row without a change of phase
  double softening_ = 0;                                   ///< s of the last iteration
  double before_ = 0;                                      ///< s of the iteration before it
};

}  // namespace mixture_contact
