/// Concentrations that FEBio's solver clamps to zero.
///
/// FEBio's solver for the solute module always, and that for the multiphasic module by option, sets negative
/// concentrations to zero after each iteration. Fronts thinner than an element (d dt << h^2) undershoot, so this
/// happens at every early step. Newton's method is not told: it computes the same negative change for ever, the line
/// search shrinks, and the step fails. Here the clamp is made an inequality that Newton can solve: a concentration that
/// would become negative is held at zero, as a prescribed value, until its balance wants it to be positive (a
/// primal-dual active set). The state reached is the one that the clamp means.
#pragma once

#include <set>
#include <utility>
#include <vector>

class FEModel;
class FENode;

class ClampedConcentrations {
 public:
  explicit ClampedConcentrations(FEModel& fem) : fem_(fem) {}

  /// At an accepted state within the iterations of a step: holds concentrations that have become negative in the
  /// solver's solution vector, and frees held ones whose balance wants them positive. Returns whether anything changed.
  bool update();

  /// The same at a state whose residual, and so its reactions, FEBio has not evaluated yet.
  bool update_at_new_state();

  /// Whether update() would change nothing.
  bool settled() const;

  /// Frees all held concentrations, at the start of a step.
  void release();

  /// Holds again, at the start of a step, what was held at the end of the last one: the active set seldom changes much.
  void resume();

  /// Frees all held concentrations at the end of a step, with the value 0 that they have: between steps, and in restart
  /// files, nothing is held.
  void end_step();

  /// Whether it holds this degree of freedom.
  bool holds(const FENode& node, int dof) const;

  /// Leaves a held degree of freedom to somebody else.
  void forget(const FENode& node, int dof);

 private:
  using Place = std::pair<FENode*, int>;  ///< node, degree of freedom
  std::vector<Place> negative() const;
  std::vector<Place> rising() const;

  std::vector<Place> held_;
  std::vector<Place> last_;  ///< held at the end of the last step
  std::set<Place> freed_;    ///< in this step
  FEModel& fem_;
};
