#include "host/stepper.h"

#include <boost/test/unit_test.hpp>

using mixture_contact::Changed;
using mixture_contact::GoesOn;
using mixture_contact::Phase;
using mixture_contact::Round;
using mixture_contact::Stepper;
using Evaluation = Stepper::Evaluation;
using Matrix = Stepper::Matrix;

namespace {

/// A stepper at the start of a step.
Stepper prepared() {
  Stepper stepper;
  stepper.evaluate();
  stepper.prepare_step();
  return stepper;
}

/// A stepper after an evaluated trial.
Stepper evaluated() {
  Stepper stepper = prepared();
  stepper.form_matrix(Changed::nothing);
  stepper.try_state();
  stepper.evaluate();
  return stepper;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_step_begins_anew_and_may_be_predicted) {
  Stepper stepper;
  BOOST_TEST((stepper.evaluate() == Evaluation::begin_anew));
  BOOST_TEST((stepper.phase() == Phase::begun));
  stepper.prepare_step();
  BOOST_TEST((stepper.before_matrix() == Matrix::predict));
}

BOOST_AUTO_TEST_CASE(trials_keep_the_active_set) {
  Stepper stepper = evaluated();
  for (int search = 0; search < 3; ++search) {
    stepper.try_state();
    BOOST_TEST((stepper.evaluate() == Evaluation::keep_active_set));
  }
}

BOOST_AUTO_TEST_CASE(a_matrix_at_an_accepted_trial_begins_an_iteration) {
  BOOST_TEST((evaluated().before_matrix() == Matrix::begin));
}

BOOST_AUTO_TEST_CASE(a_matrix_is_formed_once_however_many_contacts_hear_of_it) {
  Stepper stepper = evaluated();
  stepper.form_matrix(Changed::loads);
  BOOST_TEST((stepper.before_matrix() == Matrix::is_formed));
  BOOST_TEST((stepper.matrix_formed() == Changed::loads));
  BOOST_TEST((stepper.matrix_formed() == Changed::nothing));
}

BOOST_AUTO_TEST_CASE(what_has_changed_with_a_matrix_is_told_when_it_has_been_formed) {
  for (const Changed changed : {Changed::nothing, Changed::loads, Changed::all}) {
    Stepper stepper = evaluated();
    stepper.form_matrix(changed);
    BOOST_TEST((stepper.matrix_formed() == changed));
  }
}

BOOST_AUTO_TEST_CASE(the_residual_is_not_evaluated_again_where_no_load_has_changed) {
  Stepper stepper = evaluated();
  stepper.form_matrix(Changed::nothing);
  BOOST_TEST((stepper.matrix_formed() == Changed::nothing));
}

BOOST_AUTO_TEST_CASE(a_matrix_is_kept_where_none_has_been_formed_since_the_last_trial) {
  Stepper stepper = evaluated();
  BOOST_TEST(stepper.keep_matrix());
  BOOST_TEST((stepper.phase() == Phase::corrected));
  BOOST_TEST((stepper.before_matrix() == Matrix::begin));
  BOOST_TEST(!stepper.keep_matrix());
  stepper.try_state();
  BOOST_TEST((stepper.evaluate() == Evaluation::keep_active_set));
  stepper.form_matrix(Changed::loads);
  BOOST_TEST(!stepper.keep_matrix());
  BOOST_TEST((stepper.phase() == Phase::forming_loads));
}

BOOST_AUTO_TEST_CASE(what_has_converged_or_needs_a_matrix_keeps_none) {
  Stepper accepted = evaluated();
  accepted.accept();
  BOOST_TEST(!accepted.keep_matrix());
  Stepper rejected = evaluated();
  rejected.reject(GoesOn::matrix);
  BOOST_TEST(!rejected.keep_matrix());
}

BOOST_AUTO_TEST_CASE(a_rejected_state_that_is_corrected_keeps_what_is_held_until_the_iteration_ends) {
  Stepper stepper = evaluated();
  BOOST_TEST(stepper.reject(GoesOn::correction) == 1);
  BOOST_TEST((stepper.evaluate() == Evaluation::keep_linearisation));
  BOOST_TEST((stepper.before_matrix() == Matrix::begin));  // in case the host assembles a matrix
  BOOST_TEST(stepper.keep_matrix());
}

BOOST_AUTO_TEST_CASE(after_an_augmentation_iterations_begin_anew_and_nothing_is_predicted) {
  Stepper stepper = evaluated();
  stepper.accept();
  BOOST_TEST((stepper.evaluate() == Evaluation::begin_anew));
  BOOST_TEST((stepper.before_matrix() == Matrix::nothing));
}

BOOST_AUTO_TEST_CASE(after_a_rejection_iterations_go_on) {
  Stepper stepper = evaluated();
  BOOST_TEST(stepper.reject(GoesOn::matrix) == 1);
  BOOST_TEST((stepper.evaluate() == Evaluation::go_on));
  BOOST_TEST((stepper.before_matrix() == Matrix::nothing));
}

BOOST_AUTO_TEST_CASE(rejections_are_counted_by_step) {
  Stepper stepper = evaluated();
  stepper.reject(GoesOn::matrix);
  BOOST_TEST(stepper.reject(GoesOn::matrix) == 2);
  stepper.evaluate();
  stepper.prepare_step();
  BOOST_TEST(stepper.reject(GoesOn::matrix) == 1);
}

BOOST_AUTO_TEST_CASE(a_rewind_ends_whatever_is_under_way) {
  for (Stepper stepper : {prepared(), evaluated()}) {
    stepper.try_state();
    stepper.rewind();
    BOOST_TEST((stepper.evaluate() == Evaluation::begin_anew));
  }
  Stepper rejected = evaluated();
  rejected.reject(GoesOn::matrix);
  rejected.rewind();
  BOOST_TEST((rejected.evaluate() == Evaluation::begin_anew));
  Stepper forming = evaluated();
  forming.form_matrix(Changed::loads);
  forming.rewind();
  BOOST_TEST((forming.matrix_formed() == Changed::nothing));
}

BOOST_AUTO_TEST_CASE(the_first_to_be_told_opens_a_round) {
  const int one = 1;
  const int two = 2;
  Round round;
  BOOST_TEST(round.opens(&one));
  BOOST_TEST(!round.opens(&two));
  BOOST_TEST(round.opens(&one));
  BOOST_TEST(round.opens(&one));  // the previous round was interrupted
  BOOST_TEST(!round.opens(&two));
  BOOST_TEST(round.opens(&two));  // the other one is no longer active
  round.reset();
  BOOST_TEST(round.opens(&one));
}
