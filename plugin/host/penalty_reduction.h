/// Automatic penalties of the traction that are reduced where time steps fail.
///
/// A penalty is a device, no property of the scene: a hard contact can invert an element where a softer one does not. A
/// model has one state, because a failed step does not show which contact caused the failure.
///
///     full or reduced ---fail---> the softest level, the stiffness of the bodies
///     reduced ---accept, as often as the patience asks---> one level less, in the end full
///
/// A body that a hard contact has pressed has to yield to a softer one: the tractions of the accepted state that the
/// smaller penalty does not bear fade over the length of the step that has failed. The shorter the attempt, the less it
/// has to release.
///
/// If an attempt fails after penalties had recovered, they take twice as many accepted steps until they do so again:
/// a scene that needs soft contact for long is not tried in vain at every other step.
#pragma once

#include "contact/base/settings.h"

namespace mixture_contact {

class PenaltyReduction {
 public:
  /// The divisor of penalties of one level, and the number of levels: from the default factor down to 1.
  static constexpr double per_level = 10;
  static constexpr int most_levels = 3;

  /// The present divisor of automatic penalties.
  double divisor() const;
  bool is_full() const { return level_ == 0; }

  /// The reduced penalties of a step of `dt` [s].
  ReducedPenalty at(double dt) const;

  /// An attempt at a step of `dt` has failed [s], and another one follows. Returns whether penalties are smaller from
  /// now on.
  bool fail(double dt);
  /// A step has been accepted.
  void accept();

  /// Calls take(value) for each value of the state.
  template <class Take>
  void for_each_value(const Take& take) {
    take(level_);
    take(patience_);
    take(accepted_);
    take(recovered_);
    take(fading_);
  }

 private:
  int level_ = 0;
  int patience_ = 1;   ///< accepted steps until penalties recover by a level
  int accepted_ = 0;   ///< since the level changed
  int recovered_ = 0;  ///< levels since the last failure
  double fading_ = 0;  ///< length of the longest step that has failed since penalties were full [s]
};

}  // namespace mixture_contact
