/// Reduction of automatic traction penalties after failed time steps.
///
/// A penalty is a numerical device and not a property of the model: stiff contact can invert an element where softer
/// contact does not. One reduction applies to all contacts of a model, because a failed step does not show which
/// contact caused the failure.
///
///     full or reduced ---failure---> lowest penalties, the stiffness of the bodies
///     reduced ---`patience_` accepted steps---> one level stiffer, finally full
///
/// Under a softer contact, bodies that a stiff contact has pressed would have to expand at once. The tractions of the
/// accepted state that the smaller penalty does not bear therefore decrease over the length of the failed step; a
/// shorter attempt releases less.
///
/// If an attempt fails after the penalties have recovered, the next recovery takes twice as many accepted steps, so
/// that a model which needs soft contact for long does not fail at every other step.
#pragma once

#include "contact/base/settings.h"

namespace mixture_contact {

/// The level of the penalties of a model's contacts.
class PenaltyReduction {
 public:
  /// The factor between the penalties of two levels, and the number of levels from the default factor down to 1.
  static constexpr double per_level = 10;
  static constexpr int most_levels = 3;

  /// The present divisor of automatic penalties.
  double divisor() const;
  /// True if the penalties are not reduced.
  bool is_full() const { return level_ == 0; }

  /// The reduced penalties in a step of length dt [s].
  ReducedPenalty at(double dt) const;

  /// Notes that an attempt at a step of length dt [s] has failed and another one follows. Returns true if penalties are
  /// now smaller.
  bool fail(double dt);
  /// Notes that a step has been accepted.
  void accept();

  /// Calls take(value) for each value of the state, for a restart.
  template <class Take>
  void for_each_value(const Take& take) {
    take(level_);
    take(patience_);
    take(accepted_);
    take(recovered_);
    take(fading_);
  }

 private:
  /// Number of levels by which penalties are reduced.
  int level_ = 0;
  int patience_ = 1;   ///< number of accepted steps after which penalties recover by a level
  int accepted_ = 0;   ///< number of accepted steps since the last change of level
  int recovered_ = 0;  ///< number of levels recovered since the last failure
  double fading_ = 0;  ///< length of the longest failed step since penalties were full [s]
};

}  // namespace mixture_contact
