/// A model at work: its current state, and what acts on it.
#pragma once

#include "contact.h"
#include "equations.h"
#include "linear_system.h"

#include <set>

namespace standalone {

/// Bodies, contacts and conditions with the current nodal values.
///
/// Nodal values are the solution that a solver has found plus its trial, except that it may set negative
/// concentrations to zero, and that ambient nodes have their bath's value.
class Problem {
 public:
  explicit Problem(const Model& model);

  const Model& model() const { return model_; }
  const Bodies& bodies() const { return bodies_; }
  const Equations& equations() const { return equations_; }
  std::vector<Contact>& contacts() { return contacts_; }
  /// Current u [mm], p~ [MPa], c~ [mM] and unknown multipliers of contact, shape (rows, nodes).
  const MatrixXd& values() const { return state_.values; }
  /// Forces that the last residual() left on prescribed displacements, where a condition reports them; shape (3,
  /// nodes).
  Matrix3Xd reactions() const;
  /// Which equations are held at a value now.
  std::vector<bool> held() const;
  LinearSystem linear_system() const { return {equations_.free(), equations_.size(), element_numbers_}; }

  /// Starts a time step that ends at `time` [s].
  void start_step(double time, double dt);
  /// Keeps the current state as what the next step starts from.
  void accept_step() { bodies_.accept_step(state_.values); }

  /// Forgets what iterations hold: contact status, linearised gaps and clamped concentrations.
  void end_iterations();
  /// Begins a Newton iteration at the current state: decides what is in contact, holds that, switches the nodes that
  /// are not to ambient values and, once a trial was made, concentrations that want to be negative to zero. Returns
  /// whether the residual has changed.
  bool begin_iteration();
  /// Whether no concentration that is held at zero wants to rise, and no other is negative.
  bool clamps_settled() const;

  /// Sets the nodal values to solution + trial and prescribed values. `keep_facets`: contact keeps to known facets.
  void set_trial(const VectorXd& trial, int iteration);
  /// Adds an accepted trial to the solution.
  void accept_trial(const VectorXd& trial) { state_.solution += trial; }

  /// Forces on the free equations; zero in equilibrium. Throws StepFailure where an element is inverted or a force not
  /// finite.
  VectorXd residual();
  /// Assembles the tangent, -d residual/d values.
  void assemble(LinearSystem& system) const;
  /// Prescribed increments that are not yet in the nodal values.
  VectorXd pending() const;

  /// What holds an equation at a value: nothing, the bath at a node that is not in contact, or the bound c >= 0. A
  /// solver that only sets negative concentrations to zero makes Newton compute the same negative change for ever; held
  /// as prescribed values until their balance drives them up, they are an inequality that it can solve (a primal-dual
  /// active set).
  enum class Hold : unsigned char { none, ambient, clamp };

  /// Everything that changes in a time step, to try one again.
  struct State {
    MatrixXd values;
    VectorXd solution;  ///< of the free equations
    std::vector<Hold> hold;
    std::vector<Contact::Saved> contacts;
  };
  State save();
  void restore(const State& state);

 private:
  bool is_concentration(int dof) const { return dof > pressure_dof && dof < model_.dofs(); }
  double ambient_value(const ContactDefinition& contact, int dof) const;
  bool switch_ambient();
  bool set_ambient(int equation, bool in_contact, double bath);
  /// Equations whose concentration is to be held at zero because it is negative, or to be freed because the balance
  /// drives it up.
  struct ClampChanges {
    std::vector<int> hold, free;
  };
  ClampChanges clamp_changes() const;
  bool clamp_concentrations();
  Hold& hold(int equation) { return state_.hold[static_cast<std::size_t>(equation)]; }
  Hold hold(int equation) const { return state_.hold[static_cast<std::size_t>(equation)]; }
  double& value(int number) { return state_.values(equations_.dof(number), equations_.node(number)); }
  double value(int number) const { return state_.values(equations_.dof(number), equations_.node(number)); }
  std::vector<int> numbers(const Contact::Dofs& dofs) const;
  /// Frees an equation, which goes on from the value that it has.
  void release(int equation);

  const Model& model_;
  Bodies bodies_;
  std::vector<Contact> contacts_;
  Equations equations_;
  std::vector<std::vector<int>> element_numbers_;
  std::vector<MatrixXd> unit_forces_;  ///< per load
  State state_;
  VectorXd target_;         ///< prescribed values of the current step
  VectorXd forces_;         ///< of the last residual(), on free and prescribed numbers
  std::set<int> reported_;  ///< prescribed numbers whose reaction is output
  std::set<int> freed_;     ///< equations that were clamped before in these iterations
  bool tried_ = false;      ///< whether a trial was made since the iterations began
  double time_ = 0, dt_ = 0;
};

}  // namespace standalone
