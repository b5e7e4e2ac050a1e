#include "stepper.h"

namespace mixture_contact {

Stepper::Evaluation Stepper::evaluate() {
  switch (phase_) {
    case Phase::trial:
      phase_ = Phase::evaluated;
      return Evaluation::keep_active_set;
    case Phase::rejected:
      phase_ = Phase::begun;
      return Evaluation::go_on;
    case Phase::uncorrected:
      return Evaluation::keep_linearisation;
    default:
      phase_ = Phase::begun;
      return Evaluation::begin_anew;
  }
}

void Stepper::prepare_step() {
  rejections_ = 0;
  if (phase_ == Phase::begun) phase_ = Phase::step_prepared;
}

Stepper::Matrix Stepper::before_matrix() const {
  switch (phase_) {
    case Phase::step_prepared:
      return Matrix::predict;
    case Phase::begun:
      return Matrix::nothing;
    case Phase::forming:
    case Phase::forming_loads:
    case Phase::forming_anew:
      return Matrix::is_formed;
    default:
      return Matrix::begin;
  }
}

void Stepper::form_matrix(Changed changed) {
  switch (changed) {
    case Changed::nothing:
      phase_ = Phase::forming;
      break;
    case Changed::loads:
      phase_ = Phase::forming_loads;
      break;
    case Changed::all:
      phase_ = Phase::forming_anew;
      break;
  }
}

Changed Stepper::matrix_formed() {
  switch (phase_) {
    case Phase::forming_loads:
      phase_ = Phase::forming;
      return Changed::loads;
    case Phase::forming_anew:
      phase_ = Phase::forming;
      return Changed::all;
    default:
      return Changed::nothing;
  }
}

bool Stepper::keep_matrix() {
  if (phase_ != Phase::evaluated && phase_ != Phase::uncorrected) return false;
  phase_ = Phase::corrected;
  return true;
}

int Stepper::reject(GoesOn with) {
  phase_ = with == GoesOn::correction ? Phase::uncorrected : Phase::rejected;
  return ++rejections_;
}

bool Round::opens(const void* participant) {
  if (!told_.insert(participant).second) told_ = {participant};
  return told_.size() == 1;
}

}  // namespace mixture_contact
