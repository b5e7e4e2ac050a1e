// Tests with a fake host that makes FEBio's calls in FEBio's order, and contacts that record the calls.
#include "host/contact_steps.h"

#include "fake_solver.h"

#include <boost/test/unit_test.hpp>

#include <memory>
#include <set>
#include <stdexcept>
#include <string>

using mixture_contact::Changed;
using mixture_contact::ContactSteps;
using mixture_contact::GoesOn;
using mixture_contact::MatrixUse;
using mixture_contact::SteppedContact;
using mixture_contact::SteppedModel;

namespace {

using Notes = std::vector<std::string>;

class FakeContact : public SteppedContact {
 public:
  FakeContact(std::string name, Notes& notes) : name_(std::move(name)), notes_(notes) {}
  mixture_contact::ContactInterface& core() const override { throw std::logic_error("a fake has no core"); }
  mixture_contact::PerSide<mixture_contact::SurfaceFields> fields() const override { return {}; }
  void project() override {}
  void prepare_step() override { note("prepare"); }
  void end_iterations() override { note("end"); }
  bool begin_iteration() override {
    note("begin");
    return loads_change;
  }
  void hold_loads() override { note("hold"); }
  void linearise_at() override { note("move"); }
  bool keeps_matrix() override { return serves; }
  bool correct() override {
    note("correct");
    return loads_change;
  }
  bool is_solution() override { return solution; }
  bool reconsiders_edge() override { return std::exchange(at_edge, false); }
  bool finds_overlap() override { return overlap; }

  bool loads_change = false;
  bool serves = true;
  bool solution = true;
  bool at_edge = false;
  bool overlap = false;

 protected:
  void report(const mixture_contact::UndetectedPenetration& /*undetected*/) override {}

 private:
  void note(const std::string& what) { notes_.push_back(name_ + " " + what); }

  std::string name_;
  Notes& notes_;
};

/// A helper that predicts, or only reports that it does.
class FakeHelper : public newton::Helper {
 public:
  explicit FakeHelper(Notes& notes) : notes_(notes) {}
  bool begin_step(newton::Solver& /*solver*/) override {
    notes_.emplace_back("helper step");
    return false;
  }
  void begin_iterations(newton::Solver& /*solver*/) override { notes_.emplace_back("helper iterations"); }
  void try_increment(newton::Solver& /*solver*/, const std::vector<double>& /*increment*/) override {
    notes_.emplace_back("helper trial");
  }
  bool adapt(newton::Solver& /*solver*/) override {
    notes_.emplace_back("helper adapt");
    return false;
  }
  bool rejects(newton::Solver& /*solver*/) override { return std::exchange(too_short, false); }
  bool multiplies_by_matrix() const override { return multiplies; }
  bool predict(newton::Solver& /*solver*/, const std::function<void()>& arrived) override {
    if (on_prediction) on_prediction();
    if (predicted) arrived();
    return predicted;
  }
  void complete_residual(newton::Solver& /*solver*/) override { notes_.emplace_back("helper residual"); }
  void rewind(newton::Solver& /*solver*/) override { notes_.emplace_back("helper rewind"); }

  bool too_short = false;
  bool predicted = false;
  bool multiplies = false;
  std::function<void()> on_prediction;

 private:
  Notes& notes_;
};

struct TooManyRejections : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class FakeHost : public SteppedModel {
 public:
  explicit FakeHost(int count, MatrixUse use = MatrixUse::each_iteration)
      : matrices(use), steps(*this, newton::Helpers(solver_)) {
    auto made = std::make_unique<FakeHelper>(notes);
    helper = made.get();
    steps.helpers().add(std::move(made), [] { return true; });
    for (int n = 0; n < count; ++n) {
      contacts.push_back(std::make_unique<FakeContact>(std::string(1, char('A' + n)), notes));
      is_active.push_back(true);
    }
  }

  // FEBio's calls, made for each active contact.
  void update_model() {
    for (SteppedContact* contact : active_contacts()) steps.evaluate(contact);
  }
  void start_step() {
    update_model();
    for (SteppedContact* contact : active_contacts()) steps.prepare_step(contact);
    form_matrix();
  }
  void form_matrix() {
    for (std::size_t n = 0; n < active_contacts().size(); ++n) steps.before_matrix();
    steps.matrix_formed();
  }
  /// Performs an iteration with the present matrix.
  void iterate() {
    update(1.0);
    steps.end_iteration();
  }
  void update(double increment) {
    for (SteppedContact* contact : active_contacts()) steps.try_increment(contact, {increment});
    update_model();
  }
  /// Returns the answer that all contacts get, which has to be the same.
  bool are_accepted() {
    std::set<bool> answers;
    for (SteppedContact* contact : active_contacts()) answers.insert(steps.accepts(contact));
    BOOST_TEST(answers.size() == 1U);
    return *answers.begin();
  }
  /// Returns true if the step has been solved.
  bool augment() {
    const bool accepted = are_accepted();
    if (!accepted) {
      update_model();
      form_matrix_without_callback();
    }
    return accepted;
  }
  /// The function augment() for a host that keeps its matrix.
  bool augment_with_the_matrix_kept() {
    const bool accepted = are_accepted();
    if (!accepted) update_model();
    steps.end_iteration();
    return accepted;
  }
  void form_matrix_without_callback() {
    for (std::size_t n = 0; n < active_contacts().size(); ++n) steps.before_matrix();
  }

