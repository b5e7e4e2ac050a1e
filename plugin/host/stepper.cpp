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
    case Phase::forming_anew:
      return Matrix::is_formed;
    default:
      return Matrix::begin;
  }
}

bool Stepper::matrix_formed() {
  if (phase_ != Phase::forming_anew) return false;
  phase_ = Phase::forming;
  return true;
}

int Stepper::reject() {
  phase_ = Phase::rejected;
  return ++rejections_;
}

bool Round::opens(const void* participant) {
  if (!told_.insert(participant).second) told_ = {participant};
  return told_.size() == 1;
}

}  // namespace mixture_contact
