/// Automatic penalties of the traction that are reduced where time steps fail.
///
/// A penalty is a device, no property of the scene: a hard contact can invert an element where a softer one does not.
/// There is one state for a model, since a step that fails does not tell which of its contacts is to blame.
///
///     full ---fail---> reduced, by one level more with each failed attempt
///     reduced ---accept, as often as the patience asks---> one level less, in the end full
///
/// Where an attempt fails after penalties had recovered, they take twice as many accepted steps until they do so again:
/// a scene that needs soft contact for long is not tried in vain at every other step.
#pragma once

namespace mixture_contact {

class PenaltyReduction {
 public:
  /// What a level divides penalties by, and how many levels there are: from the default factor down to 1.
  static constexpr double per_level = 10;
  static constexpr int most_levels = 3;

  /// What automatic penalties are divided by at present.
  double divisor() const;
  bool is_full() const { return level_ == 0; }

  /// An attempt at a step has failed, and another one follows. Returns whether penalties are smaller from now on.
  bool fail();
  /// A step has been accepted.
  void accept();

  /// Calls take(value) for each value of the state.
  template <class Take>
  void for_each_value(const Take& take) {
    take(level_);
    take(patience_);
    take(accepted_);
    take(recovered_);
  }

 private:
  int level_ = 0;
  int patience_ = 1;   ///< accepted steps until penalties recover by a level
  int accepted_ = 0;   ///< since the level changed
  int recovered_ = 0;  ///< levels since the last failure
};

}  // namespace mixture_contact
