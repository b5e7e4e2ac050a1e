#include "predictor.h"

#include "norm.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

using Eigen::Index;
using Eigen::MatrixXd;

namespace newton {
namespace {

/// The loads have a kink if the actual change of a load differs from the predicted one by more than this fraction.
constexpr double largest_turn = 1.0 / 3.0;
/// Rounding error of the difference between two load values of 1.
constexpr double rounding_of_loads = 64 * std::numeric_limits<double>::epsilon();
/// The least number of iterations of a linear step that starts at the end of the last step: one to solve it, and one in
/// which the solver compares the increment with it.
constexpr int least_iterations = 2;
/// If steps take the least number of iterations, a prediction is tried if the error of the last one is less than
/// `better` times this value. After a prediction that saved no iteration, it is tried if the error is less than
/// `better` times the error then.
constexpr double largest_error = 0.1;
constexpr double better = 0.5;
/// The fraction of the predicted change that is left to the first increment. FEBio compares residuals and energies with
/// those of the first increment, which therefore must not be rounding if the predicted state is the solution.
constexpr double part_left = 1e-4;

/// A free nodal value: its equation, and its position among the values of its variable.
struct FreeValue {
  Place place;
  int equation = -1;
  std::size_t variable = 0;
  Index row = 0;
};

/// Calls `use` with every free nodal value.
template <class Use>
void for_each_free_value(const Solver& solver, const Use& use) {
  std::size_t variable = 0;
  for (const std::vector<int>& dofs : solver.variables()) {
    Index row = 0;
    for (const int dof : dofs) {
      for (int node = 0; node < solver.nodes(); ++node) {
        const int equation = solver.equation({node, dof});
        if (equation >= 0) use(FreeValue{{node, dof}, equation, variable, row});
      }
      ++row;
    }
    ++variable;
  }
}

/// Changes of the free values of each variable in the last step; zero for other values.
std::vector<MatrixXd> changes_of_step(const Solver& solver) {
  std::vector<MatrixXd> changes;
  for (const std::vector<int>& dofs : solver.variables())
    changes.emplace_back(MatrixXd::Zero(number_of(dofs), solver.nodes()));
  for_each_free_value(solver, [&](const FreeValue& value) {
    changes[value.variable](value.row, value.place.node) = solver.value(value.place) -
                                                           solver.previous_value(value.place);
  });
  return changes;
}

/// Stores past steps in an archive, or reads them.
void archive_steps(Archive& archive, std::vector<PastSteps>& quantities) {
  int size = number_of(quantities);
  archive.part(size);
  quantities.resize(entries(size));
  for (PastSteps& steps : quantities) steps.for_each_part([&](auto& part) { archive.part(part); });
}

}  // namespace

// ------------------------------------------------------------ steps that have been solved

void Predictor::forget_other_analysis_step(const Solver& solver) {
  const int now = solver.analysis_step();
  if (std::exchange(analysis_step_, now) == now) return;
  variables_.clear();
  loads_.clear();
  error_in_vain_ = largest_error;
}

void Predictor::end_step(Solver& solver) {
  plain_steps_ = std::max(0, plain_steps_ - 1);
  if (!std::exchange(has_predicted_, false)) {
    iterations_plain_ = solver.iterations();
  } else {
    error_in_vain_ = solver.iterations() < iterations_plain_ ? largest_error : error_;
  }
  const std::vector<double> before = std::exchange(load_values_, solver.load_values());
  forget_other_analysis_step(solver);
  if (before.size() != load_values_.size()) return;  // in the first step, the loads at its start are not known
  const double dt = solver.time_increment();
  const std::vector<MatrixXd> changes = changes_of_step(solver);
  variables_.resize(changes.size());
  loads_.resize(before.size());
  for (std::size_t v = 0; v < changes.size(); ++v) variables_[v].add({changes[v], dt});
  for (std::size_t n = 0; n < before.size(); ++n)
    loads_[n].add({MatrixXd::Constant(1, 1, load_values_[n] - before[n]), dt});
  error_ = 0;
  for (const PastSteps& variable : variables_) error_ = std::max(error_, variable.prediction_error());
}

void Predictor::rewind(Solver& /*solver*/) {
  if (is_dropping_) return;
  part_of_prediction_.clear();
  has_predicted_ = false;
  plain_steps_ = plain_steps_after_failure;
}

void Predictor::archive(Archive& archive) {
  for (int* const number : {&analysis_step_, &iterations_plain_, &plain_steps_}) archive.part(*number);
  for (double* const number : {&error_, &error_in_vain_}) archive.part(*number);
  archive.part(load_values_);
  archive_steps(archive, variables_);
  archive_steps(archive, loads_);
}

// ------------------------------------------------------------ the step that begins

bool Predictor::loads_turn(const Solver& solver) const {
  const std::vector<double> loads = solver.load_values();
  for (std::size_t n = 0; n < loads.size(); ++n) {
    const double actual = loads[n] - load_values_[n];
    const MatrixXd predicted = loads_[n].predicted(solver.time_increment());
    const double difference = (predicted.size() == 0 ? 0 : predicted.value()) - actual;
    if (std::abs(difference) > largest_turn * std::abs(actual) + rounding_of_loads * std::abs(loads[n])) return true;
  }
  return false;
}

bool Predictor::is_worth_trying() const {
  if (iterations_plain_ > least_iterations) return true;
  return iterations_plain_ == least_iterations && error_ <= better * error_in_vain_;
}

/// A variable without a prediction keeps its value. If displacements kept their values, prescribed ones would deform
/// the elements next to them. If all changing variables kept their values, nothing would be gained.
bool Predictor::predicts_the_change(const Solver& solver) const {
  const double dt = solver.time_increment();
  return variables_[solver.displacements()].predicts(dt) &&
         std::any_of(variables_.begin(), variables_.end(),
                     [&](const PastSteps& variable) { return variable.changed() && variable.predicts(dt); });
}

std::string Predictor::unavailable(const Solver& solver) const {
  return solver.is_predictable() ? "" : "is not available in models with rigid bodies; set it to 0.";
}

bool Predictor::will_predict(const Solver& solver) const {
  return plain_steps_ == 0 && solver.is_predictable() && !variables_.empty() &&
         analysis_step_ == solver.analysis_step() && is_worth_trying() && predicts_the_change(solver) &&
         !loads_turn(solver);
}

std::vector<double> Predictor::prediction(const Solver& solver, const std::vector<double>& prescribed) const {
  std::vector<MatrixXd> changes;
  for (const PastSteps& variable : variables_) changes.push_back(variable.predicted(solver.time_increment()));
  std::vector<double> whole = prescribed;
  for_each_free_value(solver, [&](const FreeValue& value) {
    const MatrixXd& change = changes[value.variable];
    at(whole, value.equation) = change.size() == 0 ? 0 : change(value.row, value.place.node);
  });
  return whole;
}

/// Infinite if an element is inverted.
double Predictor::residual_norm(Solver& solver, const std::vector<double>& change, std::vector<double> increment) {
  solver.vectors().change = change;
  try {
    solver.update(increment);
    return norm(solver.evaluate_residual());
  } catch (const InvertedElement&) {
    return std::numeric_limits<double>::infinity();
  }
}

/// It leaves the model at the predicted state.
bool Predictor::is_better_than_plain(Solver& solver, const std::vector<double>& predicted,
                                     const std::vector<double>& prescribed) {
  const std::vector<double> none(predicted.size(), 0.0);
  const double plain = residual_norm(solver, none, prescribed);
  const double ahead = residual_norm(solver, predicted, none);
  if (std::isfinite(ahead) && ahead <= plain) return true;
  solver.log(std::isfinite(ahead)
                 ? "predictor: the predicted state is rejected, because its residual is larger than that of the "
                   "plain start."
                 : "predictor: the predicted state is rejected, because it inverts an element.");
  return false;
}

void Predictor::drop(Solver& solver, const std::vector<double>& prescribed) {
  is_dropping_ = true;
  solver.restore_state();
  is_dropping_ = false;
  solver.vectors().increment = prescribed;
}

bool Predictor::predict(Solver& solver, const std::function<void()>& arrived) {
  if (!will_predict(solver)) return false;
  const std::vector<double> prescribed = solver.vectors().increment;
  const std::vector<double> whole = prediction(solver, prescribed);
  solver.save_state();
  if (!is_better_than_plain(solver, whole, prescribed)) {
    drop(solver, prescribed);
    return false;
  }
  has_predicted_ = true;
  arrived();
  const double left = solver.has_known_totals() ? part_left : 1;
  solver.set_totals(scaled(whole, 1 - left));
  solver.vectors().increment = scaled(prescribed, left);
  part_of_prediction_ = scaled(whole, left);
  return true;
}

void Predictor::complete_residual(Solver& solver) {
  if (part_of_prediction_.empty()) return;
  // The solver's right-hand side is R(x + P) plus the loads of prescribed increments. R(x + P) at free values already
  // contains these loads.
  const Vectors vectors = solver.vectors();
  std::vector<double> part(part_of_prediction_.size(), 0.0);
  for_each_free_value(solver, [&](const FreeValue& value) {
    at(part, value.equation) = at(part_of_prediction_, value.equation);
    at(vectors.residual, value.equation) -= at(vectors.prescribed_load, value.equation);
  });
  part_of_prediction_.clear();
  const std::vector<double> load = solver.times_matrix(part);
  for (std::size_t n = 0; n < load.size(); ++n) vectors.residual[n] += load[n];
}

}  // namespace newton
