/// The automatic penalties of a model's contacts, which are reduced after failed steps, and the lines of a log on this.
#pragma once

#include "penalty_reduction.h"
#include "warnings.h"

class ReduciblePenalties {
 public:
  /// The reduced penalties of a step of `dt` [s].
  mixture_contact::ReducedPenalty at(double dt) const { return reduction_.at(dt); }
  bool are_reduced() const { return !reduction_.is_full(); }

  /// An attempt at the step of `dt` to `time` has failed [s], and another one follows. Returns a line for the log;
  /// empty if there is none.
  std::string fail(double time, double dt);
  /// The largest overlap of a contact in a step that is accepted with reduced penalties.
  void note(const std::string& contact, const mixture_contact::Overlap& overlap, double time);
  /// A step has been accepted.
  void accept() { reduction_.accept(); }
  /// The line of the log at the end of a run; empty if there is none.
  std::string summary() const;

  /// Calls take(value) for each value of the state.
  template <class Take>
  void for_each_value(const Take& take) {
    reduction_.for_each_value(take);
    take(accepted_.contact);
    take(accepted_.overlap.depth);
    take(accepted_.overlap.share);
    take(accepted_.time);
  }

 private:
  mixture_contact::PenaltyReduction reduction_;
  AcceptedOverlap accepted_;  ///< the deepest one
  bool said_ = false;         ///< whether this run has reported reduced penalties
};
