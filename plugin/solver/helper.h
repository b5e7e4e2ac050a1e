/// Helpers of a Newton solver, and the one interface through which it is driven.
///
/// A helper has one switch. It is called at the phases of a step and acts on the solver; it knows nothing of the rest
/// of the model.
#pragma once

#include "archive.h"
#include "devices.h"
#include "solver.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace newton {

class Helper {
 public:
  Helper() = default;
  Helper(const Helper&) = delete;
  Helper& operator=(const Helper&) = delete;
  Helper(Helper&&) = delete;
  Helper& operator=(Helper&&) = delete;
  virtual ~Helper() = default;

  /// The reason why the helper is not available in this model, as the end of a sentence; empty if it is.
  virtual std::string unavailable() const { return {}; }

  /// A time step begins, or an attempt at one. Returns whether the helper acts.
  virtual bool begin_step() { return false; }
  /// Iterations begin: at the start of a step, and after an augmentation.
  virtual void begin_iterations() {}
  /// A trial increment has been set.
  virtual void try_increment(const std::vector<double>& /*increment*/) {}
  /// Acts at an accepted state within iterations. Returns whether the model is to be evaluated again.
  virtual bool adapt() { return false; }
  /// Acts at an accepted state whose residual the solver has not evaluated. Returns whether to evaluate the model
  /// again.
  virtual bool adapt_before_residual() { return false; }

  /// Whether the solver must continue after convergence, for a reason that needs no change of the state.
  virtual bool is_settled() const { return true; }
  /// Decides on a converged state: returns whether the solver must continue, and prepares this.
  virtual bool rejects() { return false; }

  /// Acts before the first matrix of a step: moves the model to a predicted state, and calls `arrived` there. Returns
  /// whether it has; if not, the state has not changed.
  virtual bool predict(const std::function<void()>& /*arrived*/) { return false; }
  /// Acts with the first matrix of a step.
  virtual void complete_residual() {}
  /// Whether the helper multiplies changes of nodal values by the matrix, which must then have no loads as unknowns.
  virtual bool multiplies_by_matrix() const { return false; }

  /// A time step has been solved.
  virtual void end_step() {}
  /// An attempt at a step has failed; the state is that of its start.
  virtual void rewind() {}
  /// Iterations begin without this helper: it restores the solver and its model.
  virtual void let_go() {}

  /// Whether the helper holds a nodal value and yields it.
  virtual bool holds(Place /*place*/) const { return false; }
  virtual void yield(Place /*place*/) {}

  /// State for a restart.
  virtual void archive(Archive& /*archive*/) {}
};

/// The helpers of a model. A helper that is off takes part in restarts alone, and stops at the start of iterations.
class Helpers {
 public:
  /// None.
  Helpers() = default;
  explicit Helpers(Solver& solver) : solver_(&solver) {}

  /// Switches that can change from step to step.
  using Switch = std::function<bool()>;
  /// Adds a device, by which it is known here. `record` counts where it acts, and is kept as a reference.
  void add(Device device, std::unique_ptr<Helper> helper, Switch is_on, DeviceRecord& record);
  /// Adds a helper that is no device.
  void add(std::unique_ptr<Helper> helper, Switch is_on);
  /// The text of Helper::unavailable() of one.
  std::string unavailable(Device device) const;

  void begin_step();
  void begin_iterations();
  void try_increment(const std::vector<double>& increment);
  bool adapt();
  bool adapt_before_residual();
  bool are_settled();
  bool reject();
  bool predict(const std::function<void()>& arrived);
  void complete_residual();
  bool multiply_by_matrix() const;
  void end_step();
  void rewind();
  /// Makes the helper that holds a nodal value, if there is one, keep it (`keep`) or yield it. Returns whether the
  /// helper keeps the value.
  bool keeps(Place place, bool keep);
  void archive(Archive& archive);

 private:
  struct Switched {
    std::unique_ptr<Helper> helper;
    Switch is_on;
    std::optional<Device> device;
    DeviceRecord* record = nullptr;  ///< of a device

    /// Notes that a device has acted.
    void count() const;
  };
  /// Calls `use` with each helper and its switch, where the solver is one of Newton's kind.
  template <class Use>
  void for_each_switched(const Use& use) const;
  /// Calls `use` with each helper that is on.
  template <class Use>
  void for_each(const Use& use) const;
  /// Whether any helper that is on answers yes; stops at the first one.
  template <class Ask>
  bool any(const Ask& ask) const;
  /// Whether any helper that is on answers yes and so acts, which its device counts; stops at the first one.
  template <class Ask>
  bool any_acts(const Ask& ask);

  Solver* solver_ = nullptr;
  std::vector<Switched> helpers_;
};

}  // namespace newton