  std::vector<SteppedContact*> active_contacts() override {
    std::vector<SteppedContact*> active;
    for (std::size_t n = 0; n < contacts.size(); ++n) {
      if (is_active[n]) active.push_back(contacts[n].get());
    }
    return active;
  }
  bool replaces_matrix() override {
    if (!is_spent) return false;
    notes.emplace_back("matrix at once");
    form_matrix();
    return true;
  }
  bool apply_ambient() override {
    notes.emplace_back("ambient");
    return ambient_changes;
  }
  void evaluate() override {
    notes.emplace_back("model");
    update_model();
  }
  void evaluate_bodies_after_contacts() override { notes.emplace_back("bodies"); }
  void evaluate_residual(Changed what) override {
    notes.emplace_back(what == Changed::loads ? "change of residual" : "residual");
  }
  void correct_residual() override { notes.emplace_back("correction of residual"); }
  MatrixUse matrix_use() override { return matrices; }
  bool is_matrix_due() override { return is_due; }
  void request_matrix(bool is_needed) override {
    if (is_needed) notes.emplace_back("matrix please");
  }
  void accepted() override {}
  void rejected(int n, GoesOn with) override {
    if (n > 2) throw TooManyRejections("too many");
    if (with == GoesOn::correction) notes.emplace_back("no matrix");
  }

  Notes said() { return std::exchange(notes, {}); }

  Notes notes;
  std::vector<std::unique_ptr<FakeContact>> contacts;
  std::vector<bool> is_active;
  FakeHelper* helper = nullptr;
  bool ambient_changes = false;
  MatrixUse matrices;
  bool is_due = false;
  bool is_spent = false;

 private:
  FakeSolver solver_;

