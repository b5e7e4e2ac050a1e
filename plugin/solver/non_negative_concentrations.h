/// Concentrations that a solver clamps to zero.
///
/// FEBio's solver for the solute module always, and that for the multiphasic module by option, sets negative
/// concentrations to zero after each iteration. Fronts thinner than an element (d dt << h^2) undershoot, so this
/// happens at every early step. Newton's method does not know: it computes the same negative change for ever, the line
/// search shrinks, and the step fails. Here the clamp is made an inequality that Newton can solve: a concentration that
/// would become negative is held at zero, as a prescribed value, until its balance wants it to be positive (a
/// primal-dual active set). The state reached is the one that the clamp means. Models without a clamp do not change.
#pragma once

#include "helper.h"

#include <set>
#include <vector>

namespace newton {

class NonNegativeConcentrations : public Helper {
 public:
  explicit NonNegativeConcentrations(Solver& solver) : solver_(solver) {}

  /// Holds the concentrations that were held at the end of the last step: the active set seldom changes much.
  void begin_iterations() override;
  /// Holds concentrations that have become negative in the solver's vectors, and frees held ones whose balance wants
  /// them positive.
  bool adapt() override;
  bool adapt_before_residual() override;
  /// Whether adapt() would change nothing.
  bool is_settled() const override;
  /// Frees all with the value 0 that they have: between steps, and in restart files, nothing is held.
  void end_step() override;
  void let_go() override { release(); }
  bool holds(Place place) const override;
  void yield(Place place) override;

 private:
  std::vector<Place> negative() const;
  std::vector<Place> rising() const;
  void release();
  void resume();
  void hold(Place place);

  Solver& solver_;
  std::vector<Place> held_;
  std::vector<Place> last_;  ///< held at the end of the last step
  std::set<Place> freed_;    ///< in this step
  bool has_acted_ = false;   ///< in this run
};

}  // namespace newton
