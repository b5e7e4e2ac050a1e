#include "law/openings.h"

#include <cmath>
#include <limits>
#include <utility>

namespace mixture_contact {
namespace {

/// What a value was and what it became.
struct Change {
  double from;
  double to;
};

/// What a value becomes, should it change `steps` times as much once more.
double extrapolated(double value, const Change& last, double steps) { return value + steps * (last.to - last.from); }

/// A power that keeps the sign.
double signed_power(double value, double exponent) { return std::copysign(std::pow(std::abs(value), exponent), value); }

/// As extrapolated(), for a gap beside contact: its power 2/3 changes evenly.
double extrapolated_beside_contact(double gap, const Change& last, double steps) {
  constexpr double exponent = 2.0 / 3.0;
  const Change evenly{signed_power(last.from, exponent), signed_power(last.to, exponent)};
  return signed_power(extrapolated(signed_power(gap, exponent), evenly, steps), 1 / exponent);
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

VectorXd expected_openings(const NodalLaws& laws, const NodalGaps& now, double ahead) {
  const Multipliers& known = laws.multipliers;
  const double steps = ahead / known.step_length;
  const bool any_in_contact = (known.opening.array() < 0).any();
  VectorXd expected = openings(laws, now);
  for (Index node = 0; node < laws.nodes(); ++node) {
    const Change last{known.opening_before[node], known.opening[node]};
    if (!std::isfinite(last.from) || !std::isfinite(last.to)) continue;
    const bool is_beside = any_in_contact && expected[node] > 0;
    double& opening = expected[node];
    opening = is_beside ? extrapolated_beside_contact(opening, last, steps) : extrapolated(opening, last, steps);
  }
  return expected;
}

}  // namespace mixture_contact
