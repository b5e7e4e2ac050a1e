/// Helpers of a Newton solver, and the interface through which they are called.
///
/// Each helper has one switch. It is called at the phases of a step and acts on the solver. It does not depend on the
/// rest of the model.
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

/// A helper of a Newton solver. The functions are called at the phases of a step, with the solver; by default they do
/// nothing.
class Helper {
 public:
  Helper() = default;
  Helper(const Helper&) = delete;
  Helper& operator=(const Helper&) = delete;
  Helper(Helper&&) = delete;
  Helper& operator=(Helper&&) = delete;
  virtual ~Helper() = default;

  /// The reason why the helper is not available in this model, as the end of a sentence; empty if it is available.
  virtual std::string unavailable(const Solver& /*solver*/) const { return {}; }

  /// A time step, or an attempt at one, begins. Returns true if the helper acts.
  virtual bool begin_step(Solver& /*solver*/) { return false; }
  /// Iterations begin: at the start of a step, or after an augmentation.
  virtual void begin_iterations(Solver& /*solver*/) {}
  /// A trial increment has been set.
  virtual void try_increment(Solver& /*solver*/, const std::vector<double>& /*increment*/) {}
  /// Acts at an accepted state within iterations. Returns true if the model has to be evaluated again.
  virtual bool adapt(Solver& /*solver*/) { return false; }
  /// Acts at an accepted state for which the solver has not evaluated the residual. Returns true if the model has to be
  /// evaluated again.
  virtual bool adapt_before_residual(Solver& /*solver*/) { return false; }

  /// True if, after convergence, the helper does not require further iterations at an unchanged state.
  virtual bool is_settled(Solver& /*solver*/) const { return true; }
  /// Decides on a converged state. Returns true if the solver has to continue, which the helper has then prepared.
  virtual bool rejects(Solver& /*solver*/) { return false; }

  /// Acts before the first matrix of a step: moves the model to a predicted state, and calls `arrived` there. Returns
  /// true if it did; otherwise the state is unchanged.
  virtual bool predict(Solver& /*solver*/, const std::function<void()>& /*arrived*/) { return false; }
  /// Changes the residual of the first iteration of a step, after its matrix has been assembled.
  virtual void complete_residual(Solver& /*solver*/) {}
  /// True if the helper multiplies changes of nodal values by the matrix, which must then have no loads as unknowns.
  virtual bool multiplies_by_matrix() const { return false; }

  /// A time step has been solved.
  virtual void end_step(Solver& /*solver*/) {}
  /// An attempt at a step has failed, and the state at its start has been restored.
  virtual void rewind(Solver& /*solver*/) {}
  /// Iterations begin while this helper is switched off: it has to restore the solver and the model.
  virtual void let_go(Solver& /*solver*/) {}

  /// True if the helper prescribes a nodal value.
  virtual bool holds(Place /*place*/) const { return false; }
  /// Frees a nodal value that the helper prescribes.
  virtual void yield(Place /*place*/) {}

  /// Stores or reads the helper's state for a restart.
  virtual void archive(Archive& /*archive*/) {}
};

/// The helpers of a model. A helper that is switched off takes part only in restarts, after a call of let_go() at the
/// start of iterations.
class Helpers {
 public:
  /// No helpers.
  Helpers() = default;
  /// Helpers of this solver.
  explicit Helpers(Solver& solver) : solver_(&solver) {}

  /// A switch, whose result may change from step to step.
  using Switch = std::function<bool()>;
  /// Adds the helper of a device. `record`: counts its actions; a reference to it is kept.
  void add(Device device, std::unique_ptr<Helper> helper, Switch is_on, DeviceRecord& record);
  /// Adds a helper that is not a device.
  void add(std::unique_ptr<Helper> helper, Switch is_on);
  /// The result of Helper::unavailable() for a device.
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
  /// The fraction of the residual that the last iteration has left; infinite without a Newton solver [-].
  double residual_left() const;
  void end_step();
  void rewind();
  /// Asks the helper that prescribes a nodal value, if any, to keep it (`keep`) or to free it. Returns true if the
  /// helper keeps the value.
  bool keeps(Place place, bool keep);
  void archive(Archive& archive);

 private:
  /// A helper with its switch.
  struct Switched {
    std::unique_ptr<Helper> helper;
    Switch is_on;
    std::optional<Device> device;
    DeviceRecord* record = nullptr;  ///< record of a device; null for other helpers

    /// Counts an action of the device.
    void count() const;
  };
  /// Calls `use` with each helper and its switch, if the present step is solved by Newton's method.
  template <class Use>
  void for_each_switched(const Use& use) const;
  /// Calls `use` with each helper that is on.
  template <class Use>
  void for_each(const Use& use) const;
  /// True if `ask` is true for a helper that is on; later helpers are not asked.
  template <class Ask>
  bool any(const Ask& ask) const;
  /// True if `ask` is true for a helper that is on, whose action is then counted; later helpers are not asked.
  template <class Ask>
  bool any_acts(const Ask& ask);

  Solver* solver_ = nullptr;
  std::vector<Switched> helpers_;
};

}  // namespace newton
