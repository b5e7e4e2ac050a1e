#include "analysis.h"

#include "host/reducible_penalties.h"
#include "newton.h"
#include "output.h"
#include "time_stepper.h"

#include <algorithm>
#include <chrono>
#include <set>

namespace standalone {
namespace {

void log_summary(const Log& log, int steps, const Effort& total, bool done, double seconds) {
  log.print("\n\n N O N L I N E A R   I T E R A T I O N   I N F O R M A T I O N\n\n");
  log.print("\tNumber of time steps completed .................... : %d\n\n", steps);
  log.print("\tTotal number of equilibrium iterations ............ : %d\n\n", total.iterations);
  log.print("\tTotal number of right hand evaluations ............ : %d\n\n", total.residuals);
  log.print("\tTotal number of stiffness reformations ............ : %d\n\n", total.reformations);
  log.print("\n Elapsed time : %.2f s\n\n", seconds);
  log.print("\n %s\n\n", done ? "N O R M A L   T E R M I N A T I O N" : "E R R O R   T E R M I N A T I O N");
}

/// True if a concentration is negative by more than a fraction of the largest one that rounding may cause.
bool has_negative_concentration(const MatrixXd& values) {
  constexpr double negligible = 1e-6;
  const auto concentrations = values.bottomRows(values.rows() - concentration_dof(0));
  return concentrations.size() > 0 && concentrations.minCoeff() < -negligible * concentrations.maxCoeff();
}

/// The time steps of an analysis.
class Steps {
 public:
  Steps(const Model& model, Log& log)
      : log_(log), problem_(model), newton_(problem_, log), output_(model), stepper_(model, log) {}

  bool run() {
    for (const Contact& contact : problem_.contacts()) log_.print("%s\n", contact.effects_line().c_str());
    for (const TiedContact& tie : problem_.ties()) {
      for (const std::string& line : tie.lines()) log_.print("%s\n", line.c_str());
    }
    output_.write(problem_, 0, 0);
    newton_.begin();  // sets the ambient values for the first step
    const double end = problem_.model().control.end;
    const double near = end * 1e-7;
    while (end - time_ > near) {
      if (time_ + stepper_.increment() <= time_) {
        log_.box("ERROR", "The time step has become too small for the time to advance.");
        return false;
      }
      const double to = std::min(time_ + stepper_.increment(), end);
      if (!step(to)) {
        if (!stepper_.retry(log_)) return false;
        reduce_penalties(to, to - time_);
      } else if (time_ + near < end) {
        stepper_.advance(time_, newton_.effort().iterations, log_);
      }
    }
    return true;
  }

  /// Logs the summary at the end of a run.
  void end() const { say(reducible_.summary()); }

  int done() const { return done_; }
  const Effort& total() const { return total_; }

 private:
  /// Solves one step to `time`. If it fails, the state at its start is restored, and the result is false.
  bool step(double time) {
    log_.print("\n===== beginning time step %d : %g =====\n\n", done_ + 1, time);
    const Problem::State before = problem_.save();
    problem_.reduce_penalties(reducible_.at(time - time_));
    try {
      newton_.solve_step(time, time - time_);
    } catch (const StepFailure& failure) {
      log_.box("ERROR", failure.what());
      log_.print("\n\n------- failed to converge at time : %g\n\n", time);
      total_ += newton_.effort();
      problem_.restore(before);
      newton_.rewind();
      return false;
    }
    total_ += newton_.effort();
    if (problem_.model().control.expects_positive && has_negative_concentration(problem_.values())) {
      log_.box("WARNING",
               "Concentrations are negative, as the elements are too large for the time step. FEBio's solver would set "
               "them to zero; mixture-contact leaves them as they are.");
    }
    log_.print("\n------- converged at time : %g\n\n", time);
    warn_of_overlap();
    note_overlap(time);
    time_ = time;
    output_.write(problem_, ++done_, time);
    stepper_.succeeded();
    return true;
  }

  void say(const std::string& line) const {
    if (!line.empty()) log_.print("\n%s\n", line.c_str());
  }

  void reduce_penalties(double time, double dt) {
    const std::vector<Contact>& contacts = problem_.contacts();
    const auto is_reducible = [](const Contact& contact) { return contact.has_reducible_penalty(); };
    if (std::none_of(contacts.begin(), contacts.end(), is_reducible)) return;
    say(reducible_.fail(time, dt));
  }

  void note_overlap(double time) {
    for (const Contact& contact : problem_.contacts()) {
      if (!reducible_.are_reduced() || !contact.has_reducible_penalty()) continue;
      const mixture_contact::Overlap overlap = largest_overlap(contact.core(), contact.fields(problem_.values()));
      reducible_.note(contact.definition().name, overlap, time);
    }
    reducible_.accept();
  }

  void warn_of_overlap() {
    for (const Contact& contact : problem_.contacts()) {
      if (warned_.count(&contact) > 0) continue;
      const mixture_contact::UndetectedPenetration& overlap = contact.core().undetected_penetration();
      if (overlap.nodes == 0) continue;
      warned_.insert(&contact);
      const auto& surfaces = contact.definition().surfaces;
      log_.box("WARNING", overlap_warning(contact.definition().name, surfaces.front(), surfaces.back(), overlap));
    }
  }

  Log& log_;
  Problem problem_;
  Newton newton_;
  Output output_;
  TimeStepper stepper_;
  ReduciblePenalties reducible_;
  double time_ = 0;
  int done_ = 0;
  Effort total_;
  std::set<const Contact*> warned_;  ///< contacts whose overlap has been reported
};

}  // namespace

bool run(const Model& model, Log& log) {
  const auto start = std::chrono::steady_clock::now();
  for (const std::string& notice : model.notices) log.print("Note: %s\n", notice.c_str());
  Steps steps(model, log);
  const bool done = steps.run();
  steps.end();
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  log_summary(log, steps.done(), steps.total(), done, seconds.count());
  return done;
}

}  // namespace standalone
