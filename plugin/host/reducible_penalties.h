/// The reduction of a model's automatic penalties after failed steps, with the lines about it for the log.
#pragma once

#include "penalty_reduction.h"
#include "warnings.h"

/// Keeps the reduction and the largest overlap that was accepted with reduced penalties.
class ReduciblePenalties {
 public:
  /// The reduced penalties in a step of length dt [s].
  mixture_contact::ReducedPenalty at(double dt) const { return reduction_.at(dt); }
  bool are_reduced() const { return !reduction_.is_full(); }

  /// Notes that an attempt at the step of length dt to `time` has failed [s] and another one follows. Returns a line
  /// for the log; empty if there is nothing to report.
  std::string fail(double time, double dt);
  /// Notes the overlap of a contact in a step that is accepted with reduced penalties.
  void note(const std::string& contact, const mixture_contact::Overlap& overlap, double time);
  /// Notes that a step has been accepted.
  void accept() { reduction_.accept(); }
  /// A line for the log at the end of the run; empty if there is nothing to report.
  std::string summary() const;

  /// Calls take(value) for each value of the state, for a restart.
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
  AcceptedOverlap accepted_;  ///< the largest overlap
  bool said_ = false;         ///< true if this run has reported reduced penalties
};
