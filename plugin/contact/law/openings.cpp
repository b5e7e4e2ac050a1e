#include "law/openings.h"

#include <cmath>
#include <limits>
#include <utility>

namespace mixture_contact {
namespace {

struct Change {
  double from;
  double to;
};

/// What a value becomes, should it change by `times` times as much.
double changed(double value, const Change& last, double times) { return value + times * (last.to - last.from); }

/// The same for a gap beside contact, whose power 2/3 changes evenly; what is in contact has none.
double beside_contact(double gap, const Change& last, double times) {
  constexpr double power = 2.0 / 3.0;
  const auto even = [](double opening) { return opening > 0 ? std::pow(opening, power) : opening; };
  const double expected = changed(even(gap), {even(last.from), even(last.to)}, times);
  return expected > 0 ? std::pow(expected, 1 / power) : expected;
}

}  // namespace

VectorXd openings(const NodalLaws& laws, const NodalGaps& now) {
  VectorXd found = VectorXd::Constant(laws.nodes(), std::numeric_limits<double>::infinity());
  for (Index node = 0; node < laws.nodes(); ++node) {
    if (!now.faces(node)) continue;
    const double traction = laws.multipliers.traction[node] + laws.traction_penalty(node) * now.gap[node];
    found[node] = traction < 0 ? traction / laws.penalties().stiffness[node] : now.gap[node];
  }
  return found;
}

void start_openings(NodalLaws& laws, const NodalGaps& now) {
  VectorXd& known = laws.multipliers.opening;
  if (known.array().isInf().all()) known = openings(laws, now);
}

void take_openings(NodalLaws& laws, const NodalGaps& now, double dt) {
  Multipliers& taken = laws.multipliers;
  taken.opening_before = std::exchange(taken.opening, openings(laws, now));
  taken.step_length = dt;
}

void forget_motion(NodalLaws& laws) {
  laws.multipliers.opening_before.setConstant(laws.nodes(), std::numeric_limits<double>::infinity());
}

VectorXd expected_openings(const NodalLaws& laws, const NodalGaps& now, double ahead) {
  const Multipliers& known = laws.multipliers;
  const double times = ahead / known.step_length;
  const bool any_in_contact = (known.opening.array() < 0).any();
  VectorXd expected = openings(laws, now);
  for (Index node = 0; node < laws.nodes(); ++node) {
    const Change last{known.opening_before[node], known.opening[node]};
    if (!std::isfinite(last.from) || !std::isfinite(last.to)) continue;
    const bool is_beside = any_in_contact && expected[node] > 0;
    expected[node] = is_beside ? beside_contact(expected[node], last, times) : changed(expected[node], last, times);
  }
  return expected;
}

}  // namespace mixture_contact
