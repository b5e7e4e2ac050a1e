/// Predictions of a quantity from its last steps: curves through its past states, chosen by their error in predicting
/// the last step.
///
/// Quantities that creep or diffuse change ever more slowly, and a time stepper lengthens its steps as they do. Then
/// the states are smooth functions of the number of the step rather than of time. The curves therefore have two
/// curves: time, and the stretched time in which the last two steps are equally long. Polynomials are in Newton's form
/// (divided differences), whose terms add one degree each.
#pragma once

#include "indexing/entries.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace newton {

/// A polynomial through past states: its degree, and the part from 0 to 1 of its last term. Degree 0 means none.
struct Curve {
  int degree = 0;
  double last_part = 1;
};

/// The change by a step of length dt [s]. The values have any shape that is the same for all steps.
struct Change {
  Eigen::MatrixXd values;
  double dt = 0;
};

class PastSteps {
 public:
  /// Finds the curve that best predicts the change, then keeps the change.
  void add(const Change& change);

  /// The change that the next step of length dt will make; empty if no curve would have predicted two thirds of the
  /// last one.
  Eigen::MatrixXd predicted(double dt) const;

  /// Whether there is such a curve.
  bool predicts(double dt) const { return in_time_.degree > 0 || (stretched_.degree > 0 && in_stretched_time(dt)); }

  /// Whether the last step changed anything.
  bool changed() const { return !changes_.empty() && !changes_.front().values.isZero(0); }

  /// The error of the best curve for the last change, relative to it; 1 without a curve.
  double prediction_error() const { return error_; }

  /// Calls `use` with each part of the state, for restart files. Changes come before the curves that they have
  /// selected.
  template <class Use>
  void for_each_part(const Use& use);

 private:
  /// Coordinates of the ends of the past steps, latest first, the end of the last one being 0, and of the next one.
  struct Coordinates {
    std::vector<double> past;
    double next = 0;
  };
  Coordinates in_time(double dt) const;
  /// None where steps are not regular.
  std::optional<Coordinates> in_stretched_time(double dt) const;
  std::vector<Eigen::MatrixXd> terms(const Coordinates& at, int degree) const;
  void judge(const Change& actual);

  std::vector<Change> changes_;  ///< latest first
  Curve in_time_;
  Curve stretched_;  ///< where its error is smaller than that of the curve in time
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
