/// Concentrations that a solver clamps to zero.
///
/// After each iteration, FEBio's solver of the solute module always, and that of the multiphasic module optionally,
/// sets negative concentrations to zero. Fronts thinner than an element (d dt << h^2) undershoot, and this then happens
/// in every early step. Newton's method does not take the clamp into account: it computes the same negative change in
/// each iteration, the line search shrinks, and the step fails.
///
/// This helper replaces the clamp by an inequality that Newton's method can solve. A concentration that would become
/// negative is prescribed as zero until its balance requires a positive value (primal-dual active set). The solution is
/// the state that the clamp aims at. Models without a clamp do not change.
#pragma once

#include "helper.h"

#include <set>
#include <vector>

namespace newton {

/// The helper that solves the inequality.
class NonNegativeConcentrations : public Helper {
 public:
  /// Prescribes the concentrations that were prescribed at the end of the last step, because the active set usually
  /// changes little.
  void begin_iterations(Solver& solver) override;
  /// Prescribes concentrations that are negative in the solver's vectors, and frees those whose balance requires a
  /// positive value. Returns true if any has changed.
  bool adapt(Solver& solver) override;
  bool adapt_before_residual(Solver& solver) override;
  /// True if adapt() would change nothing.
  bool is_settled(Solver& solver) const override;
  /// Frees all concentrations at their value 0. Between steps, and in restart files, none is prescribed.
  void end_step(Solver& solver) override;
  void let_go(Solver& solver) override { release(solver); }
  bool holds(Place place) const override;
  void yield(Place place) override;

 private:
  /// Free concentrations that are negative in the solver's vectors.
  static std::vector<Place> negative(Solver& solver);
  /// Prescribed concentrations whose balance requires a positive value.
  std::vector<Place> rising(const Solver& solver) const;
  void release(Solver& solver);
  void resume(Solver& solver);
  void hold(Solver& solver, Place place);

  /// Concentrations that are prescribed as zero.
  std::vector<Place> held_;
  std::vector<Place> last_;  ///< concentrations that were prescribed at the end of the last step
  std::set<Place> freed_;    ///< concentrations that were freed in this step
  bool has_acted_ = false;   ///< true if the helper has acted in this run
};

}  // namespace newton
