#include "kept_matrix.h"

#include "matrix_rows.h"
#include "solver/norm.h"

#include <FECore/DumpStream.h>
#include <FECore/vector.h>

#include <algorithm>
#include <utility>

namespace newton {

namespace {

/// Largest number of iterations with one matrix in FEBio's modified Newton method, which has no limit of its own. It
/// stops an active set that cycles.
constexpr int most_iterations = 50;

/// The largest fraction of the residual that an iteration with a kept matrix may leave, for the matrix to be kept
/// longer. With corrections, which discard FEBio's updates, the fraction is uniform: at this rate three iterations
/// leave a thousandth, which a single iteration with a new matrix usually achieves. The size is a choice.
constexpr double most_left = 0.1;

/// Number of matrices in a step whose corrections may leave too much of the residual. After that, each iteration of the
/// step has a new matrix. The size is a choice: one such matrix may have been assembled just before a large change of
/// the contact.
constexpr int most_spent = 2;

/// The largest relative error of an increment from the deferred parts. An iteration with this error leaves the same
/// fraction to the next one.
constexpr double left_by_sweeps = 1e-2;

/// The largest relative error of an increment from the deferred parts if no iteration of the splitting has been
/// performed, as a fraction of FEBio's tolerance on increments. Such an error must not prevent convergence. The size is
/// a choice.
constexpr double left_unseen = 0.2;
/// The factor on the reduction that earlier solutions have shown, in the maximum with that of the last solution; the
/// reduction differs between right-hand sides. The size is a choice.
constexpr double remembered = 0.5;

/// The largest backward error of a solution. A penalty turns the error of a gap into a load: for a gap of 1e-5 of the
/// displacements, as with penalties of 1e5 times the stiffness of the bodies, the error of the load is 1e-4.
constexpr double largest_backward_error = 1e-9;

std::vector<double> as_std(const Eigen::Ref<const Eigen::VectorXd>& values) { return {values.begin(), values.end()}; }

/// The solution for one right-hand side.
std::vector<double> solution(const SolveAll& solve, const std::vector<double>& right) {
  return as_std(solve(as_vector(right)));
}

/// The solution for one right-hand side with these conditions, or without them if they cannot be met. `free`: solution
/// without them.
std::vector<double> solution_with(const std::vector<Condition>& conditions, Border& border, const SolveAll& solve,
                                  std::vector<double> right, std::vector<double> free) {
  if (conditions.empty() || !border.hold(solve, conditions, free, right)) return free;
  return solution(solve, right);
}

}  // namespace

void KeptMatrix::formed(const MatrixParts& parts) {
  // FEBio has met the request, if there was one.
  const bool was_requested = std::exchange(is_requested_, false);
  if (was_requested && served_.leave_too_much(norm(system_.solver().vectors().residual))) ++served_.spent;
  begin();
  prepare({}, parts);
}

void KeptMatrix::go_on(const MatrixParts& parts, bool begins) {
  const bool is_another = follow();
  const bool is_plain = begins && system_.updates() == 0;
  if (is_another || is_plain) prepare({}, parts);
}

std::optional<Answer> KeptMatrix::answer(const std::vector<Condition>& conditions) {
  if (!may_correct_) return std::nullopt;
  if (free_.empty()) free_ = split_.x.empty() ? solution(solve_all(), system_.solver().vectors().residual) : split_.x;
  std::optional<Answer> found = border_.answer(solve_all(), conditions, free_);
  if (!may_correct_) found.reset();
  return found;
}

void KeptMatrix::hold(const std::vector<Condition>& conditions, const MatrixParts& parts, Answer answer) {
  const auto solve_with_conditions = [&](const std::vector<double>& right) {
    return solution_with(conditions, border_, solve_all(), right, solution(solve_all(), right));
  };
  finish(split_near(split_, std::move(answer.x), solve_with_conditions, parts, system_.solver().vectors().residual,
                    left_by_sweeps),
         parts, conditions);
}

bool KeptMatrix::follow() {
  if (number_ == system_.matrices()) return false;
  request(false);  // FEBio did not use the request for its matrix after an augmentation
  begin();
  return true;
}

void KeptMatrix::begin() {
  restore();
  number_ = system_.matrices();
  border_.forget();
  taken_.clear();
  served_ = {0, 0, served_.spent};
  may_correct_ = true;
}

bool KeptMatrix::Served::leave_too_much(double residual) {
  const double before = std::exchange(left, residual);
  const bool has_been_corrected = iterations > 0;
  return has_been_corrected && residual > most_left * before;
}

bool KeptMatrix::is_spent() {
  follow();
  const bool is_spent = served_.leave_too_much(norm(system_.solver().vectors().residual)) && system_.may_form_matrix();
  if (is_spent) ++served_.spent;
  return is_spent;
}

bool KeptMatrix::is_due() {
  follow();
  const MatrixStrategy strategy = system_.strategy();
  // JFNK takes differences from a residual of its own.
  const bool is_kept = strategy == MatrixStrategy::updated || strategy == MatrixStrategy::unchanged;
  if (!may_correct_ || !is_kept || served_.spent >= most_spent) return true;
  if (strategy == MatrixStrategy::unchanged) return served_.iterations >= most_iterations;
  const int most_updates = system_.most_updates();
  return most_updates > 0 && served_.iterations + system_.updates() >= most_updates - 1;
}

void KeptMatrix::request(bool is_needed) {
  if (is_needed == is_requested_ || (is_needed && system_.is_matrix_forced())) return;
  system_.force_matrix(is_needed);
  is_requested_ = is_needed;
}

void KeptMatrix::correct(const std::vector<Condition>& conditions, const MatrixParts& parts) {
  follow();
  // FEBio's updates are discarded: with BFGS, which is for symmetric matrices, corrections stagnate, and Broyden's
  // updates have solved for the residual before the correction.
  served_.iterations += std::max(1, system_.drop_updates());
  prepare(conditions, parts);
}

void KeptMatrix::take(RowOperations operations) {
  operations_ = std::move(operations);
  border_.forget();
  free_.clear();
}

Eigen::MatrixXd KeptMatrix::solutions_of_changed(Eigen::MatrixXd changed) {
  const Eigen::Index rows = changed.rows();
  const Eigen::Index columns = changed.cols();
  Eigen::MatrixXd found = system_.solve(std::move(changed));
  if (found.size() > 0) return found;
  may_correct_ = false;
  return Eigen::MatrixXd::Zero(rows, columns);
}

SolveAll KeptMatrix::solve_all() {
  return [this](Eigen::MatrixXd rights) {
    for (Eigen::Index n = 0; n < rights.cols(); ++n)
      rights.col(n) = as_vector(applied(operations_, as_std(rights.col(n))));
    return solutions_of_changed(std::move(rights));
  };
}

std::vector<double> KeptMatrix::checked_solution(const std::vector<double>& right) {
  const std::vector<double> changed = applied(operations_, right);
  std::vector<double> found = as_std(solutions_of_changed(as_vector(changed)));
  if (operations_.empty() || !may_correct_) return found;
  if (MatrixRows(system_.matrix()).backward_error(found, changed) <= largest_backward_error) return found;
  undo_operations();
  return solution(solve_all(), right);
}

void KeptMatrix::undo_operations() {
  const MatrixRows rows(system_.matrix());
  for (const RowOperation& operation : std::exchange(operations_, {})) rows.undo(operation);
  system_.factorise();
  if (!std::exchange(found_.loses_pivots, true))
    system_.solver().log(
        "\nsliding-mixture: row operations lose pivots, for example in a body that contact alone holds. Later matrices "
        "do without row operations.");
}

void KeptMatrix::prepare(const std::vector<Condition>& conditions, const MatrixParts& parts) {
  const std::vector<double>& right = system_.solver().vectors().residual;
  may_correct_ = true;
  free_.clear();
  bool is_checked = false;
  const auto solve = [&](const std::vector<double>& each) {
    return std::exchange(is_checked, true) ? solution(solve_all(), each) : checked_solution(each);
  };
  const auto solve_with_conditions = [&](const std::vector<double>& each) {
    return solution_with(conditions, border_, solve_all(), each, solve(each));
  };
  const bool solves_anyway = !are_empty(parts) || !conditions.empty();
  if (!operations_.empty() && !solves_anyway) free_ = solve(right);  // solved only to check the row operations
  const SeenSweeps seen{reduction_, left_unseen * std::min(left_by_sweeps, system_.increment_tolerance())};
  finish(split(solve_with_conditions, parts, right, left_by_sweeps, seen), parts, conditions);
}

void KeptMatrix::finish(Split split, const MatrixParts& parts, const std::vector<Condition>& conditions) {
  std::vector<double>& right = system_.solver().vectors().residual;
  if (!split.converges) take_parts_in();
  taken_ = std::move(split.product);
  if (!taken_.empty()) right = right - taken_;
  split_ = std::move(split);
  split_parts_ = parts;
  if (!conditions.empty()) {
    std::vector<double> with_conditions = right;
    free_ = solution(solve_all(), right);
    const bool holds = border_.hold(solve_all(), conditions, free_, with_conditions);
    taken_.resize(right.size());
    taken_ = taken_ + (right - with_conditions);
    right = std::move(with_conditions);
    may_correct_ = may_correct_ && holds;
  }
  may_correct_ = may_correct_ && split_.converges;
}

void KeptMatrix::solve() {
  if (operations_.empty()) return;
  std::vector<double>& right = system_.solver().vectors().residual;
  // FEBio's updates come from right-hand sides without row operations.
  served_.iterations += system_.drop_updates();
  taken_.resize(right.size());
  std::vector<double> changed = applied(operations_, right);
  taken_ = taken_ + (right - changed);
  right = std::move(changed);
}

void KeptMatrix::take_parts_in() {
  if (!std::exchange(found_.needs_parts, true))
    system_.solver().log(
        "\nsliding-mixture: couplings across the contact are large compared with the stiffness of the bodies. Later "
        "matrices include them and have more entries.");
}

void KeptMatrix::give_back() {
  if (taken_.empty()) return;
  system_.solver().vectors().residual += taken_;
  taken_.clear();
}

void KeptMatrix::tried(const std::vector<double>& solution) {
  if (!split_.x.empty() && !split_parts_.empty()) {
    const double seen = seen_reduction(split_, std::exchange(split_parts_, {}), solution);
    reduction_ = std::max(seen, remembered * reduction_);
  }
  give_back();
}

void KeptMatrix::accept() {
  if (border_.has_held()) return force_next();
  restore();
}

void KeptMatrix::force_next() {
  if (!reform_augment_) reform_augment_ = std::exchange(system_.forms_matrix_after_augmentations(), true);
  request(true);  // the next step then starts with a new matrix
}

void KeptMatrix::end_step() {
  served_.spent = 0;
  restore();
}

void KeptMatrix::serialize(DumpStream& ar) { ar & found_.needs_parts & found_.loses_pivots & reduction_; }

void KeptMatrix::restore() {
  const std::optional<bool> own = std::exchange(reform_augment_, std::nullopt);
  if (own) system_.forms_matrix_after_augmentations() = *own;
}

}  // namespace newton
