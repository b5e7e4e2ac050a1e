/// How bonds that soften change in the iterations of a step, and which derivative leads to a solution.
#pragma once

#include "tie/tie.h"

namespace mixture_contact {

/// How often a bond may change its phase in a step before it is taken for going to and fro: it begins to grow, fails,
/// and may do one of these too early. The size is a choice.
inline constexpr int most_phase_changes = 3;
/// After as many iterations in a row that contract, those of yielding bonds are near a solution. The size is a choice.
inline constexpr int enough_contractions = 2;
/// An iteration contracts where gap vectors change by less than this part of their last change.
inline constexpr double contraction = 0.9;

/// Counts the changes of bonds between constant damage, growing damage and failure. Once one goes to and fro, those
/// whose damage grows yield until iterations contract: if softening exceeds the stiffness of the bodies, as when a
/// crack jumps, Newton's method alternates for ever, and yielding bonds lead to a state beyond the jump.
class BondIterations {
 public:
  /// Begins an iteration at a state whose tangent is taken next. Nothing happens to bonds that do not soften.
  void begin(const Tie& tie, const PerSide<SurfaceFields>& fields);
  Softening softening() const { return softening_; }

 private:
  enum class Phase { constant, growing, failed };
  static IndexedVector<Phase> phases_of(const Tie& tie, const TieLoads& loads);
  /// Compares with where the last iteration began.
  void compare(const IndexedVector<Phase>& phases, const Matrix3Xd& gaps);

  IndexedVector<Phase> phases_;  ///< per tied node where the last iteration began; empty: none has
  IndexedVector<int> changes_;   ///< of phase, per tied node
  Matrix3Xd gaps_;               ///< gap vectors where the last iteration began [mm]
  double move_ = 0;              ///< change of the gap vectors by the iteration before [mm]
  int contractions_ = 0;         ///< in a row, without a change of phase
  Softening softening_ = Softening::exact;
};

}  // namespace mixture_contact
