/// Prediction of a quantity from its last steps, by polynomials through its past states. The polynomial with the
/// smallest error for the last step is used.
///
/// Quantities that creep or diffuse change ever more slowly, and a time stepper then lengthens its steps. Their states
/// are smooth functions of the step number rather than of time. Polynomials are therefore tried in two variables: time,
/// and a stretched time in which the last two steps have equal lengths. They are in Newton's form with divided
/// differences, in which each term adds a degree.
#pragma once

#include "indexing/entries.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace newton {

/// A polynomial through past states: its degree (0: none), and the factor on its last term, from 0 to 1.
struct Curve {
  int degree = 0;
  double last_part = 1;
};

/// The change of a quantity in a step of length dt [s]. `values` has the same shape in all steps.
struct Change {
  Eigen::MatrixXd values;
  double dt = 0;
};

/// The last changes of a quantity, with the polynomials that predict the next one.
class PastSteps {
 public:
  /// Determines the polynomial that predicts this change best, then keeps the change.
  void add(const Change& change);

  /// The predicted change in the next step of length dt [s]; empty if no polynomial would have predicted the last
  /// change with an error of at most a third.
  Eigen::MatrixXd predicted(double dt) const;

  /// True if there is a prediction for a step of length dt [s].
  bool predicts(double dt) const { return in_time_.degree > 0 || (stretched_.degree > 0 && in_stretched_time(dt)); }

  /// True if the quantity changed in the last step.
  bool changed() const { return !changes_.empty() && !changes_.front().values.isZero(0); }

  /// The relative error of the best polynomial for the last change; 1 if there is none.
  double prediction_error() const { return error_; }

  /// Calls `use` with each part of the state, for restart files. Changes come before the polynomials that were
  /// determined from them.
  template <class Use>
  void for_each_part(const Use& use);

 private:
  /// Values of the variable (time or stretched time) at the ends of the past steps and of the next step. Latest past
  /// step first; its end is 0.
  struct Coordinates {
    std::vector<double> past;
    double next = 0;
  };
  /// Coordinates in time [s], for a next step of length dt.
  Coordinates in_time(double dt) const;
  /// Coordinates in stretched time; empty if the lengths of the steps change too much.
  std::optional<Coordinates> in_stretched_time(double dt) const;
  /// The terms of degree 1 and above of the polynomial, evaluated for the next change.
  std::vector<Eigen::MatrixXd> terms(const Coordinates& at, int degree) const;
  /// Determines the best polynomial for the change `actual`.
  void judge(const Change& actual);

  std::vector<Change> changes_;  ///< last changes, latest first
  /// Best polynomial in time.
  Curve in_time_;
  Curve stretched_;  ///< best polynomial in stretched time, if its error is smaller than in time
  /// Relative error of the best polynomial for the last change.
  double error_ = 1;
};

template <class Use>
void PastSteps::for_each_part(const Use& use) {
  int count = static_cast<int>(changes_.size());
  use(count);
  changes_.resize(indexing::entries(count));
  for (Change& change : changes_) {
    use(change.values);
    use(change.dt);
  }
  for (Curve* curve : {&in_time_, &stretched_}) {
    use(curve->degree);
    use(curve->last_part);
  }
  use(error_);
}

}  // namespace newton