 public:
  ContactSteps steps;
};

/// Performs the first iteration of a step, after which the loads of the last contact are not those of a solution.
void converge_with_loads_off(FakeHost& host) {
  host.start_step();
  host.update(1.0);
  host.contacts.back()->solution = false;
  host.contacts.back()->loads_change = true;
}

void check(const Notes& actual, const Notes& expected) {
  BOOST_CHECK_EQUAL_COLLECTIONS(actual.begin(), actual.end(), expected.begin(), expected.end());
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_step_starts_with_one_iteration_of_all_contacts) {
  FakeHost host(2);
  host.start_step();
  check(host.said(), {"A end", "B end", "helper iterations", "A begin", "B begin", "ambient", "helper step",
                      "A prepare", "B prepare", "helper residual"});
}

BOOST_AUTO_TEST_CASE(bodies_are_evaluated_after_contacts_where_the_start_changes_values_that_they_depend_on) {
  for (const bool ambient : {false, true}) {
    FakeHost host(1);
    host.ambient_changes = ambient;
    host.contacts[0]->loads_change = true;
    host.update_model();
    BOOST_TEST((host.said().back() == "bodies") == ambient);
  }
}

BOOST_AUTO_TEST_CASE(trials_and_line_searches_hold_everything) {
  FakeHost host(2);
  host.start_step();
  host.said();
  host.update(1.0);
  host.update(0.5);
  check(host.said(), {"helper trial", "helper trial"});
}

BOOST_AUTO_TEST_CASE(the_next_matrix_begins_an_iteration_once) {
  FakeHost host(2);
  host.start_step();
  host.update(1.0);
  host.said();
  host.form_matrix();
  check(host.said(), {"A begin", "B begin", "ambient", "helper adapt", "helper residual"});
}

BOOST_AUTO_TEST_CASE(loads_that_change_at_a_matrix_change_the_residual_and_no_body) {
  FakeHost host(2);
  host.start_step();
  host.update(1.0);
  host.contacts[1]->loads_change = true;
  host.said();
  host.form_matrix();
  check(host.said(), {"A begin", "B begin", "ambient", "helper adapt", "helper residual", "change of residual"});
}

BOOST_AUTO_TEST_CASE(values_that_change_at_a_matrix_are_evaluated_with_what_is_held_and_then_the_residual) {
  FakeHost host(2);
  host.start_step();
  host.update(1.0);
  host.ambient_changes = true;
  host.said();
  host.form_matrix();
  check(host.said(), {"A begin", "B begin", "ambient", "helper adapt", "model", "helper residual", "residual"});
}

BOOST_AUTO_TEST_CASE(quasi_newton_methods_get_a_matrix_where_the_active_set_must_change) {
  FakeHost host(2, MatrixUse::kept);
  host.start_step();
  host.said();
  host.update(1.0);
  check(host.said(), {"helper trial"});
  host.contacts[1]->serves = false;
  host.update(1.0);
  check(host.said(), {"helper trial", "matrix please"});
  host.form_matrix();
  host.said();
  host.steps.end_iteration();  // the iteration has begun with the matrix
  check(host.said(), {});
}

BOOST_AUTO_TEST_CASE(a_matrix_that_leaves_too_much_of_the_residual_is_replaced_at_once) {
  FakeHost host(1, MatrixUse::kept);
  host.start_step();
  host.update(1.0);
  host.is_spent = true;
  host.said();
  host.steps.end_iteration();
  check(host.said(), {"matrix at once", "A begin", "ambient", "helper adapt", "helper residual"});
  host.steps.end_iteration();  // the iteration has begun with the matrix
  check(host.said(), {});
}

BOOST_AUTO_TEST_CASE(with_a_matrix_that_is_kept_linearisations_are_corrected_in_each_iteration) {
  FakeHost host(2, MatrixUse::kept);
  host.start_step();
  host.said();
  host.iterate();
  check(host.said(), {"helper trial", "A correct", "B correct"});
  host.contacts[1]->loads_change = true;
  host.iterate();
  check(host.said(), {"helper trial", "A correct", "B correct", "correction of residual"});
}

BOOST_AUTO_TEST_CASE(the_hosts_limit_on_iterations_with_one_matrix_holds) {
  FakeHost host(1, MatrixUse::kept);
  host.start_step();
  host.is_due = true;
  host.said();
  host.update(1.0);
  check(host.said(), {"helper trial", "matrix please"});
}

BOOST_AUTO_TEST_CASE(a_state_whose_loads_are_off_alone_is_rejected_without_a_matrix) {
  FakeHost host(2, MatrixUse::kept);
  converge_with_loads_off(host);
  host.said();
  BOOST_TEST(!host.augment_with_the_matrix_kept());
  check(host.said(), {"no matrix", "A correct", "B correct", "correction of residual"});
  host.update(1.0);
  host.contacts[1]->serves = false;
  host.said();
  BOOST_TEST(!host.augment());
  check(host.said(), {"A begin", "B begin", "ambient", "helper adapt"});
}

BOOST_AUTO_TEST_CASE(a_solution_whose_edge_is_tried_once_more_is_rejected_and_gets_a_matrix) {
  FakeHost host(2, MatrixUse::kept);
  host.start_step();
  host.update(1.0);
  host.contacts[0]->at_edge = true;
  host.said();
  BOOST_TEST(!host.augment());
  check(host.said(), {"A begin", "B begin", "ambient", "helper adapt"});
  host.update(1.0);
  BOOST_TEST(host.augment());
}

BOOST_AUTO_TEST_CASE(a_matrix_that_is_formed_all_the_same_has_a_residual_of_its_loads) {
  FakeHost host(1, MatrixUse::kept);
  converge_with_loads_off(host);
  BOOST_TEST(!host.steps.accepts(host.contacts[0].get()));
  host.update_model();
  host.said();
  host.form_matrix_without_callback();
  host.steps.end_iteration();
  check(host.said(), {"A begin", "ambient", "helper adapt", "change of residual"});
}

BOOST_AUTO_TEST_CASE(full_newton_begins_iterations_with_matrices_alone) {
  FakeHost host(1);
  host.start_step();
  host.said();
  host.iterate();
  check(host.said(), {"helper trial"});
}

BOOST_AUTO_TEST_CASE(without_any_matrix_each_trial_is_of_the_true_laws_and_nothing_is_linearised) {
  FakeHost host(1, MatrixUse::none);
  host.start_step();
  host.said();
  host.update(1.0);
  check(host.said(), {"helper trial", "A end", "helper iterations", "A hold", "ambient"});
}

BOOST_AUTO_TEST_CASE(full_newton_asks_for_no_matrix) {
  FakeHost host(1);
  host.start_step();
  host.contacts[0]->serves = false;
  host.said();
  host.update(1.0);
  check(host.said(), {"helper trial"});
}

BOOST_AUTO_TEST_CASE(a_solution_is_accepted_and_what_follows_begins_anew) {
  FakeHost host(2);
  host.start_step();
  host.update(1.0);
  BOOST_TEST(host.augment());
  host.said();
  host.update_model();  // an augmentation, or the next step
  check(host.said(), {"A end", "B end", "helper iterations", "A begin", "B begin", "ambient"});
}

BOOST_AUTO_TEST_CASE(one_contact_that_is_not_solved_has_all_go_on) {
  FakeHost host(2);
  host.start_step();
  host.update(1.0);
  host.contacts[1]->solution = false;
  host.said();
  BOOST_TEST(!host.augment());
  check(host.said(), {"A begin", "B begin", "ambient", "helper adapt"});
  host.contacts[1]->solution = true;
  host.update(1.0);
  BOOST_TEST(host.augment());
}

BOOST_AUTO_TEST_CASE(overlaps_and_helpers_reject_too) {
  FakeHost host(2);
  host.start_step();
  host.update(1.0);
  host.contacts[0]->overlap = true;
  BOOST_TEST(!host.augment());
  host.contacts[0]->overlap = false;
  host.helper->too_short = true;
  host.update(1.0);
  BOOST_TEST(!host.augment());
  host.update(1.0);
  BOOST_TEST(host.augment());
}

BOOST_AUTO_TEST_CASE(rejections_are_limited_in_each_step) {
  FakeHost host(2);
  host.start_step();
  host.contacts[0]->solution = false;
  for (int n = 0; n < 2; ++n) {
    host.update(1.0);
    BOOST_TEST(!host.augment());
  }
  host.update(1.0);
  BOOST_CHECK_THROW(host.augment(), TooManyRejections);
  host.steps.rewind();
  host.start_step();
  host.update(1.0);
  BOOST_TEST(!host.augment());
}

BOOST_AUTO_TEST_CASE(a_cutback_within_a_round_leaves_nothing_behind) {
  FakeHost host(2);
  host.start_step();
  host.steps.try_increment(host.contacts[0].get(), {1.0});  // an element inverts before the second contact is notified
  host.steps.rewind();
  host.said();
  host.start_step();
  check(host.said(), {"A end", "B end", "helper iterations", "A begin", "B begin", "ambient", "helper step",
                      "A prepare", "B prepare", "helper residual"});
}

BOOST_AUTO_TEST_CASE(a_cutback_is_told_to_helpers_and_a_restart_is_not) {
  FakeHost host(1);
  host.start_step();
  host.said();
  host.steps.restart();
  check(host.said(), {});
  host.steps.rewind();
  check(host.said(), {"helper rewind"});
}

BOOST_AUTO_TEST_CASE(contacts_come_and_go_with_steps_of_the_analysis) {
  FakeHost host(2);
  host.is_active[0] = false;
  host.steps.reset_rounds();
  host.start_step();
  check(host.said(),
        {"B end", "helper iterations", "B begin", "ambient", "helper step", "B prepare", "helper residual"});
  host.update(1.0);
  BOOST_TEST(host.augment());
  host.is_active[0] = true;
  host.said();
  host.steps.activate(*host.contacts[0]);
  check(host.said(), {"A end", "A begin"});
  host.start_step();
  BOOST_TEST(host.said().front() == "A end");
  host.is_active[1] = false;
  host.steps.reset_rounds();
  host.update(1.0);
  BOOST_TEST(host.augment());
}

BOOST_AUTO_TEST_CASE(a_predicted_state_moves_what_the_contacts_hold) {
  FakeHost host(2);
  host.helper->predicted = true;
  host.helper->on_prediction = [&] { host.update(1.0); };
  host.start_step();
  const Notes notes = host.said();
  check(Notes(notes.end() - 5, notes.end()), {"helper trial", "A move", "B move", "ambient", "helper residual"});
}

BOOST_AUTO_TEST_CASE(after_a_dropped_prediction_the_step_starts_plainly) {
  FakeHost host(2);
  host.helper->on_prediction = [&] {
    host.update(1.0);
    host.steps.rewind();  // the state is restored
  };
  host.start_step();
  const Notes notes = host.said();
  check(Notes(notes.end() - 8, notes.end()),
        {"model", "A end", "B end", "helper iterations", "A begin", "B begin", "ambient", "helper residual"});
  host.update(1.0);
  BOOST_TEST(host.augment());
}

BOOST_AUTO_TEST_CASE(matrices_have_no_further_unknowns_where_a_helper_multiplies_by_them) {
  FakeHost host(1);
  BOOST_TEST(host.steps.allow_further_unknowns());
  host.helper->multiplies = true;
  BOOST_TEST(!host.steps.allow_further_unknowns());
}
