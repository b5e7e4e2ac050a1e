#include "enforcement/augmentation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace mixture_contact {
namespace {

/// A jump below this part of the field's own size counts as none where no load flows: rounding of the field's values.
constexpr double rounding_fraction = 1e-10;
constexpr double growth_step = 10;

/// Sums over the contact area from which a FieldGap is formed.
struct GapSums {
  double gap = 0;   ///< INT (eps0 gap)^2 da
  double load = 0;  ///< INT load^2 da
  double size = 0;  ///< INT (eps0 field)^2 da
  double largest = 0;

  void add(double area, double base, double jump, double value, double field) {
    gap += area * std::pow(base * jump, 2);
    load += area * value * value;
    size += area * std::pow(base * field, 2);
    largest = larger(largest, std::abs(jump));
  }

  FieldGap field_gap() const {
    const double scale = std::max(std::sqrt(load), rounding_fraction * std::sqrt(size));
    return {std::sqrt(gap) / (scale == 0 ? 1 : scale), largest};  // nothing over nothing is no gap; NaN stays NaN
  }
};

/// The slip of a node that sticks, in its tangent plane: no friction opposes what an average over facets that turn
/// leaves along its normal. Where a node slides it has no condition to meet.
void add_slip(GapSums& sums, double stiffness, const NodalLoads& loads, Index node) {
  const auto in_plane = [&] { return carried_trial(loads.friction, node, loads.friction.slip.col(node)).value; };
  const double slip = loads.slips[node] ? 0.0 : in_plane().norm();
  sums.add(loads.area[node], stiffness, slip, loads.friction.traction.col(node).norm(), std::sqrt(loads.area[node]));
}

const Tolerances::Field& tolerance_of_flux(const Tolerances& tolerances, const Effects& effects, Index field) {
  return effects.solvent && field == 0 ? tolerances.solvent : tolerances.solute;
}

/// The relative gap that a penalty leaves is 1 over its factor, a round number as tolerances are: what rounding makes
/// of either is not to decide which of them is larger.
constexpr double rounding_of_round_numbers = 1e-3;

bool within(const FieldGap& gap, const Tolerances::Field& tolerance) {
  return (tolerance.relative <= 0 || gap.relative <= (1 + rounding_of_round_numbers) * tolerance.relative) &&
         (tolerance.largest <= 0 || gap.largest <= tolerance.largest);
}

/// The multiple of the base that a penalty may grow to: where the relative gap alone is too large, what meets that
/// without multipliers, since the relative gap of a penalty is the reciprocal of its multiple.
double largest_multiple(const FieldGap& gap, const Tolerances::Field& tolerance, double accurate) {
  const bool by_relative = within({0, gap.largest}, tolerance);
  return by_relative ? std::min(accurate, 1 / tolerance.relative) : accurate;
}

/// The factor on a field's penalties after a growth step, at most what brings the smallest penalty to `accurate` times
/// the largest base. Facets without a penalty (impermeable ones) have no say.
double grown(double growth, const VectorXd& penalties, const VectorXd& bases, double accurate) {
  const double none = std::numeric_limits<double>::infinity();
  const double penalty = (penalties.array() > 0).select(penalties, none).minCoeff();
  return std::max(growth, std::min(growth * growth_step, accurate * bases.maxCoeff() / penalty));
}

}  // namespace

GapReport measure_gaps(const NodalLaws& laws, const NodalLoads& loads, const FacingFields& fields) {
  GapSums traction;
  GapSums slip;
  IndexedVector<GapSums> flux(laws.effects().scalar_fields());
  const Penalties& base = laws.penalties();
  const VectorXd rounding = laws.field_rounding(fields, loads.size);
  for (Index node = 0; node < loads.area.size(); ++node) {
    if (!loads.in_contact[node]) continue;
    const double gap = laws.normal().residual_gap(loads.gap[node], loads.traction[node]);
    traction.add(loads.area[node], base.stiffness[node], gap, loads.traction[node], std::sqrt(loads.area[node]));
    if (!loads.friction.empty()) add_slip(slip, base.stiffness[node], loads, node);
    if (!loads.flux_coupled[node]) continue;
    for (Index k = 0; k < flux.count(); ++k) {
      if (!laws.scalar(k).is_enforced()) continue;
      const bool is_rounding = std::abs(loads.jump(k, node)) <= rounding[k];
      flux[k].add(loads.flux_area(k, node), base.conductance(k, node), is_rounding ? 0.0 : loads.jump(k, node),
                  loads.flux(k, node), fields.primary.scalar(node, k));
    }
  }
  GapReport report{traction.field_gap(), {}, slip.field_gap()};
  for (const GapSums& sums : flux) report.flux.push_back(sums.field_gap());
  return report;
}

bool meets(const GapReport& report, const Tolerances& tolerances, const Effects& effects) {
  bool met = within(report.traction, tolerances.traction) && within(report.slip, tolerances.traction);
  for (Index k = 0; k < report.flux.count(); ++k) {
    met = met && within(report.flux[k], tolerance_of_flux(tolerances, effects, k));
  }
  return met;
}

bool grow_penalties(NodalLaws& laws, const GapReport& report, const Tolerances& tolerances) {
  const Penalties& penalty = laws.penalties();
  Multipliers& state = laws.multipliers;
  bool any = false;
  const auto grow = [&](double& scale, const FieldGap& gap, const Tolerances::Field& tolerance,
                        const VectorXd& penalties, const VectorXd& bases, double accurate) {
    if (within(gap, tolerance)) return;
    const double before = std::exchange(scale,
                                        grown(scale, penalties, bases, largest_multiple(gap, tolerance, accurate)));
    any = any || scale > before;
  };
  grow(state.traction_penalty_scale, report.traction, tolerances.traction, penalty.traction, penalty.stiffness,
       laws.largest_traction_factor());
  grow(state.friction_penalty_scale, report.slip, tolerances.traction, laws.friction_penalties(), penalty.stiffness,
       laws.largest_traction_factor());
  for (Index k = 0; k < report.flux.count(); ++k) {
    if (!laws.scalar(k).is_enforced()) continue;
    grow(state.flux_penalty_scale[k], report.flux[k], tolerance_of_flux(tolerances, laws.effects(), k),
         penalty.flux.row(k).transpose(), penalty.conductance.row(k).transpose(), laws.largest_flux_factor());
  }
  return any;
}

}  // namespace mixture_contact
