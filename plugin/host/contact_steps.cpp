#include "contact_steps.h"

#include "contact/interface/corrections.h"

#include <algorithm>
#include <utility>

namespace mixture_contact {

bool SteppedContact::keeps_matrix() { return serves_again(core(), fields()); }
bool SteppedContact::correct() { return mixture_contact::correct(core(), fields()); }

bool SteppedContact::finds_overlap() {
  const UndetectedPenetration undetected = core().check_penetration(fields());
  if (undetected.nodes == 0) return false;
  if (!std::exchange(said_overlap_, true)) report(undetected);
  return !is_solution();
}

void ContactSteps::activate(SteppedContact& contact) {
  reset_rounds();
  contact.project();
  contact.end_iterations();
  contact.begin_iteration();
  contact.note_beginning();
}

void ContactSteps::reset_rounds() {
  for (Round* const round : {&evaluations_, &trials_, &preparations_, &convergences_}) round->reset();
}

bool ContactSteps::prepare_step(const void* told) {
  if (!preparations_.opens(told)) return false;
  stepper_.prepare_step();
  helpers_.begin_step();
  for (SteppedContact* contact : model_.active_contacts()) contact->prepare_step();
  return true;
}

Changed ContactSteps::Changes::kind() const {
  if (values) return Changed::all;
  return loads ? Changed::loads : Changed::nothing;
}

/// Decides which nodes are in contact at this state, and which have ambient values.
ContactSteps::Changes ContactSteps::begin_iteration() {
  bool loads = false;
  for (SteppedContact* contact : model_.active_contacts()) {
    if (linearises()) {
      loads = contact->begin_iteration() || loads;
    } else {
      contact->hold_loads();
    }
  }
  return {loads, model_.apply_ambient()};
}

void ContactSteps::evaluate(const void* told) {
  if (!evaluations_.opens(told)) return;
  const std::vector<SteppedContact*> contacts = model_.active_contacts();
  for (SteppedContact* contact : contacts) contact->project();
  bool changed = false;
  switch (stepper_.evaluate()) {
    case Stepper::Evaluation::keep_active_set:
      // The active set can change only with a new matrix, or with a corrected linearisation. If the matrix of a
      // quasi-Newton method permits no correction, a new matrix is requested.
      if (model_.matrix_use() == MatrixUse::kept) model_.request_matrix(!keeps_matrix());
      return;
    case Stepper::Evaluation::begin_anew:
      for (SteppedContact* contact : contacts) contact->end_iterations();
      helpers_.begin_iterations();
      changed = begin_iteration().values;
      for (SteppedContact* contact : contacts) {
        if (linearises()) contact->note_beginning();
      }
      break;
    case Stepper::Evaluation::go_on:
      changed = begin_iteration().values;
      changed = helpers_.adapt() || changed;
      break;
    case Stepper::Evaluation::keep_linearisation:
      return;
  }
  if (changed) model_.evaluate_bodies_after_contacts();
}

void ContactSteps::try_increment(const void* told, const std::vector<double>& increment) {
  if (!trials_.opens(told)) return;
  // A method without matrices begins no iteration at an accepted state: each evaluation uses the true laws.
  if (linearises()) stepper_.try_state();
  for (SteppedContact* contact : model_.active_contacts()) contact->project();
  helpers_.try_increment(increment);
}

/// Evaluates the model with the present linearisation.
void ContactSteps::evaluate_again() {
  stepper_.try_state();
  model_.evaluate();
}

void ContactSteps::start_at_prediction() {
  const auto arrived = [&] {
    if (helpers_.adapt_before_residual()) evaluate_again();
  };
  if (helpers_.predict(arrived)) {
    for (SteppedContact* contact : model_.active_contacts()) contact->linearise_at();
    if (model_.apply_ambient()) evaluate_again();
  } else if (!has_begun()) {
    model_.evaluate();  // a rejected prediction: evaluate the start without prediction again
  }
}

/// Breaks bonds that would break at a solution near the state after an iteration.
bool ContactSteps::breaks_bonds() {
  bool any = false;
  for (SteppedContact* contact : model_.active_contacts()) {
    // The next iteration changes loads by about the same fraction of the last change that is left of the residual. If
    // later ones do as well, and the fraction is below a half, the sum of all changes is at most twice as large.
    if (contact->has_bonds()) any = contact->breaks_bonds(2 * helpers_.residual_left()) || any;
  }
  return any;
}

void ContactSteps::before_matrix() {
  // At the start of a step and after an augmentation, an evaluation has begun the iteration, and the host's residual is
  // valid. Otherwise, the host accepts a state with a residual from before the change of the loads; the residual is
  // evaluated again after the matrix has been assembled. Bodies depend on nodal values only.
  Changes changes{false, false};
  switch (stepper_.before_matrix()) {
    case Stepper::Matrix::predict:
      start_at_prediction();
      break;
    case Stepper::Matrix::nothing:
      break;
    case Stepper::Matrix::begin:
      if (breaks_bonds()) {
        stepper_.accept();
        model_.evaluate();
        changes.values = true;
        break;
      }
      changes = begin_iteration();
      changes.values = helpers_.adapt() || changes.values;
      if (changes.values) evaluate_again();
      break;
    case Stepper::Matrix::is_formed:
      return;
  }
  stepper_.form_matrix(changes.kind());
}

void ContactSteps::matrix_formed() {
  helpers_.complete_residual();
  bring_residual_up_to_date();
}

void ContactSteps::bring_residual_up_to_date() {
  const Changed changed = stepper_.matrix_formed();
  if (changed != Changed::nothing) model_.evaluate_residual(changed);
}

void ContactSteps::end_iteration() {
  bring_residual_up_to_date();  // hosts do not announce matrices after augmentations
  if (model_.matrix_use() != MatrixUse::kept) return;
  if (stepper_.phase() == Phase::evaluated && model_.replaces_matrix()) return;
  if (!stepper_.keep_matrix()) return;
  bool changed = false;
  for (SteppedContact* contact : model_.active_contacts()) changed = contact->correct() || changed;
  if (changed) model_.correct_residual();
}

bool ContactSteps::keeps_matrix() {
  const std::vector<SteppedContact*> contacts = model_.active_contacts();
  return !model_.is_matrix_due() &&
         std::all_of(contacts.begin(), contacts.end(), [](SteppedContact* contact) { return contact->keeps_matrix(); });
}

bool ContactSteps::is_solution() {
  const std::vector<SteppedContact*> contacts = model_.active_contacts();
  return std::all_of(contacts.begin(), contacts.end(), [](SteppedContact* contact) { return contact->is_solution(); });
}

bool ContactSteps::accepts(const void* told) {
  if (!convergences_.opens(told)) return stepper_.phase() == Phase::converged;
  // The host has converged with a constant active set and linearised gaps: the state is a solution only if the true
  // laws agree.
  const bool solved = is_solution();
  bool accepted = solved && helpers_.are_settled();
  if (accepted) {
    for (SteppedContact* contact : model_.active_contacts()) {
      accepted = !contact->reconsiders_edge() && accepted;
      accepted = !contact->finds_overlap() && accepted;
    }
  }
  if (accepted && !helpers_.reject()) {
    stepper_.accept();
    model_.accepted();
    return true;
  }
  const bool corrects = !solved && model_.matrix_use() == MatrixUse::kept && keeps_matrix();
  const GoesOn with = corrects ? GoesOn::correction : GoesOn::matrix;
  model_.rejected(stepper_.reject(with), with);
  return false;
}

void ContactSteps::rewind() {
  restart();
  helpers_.rewind();
}

void ContactSteps::restart() {
  reset_rounds();
  stepper_.rewind();
}

}  // namespace mixture_contact
