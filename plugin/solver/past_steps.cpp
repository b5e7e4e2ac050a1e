#include "past_steps.h"

#include <algorithm>
#include <cmath>
#include <utility>

using Eigen::MatrixXd;

namespace newton {
namespace {

/// Largest degree of a polynomial in time: over steps of different lengths, higher degrees overshoot.
constexpr int highest_degree_in_time = 2;
/// Largest degree of a polynomial in stretched time.
constexpr int highest_degree = 5;
constexpr std::size_t changes_kept = highest_degree;
/// Limit of the ratio of successive step lengths for stretched time. It also limits the length of the next step in
/// stretched time.
constexpr double regular_ratio = 5.0 / 3.0;
/// Two step lengths count as equal if they differ by less than this fraction.
constexpr double same_length = 1e-6;
/// A polynomial is not used if its error for the last change is larger than this fraction of the change.
constexpr double largest_extrapolation_error = 1.0 / 3.0;
/// Terms below this fraction of the first term are rounding; so are differences between errors below this fraction of
/// the last change.
constexpr double negligible = 1e-6;

/// A polynomial with its error for the last change.
struct Judged {
  Curve curve;
  double error = 0;
};

/// The sum of the terms, of which the last one is multiplied by `last_part`.
MatrixXd sum(const std::vector<MatrixXd>& terms, double last_part) {
  MatrixXd total = last_part * terms.back();
  for (std::size_t n = 0; n + 1 < terms.size(); ++n) total += terms[n];
  return total;
}

/// The factor on the n-th term that minimises the error of the terms before it, from 0 to 1. The first term is used
/// completely.
double best_part(const std::vector<MatrixXd>& terms, std::size_t n, const MatrixXd& error) {
  if (n == 0) return 1;
  if (terms[n].norm() <= negligible * terms[0].norm()) return 0;
  return std::clamp(terms[n].cwiseProduct(error).sum() / terms[n].squaredNorm(), 0.0, 1.0);
}

/// The polynomials of degrees 1, 2, ... with their errors for the change `actual`.
std::vector<Judged> judged(const std::vector<MatrixXd>& terms, const MatrixXd& actual) {
  std::vector<Judged> curves;
  MatrixXd error = actual;
  for (std::size_t n = 0; n < terms.size(); ++n) {
    const double part = best_part(terms, n, error);
    curves.push_back({{static_cast<int>(n) + 1, part}, (error - part * terms[n]).norm()});
    error -= terms[n];
  }
  return curves;
}

}  // namespace

PastSteps::Coordinates PastSteps::in_time(double dt) const {
  Coordinates at{{0.0}, dt};
  for (const Change& change : changes_) at.past.push_back(at.past.back() - change.dt);
  return at;
}

/// The stretched time is s = ln(1 + t (1 - 1/r)/t_0)/ln r, or t/t_0 for r = 1, where r is the ratio of the lengths t_0
/// and t_1 of the last two steps. It is -1 and -2 at the starts of these steps. States before the time at which s
/// is minus infinity are left out.
std::optional<PastSteps::Coordinates> PastSteps::in_stretched_time(double dt) const {
  if (changes_.size() < 2) return std::nullopt;
  const double length = changes_[0].dt;
  const double ratio = length / changes_[1].dt;
  if (ratio >= regular_ratio || 1 / ratio >= regular_ratio) return std::nullopt;
  const bool equal = std::abs(ratio - 1) < same_length;
  const auto passed = [&](double t) { return t * (1 - 1 / ratio) / length; };
  const auto stretched = [&](double t) { return equal ? t / length : std::log1p(passed(t)) / std::log(ratio); };
  Coordinates at{{}, stretched(dt)};
  if (!(at.next <= regular_ratio)) return std::nullopt;  // NaN if stretched time ends before the end of the next step
  for (const double t : in_time(dt).past) {
    if (!equal && passed(t) <= -1) break;
    at.past.push_back(stretched(t));
  }
  return at;
}

/// The terms of Newton's polynomial from degree 1 on, evaluated for the next change.
std::vector<MatrixXd> PastSteps::terms(const Coordinates& at, int degree) const {
  const auto count = std::min({indexing::entries(degree), changes_.size(), at.past.size() - 1});
  std::vector<MatrixXd> differences;
  for (std::size_t n = 0; n < count; ++n) differences.emplace_back(changes_[n].values / (at.past[n] - at.past[n + 1]));
  std::vector<MatrixXd> result;
  double factor = 1;
  for (std::size_t k = 0; k < count; ++k) {
    factor *= at.next - at.past[k];
    result.emplace_back(factor * differences[0]);
    for (std::size_t n = 0; n + 1 < differences.size(); ++n)
      differences[n] = (differences[n] - differences[n + 1]) / (at.past[n] - at.past[n + k + 2]);
    differences.pop_back();
  }
  return result;
}

void PastSteps::judge(const Change& actual) {
  in_time_ = stretched_ = {};
  error_ = 1;
  if (changes_.empty()) return;
  const double whole = actual.values.norm();
  double least = largest_extrapolation_error * whole;
  const Judged plain = judged(terms(in_time(actual.dt), highest_degree_in_time), actual.values).back();
  if (plain.error <= least) {
    in_time_ = plain.curve;
    least = plain.error;
  }
  if (const auto stretched = in_stretched_time(actual.dt)) {
    for (const Judged& next : judged(terms(*stretched, highest_degree), actual.values)) {
      if (next.error >= least - negligible * whole) continue;
      stretched_ = next.curve;
      least = next.error;
    }
  }
  const bool found = in_time_.degree > 0 || stretched_.degree > 0;
  if (found) error_ = whole > 0 ? least / whole : 0;
}

void PastSteps::add(const Change& change) {
  judge(change);
  changes_.insert(changes_.begin(), change);
  if (changes_.size() > changes_kept) changes_.pop_back();
}

MatrixXd PastSteps::predicted(double dt) const {
  if (stretched_.degree > 0) {
    if (const auto at = in_stretched_time(dt)) return sum(terms(*at, stretched_.degree), stretched_.last_part);
  }
  if (in_time_.degree > 0) return sum(terms(in_time(dt), in_time_.degree), in_time_.last_part);
  return {};
}

}  // namespace newton
