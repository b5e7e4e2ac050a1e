/// Detects oscillating bonds of a cohesive tie during the iterations of a step, and selects the derivative for them.
#pragma once

#include "tie/tie.h"

namespace mixture_contact {

/// How often a bond may change its phase (see Phase) in a step before the iterations count as oscillating. A bond
/// normally changes twice, when its damage begins to grow and when it fails, and may do one of these too early. The
/// number is a choice.
inline constexpr int most_phase_changes = 3;
/// Number of successive contracting iterations after which the exact derivative is used again. The number is a choice.
inline constexpr int enough_contractions = 2;
/// An iteration contracts if the gap vectors change by less than this fraction of their previous change.
inline constexpr double contraction = 0.9;

/// Selects the derivative that the next iteration uses for bonds whose damage grows.
///
/// If softening exceeds the stiffness of the bodies, for example when a crack advances abruptly, Newton's method may
/// alternate for ever between two states. This class counts the changes of each bond between constant damage, growing
/// damage and failure. As soon as one bond oscillates, it selects Softening::yielding, with which iterations pass the
/// unstable states, and returns to Softening::exact when the iterations contract.
class BondIterations {
 public:
  /// Begins an iteration at the state whose tangent is computed next. It has no effect on a tie that is not cohesive.
  void begin(const Tie& tie, const PerSide<SurfaceFields>& fields);
  /// The kind of derivative to use for bonds whose damage grows.
  Softening softening() const { return softening_; }

 private:
  /// Whether the damage of a bond grows from the last accepted state to the present one, or has reached 1.
  enum class Phase { constant, growing, failed };
  /// The phases of all tied nodes.
  static IndexedVector<Phase> phases_of(const Tie& tie, const TieLoads& loads);
  /// Compares phases and gap vectors with those at the start of the previous iteration.
  void compare(const IndexedVector<Phase>& phases, const Matrix3Xd& gaps);

  IndexedVector<Phase> phases_;  ///< per tied node, at the start of the previous iteration; empty before the first
  IndexedVector<int> changes_;   ///< per tied node, number of phase changes
  Matrix3Xd gaps_;               ///< gap vectors at the start of the previous iteration [mm]
  double move_ = 0;              ///< norm of the gap vectors' change in the previous iteration [mm]
  int contractions_ = 0;         ///< number of successive contracting iterations without a change of phase
  Softening softening_ = Softening::exact;
};

}  // namespace mixture_contact
