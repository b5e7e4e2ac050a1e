#include "conditions/openings.h"

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

/// How many nodes have another status than in the end, which is in contact where an opening is negative.
Index count_wrong(const VectorXd& openings, const VectorXd& end) {
  return ((openings.array() < 0) != (end.array() < 0)).count();
}

/// Openings after another `ahead` [s], given the present ones.
VectorXd continued(const Multipliers& known, VectorXd openings, double ahead) {
  const double steps = ahead / known.step_length;
  const bool any_in_contact = (known.opening.array() < 0).any();
  for (Index node = 0; node < openings.size(); ++node) {
    const Change last{known.opening_before[node], known.opening[node]};
    if (!std::isfinite(last.from) || !std::isfinite(last.to)) continue;
    double& opening = openings[node];
    const bool is_beside = any_in_contact && opening > 0;
    opening = is_beside ? extrapolated_beside_contact(opening, last, steps) : extrapolated(opening, last, steps);
  }
  return openings;
}

/// Whether what was foretold of a step of `dt` that has ended so leaves less than half as many nodes wrong as no
/// change; as before where no change was foretold. The size is a choice: on joints of tetrahedra as many steps begin as
/// foretold with any gain, and take as many iterations; rigid bodies that roll on each other take more.
bool is_foretold(const Multipliers& known, const VectorXd& end, double dt) {
  const VectorXd foretold = continued(known, known.opening, dt);
  if (count_wrong(foretold, known.opening) == 0) return known.was_foretold;
  return 2 * count_wrong(foretold, end) < count_wrong(known.opening, end);
}

}  // namespace

VectorXd openings(const NodalLaws& laws, const NodalGaps& now) {
  VectorXd found = VectorXd::Constant(laws.nodes(), std::numeric_limits<double>::infinity());
  for (Index node = 0; node < laws.nodes(); ++node) {
    if (!now.faces(node)) continue;
    const double traction = laws.traction_trial(node, now.gap[node]).value;
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
  VectorXd end = openings(laws, now);
  taken.was_foretold = is_foretold(taken, end, dt);
  taken.opening_before = std::exchange(taken.opening, std::move(end));
  taken.step_length = dt;
}

VectorXd expected_openings(const NodalLaws& laws, const NodalGaps& now, double ahead) {
  return continued(laws.multipliers, openings(laws, now), ahead);
}

}  // namespace mixture_contact
