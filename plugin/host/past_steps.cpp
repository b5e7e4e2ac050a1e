#include "past_steps.h"

#include <algorithm>
#include <cmath>
#include <utility>

using Eigen::MatrixXd;

namespace mixture_contact {
namespace {

/// A curve in time is a parabola at the most: over uneven steps what is of higher degree leads astray.
constexpr int highest_degree_in_time = 2;
constexpr int highest_degree = 5;
constexpr std::size_t changes_kept = highest_degree;
/// Steps are regular where one is longer or shorter than the last by less than this factor, and the next one by no more
/// than this in the time stretched by them.
constexpr double regular_ratio = 5.0 / 3.0;
/// Steps whose lengths differ by less than this part are equal.
constexpr double same_length = 1e-6;
/// A curve that would have missed more than this part of the last change leads nowhere.
constexpr double largest_miss = 1.0 / 3.0;
/// Terms below this part of the first one are rounding, and so is what is missed less of the last change.
constexpr double negligible = 1e-6;

/// Sum of the terms, with the given part of the last one.
MatrixXd sum(const std::vector<MatrixXd>& terms, int degree, double last_part) {
  MatrixXd total = MatrixXd::Zero(terms[0].rows(), terms[0].cols());
  for (int n = 0; n + 1 < degree; ++n) total += terms[static_cast<std::size_t>(n)];
  return total + last_part * terms[static_cast<std::size_t>(degree - 1)];
}

/// The part of the last of the terms that brings their sum closest to the actual change.
double best_part(const std::vector<MatrixXd>& terms, int degree, const MatrixXd& actual) {
  if (degree == 1) return 1;  // all or nothing
  const MatrixXd& last = terms[static_cast<std::size_t>(degree - 1)];
  if (last.norm() <= negligible * terms[0].norm()) return 0;
  const MatrixXd missed = actual - sum(terms, degree - 1, 1);
  return std::clamp(last.cwiseProduct(missed).sum() / last.squaredNorm(), 0.0, 1.0);
}

/// A curve with what it would have missed.
struct Judged {
  Curve curve;
  double missed = 0;
};

Judged judged(const std::vector<MatrixXd>& terms, int degree, const MatrixXd& actual) {
  const double part = best_part(terms, degree, actual);
  return {{degree, part}, (actual - sum(terms, degree, part)).norm()};
}

}  // namespace

PastSteps::Coordinates PastSteps::in_time(double dt) const {
  Coordinates at{{0.0}, dt};
  for (const Change& change : changes_) at.past.push_back(at.past.back() - change.dt);
  return at;
}

/// With r the ratio of the last two steps, t_0 and t_1 long: s = ln(1 + t (1 - 1/r)/t_0)/ln r, which is -1 and -2 at
/// their starts, and t/t_0 where r = 1. States that lie before the time at which s is minus infinity are left out.
PastSteps::Coordinates PastSteps::in_stretched_time(double dt) const {
  const Coordinates time = in_time(dt);
  const double length = changes_[0].dt;
  const double ratio = length / changes_[1].dt;
  const bool equal = std::abs(ratio - 1) < same_length;
  const auto passed = [&](double t) { return t * (1 - 1 / ratio) / length; };
  const auto stretched = [&](double t) { return equal ? t / length : std::log1p(passed(t)) / std::log(ratio); };
  Coordinates at{{}, stretched(dt)};
  for (const double t : time.past) {
    if (!equal && passed(t) <= -1) break;
    at.past.push_back(stretched(t));
  }
  return at;
}

bool PastSteps::is_regular(double dt) const {
  if (changes_.size() < 2) return false;
  const double last = changes_[0].dt;
  const double before = changes_[1].dt;
  const bool regular = last < regular_ratio * before && before < regular_ratio * last;
  return regular && in_stretched_time(dt).next <= regular_ratio;  // not a number where it shrinks to a point before
}

/// What the terms of Newton's polynomial, from degree 1 on, foretell of the next change.
std::vector<MatrixXd> PastSteps::terms(const Coordinates& at, int degree) const {
  const auto count = std::min({static_cast<std::size_t>(degree), changes_.size(), at.past.size() - 1});
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
  missed_ = 1;
  if (changes_.empty()) return;
  const double whole = actual.values.norm();
  double least = largest_miss * whole;
  const std::vector<MatrixXd> of_time = terms(in_time(actual.dt), highest_degree_in_time);
  const Judged plain = judged(of_time, static_cast<int>(of_time.size()), actual.values);
  if (plain.missed <= least) {
    in_time_ = plain.curve;
    least = plain.missed;
  }
  if (is_regular(actual.dt)) {
    const std::vector<MatrixXd> stretched = terms(in_stretched_time(actual.dt), highest_degree);
    for (int degree = 2; degree <= static_cast<int>(stretched.size()); ++degree) {
      const Judged next = judged(stretched, degree, actual.values);
      if (next.missed >= least - negligible * whole) continue;
      stretched_ = next.curve;
      least = next.missed;
    }
  }
  const bool found = in_time_.degree > 0 || stretched_.degree > 0;
  if (found) missed_ = whole > 0 ? least / whole : 0;
}

void PastSteps::add(const Change& change) {
  judge(change);
  changes_.insert(changes_.begin(), change);
  if (changes_.size() > changes_kept) changes_.pop_back();
}

MatrixXd PastSteps::foretold(double dt) const {
  const auto along = [&](const Curve& curve, const Coordinates& at) {
    const std::vector<MatrixXd> all = terms(at, curve.degree);
    return sum(all, std::min(curve.degree, static_cast<int>(all.size())), curve.last_part);
  };
  if (stretched_.degree > 0 && is_regular(dt)) return along(stretched_, in_stretched_time(dt));
  if (in_time_.degree > 0) return along(in_time_, in_time(dt));
  return {};
}

}  // namespace mixture_contact
