#include "enforcement/gap_measures.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace mixture_contact {
namespace {

/// If there is no load, a jump below this fraction of the field's own size counts as zero; it is rounding of the
/// field's values.
constexpr double rounding_of_jumps = 1e-10;
constexpr double growth_step = 10;

/// Tolerance in the comparison of a relative gap with its tolerance. The relative gap of a penalty is 1/factor; factor
/// and tolerance are often round numbers with equal results, which rounding must not decide.
constexpr double rounding_of_round_numbers = 1e-3;

/// The largest multiple of the base up to which a penalty may grow. If only the relative gap is too large, it is the
/// multiple at which the penalty alone would meet the tolerance, because the relative gap of a penalty is the
/// reciprocal of its multiple.
double largest_multiple(const FieldGap& gap, const Tolerances::Field& tolerance, double accurate) {
  const bool by_relative = is_within({0, gap.largest}, tolerance);
  return by_relative ? std::min(accurate, 1 / tolerance.relative) : accurate;
}

}  // namespace

void GapSums::add(double area, double base, double jump, double load, double field) {
  gap_ += area * std::pow(base * jump, 2);
  load_ += area * load * load;
  size_ += area * std::pow(base * field, 2);
  largest_ = larger(largest_, std::abs(jump));
}

FieldGap GapSums::field_gap() const {
  const double scale = std::max(std::sqrt(load_), rounding_of_jumps * std::sqrt(size_));
  return {std::sqrt(gap_) / (scale == 0 ? 1 : scale), largest_};  // NaN stays NaN
}

const Tolerances::Field& tolerance_of_flux(const Tolerances& tolerances, const Effects& effects, Index field) {
  return effects.solvent && field == 0 ? tolerances.solvent : tolerances.solute;
}

bool is_within(const FieldGap& gap, const Tolerances::Field& tolerance) {
  return (tolerance.relative <= 0 || gap.relative <= (1 + rounding_of_round_numbers) * tolerance.relative) &&
         (tolerance.largest <= 0 || gap.largest <= tolerance.largest);
}

bool meets(const GapReport& report, const Tolerances& tolerances, const Effects& effects) {
  bool met = is_within(report.traction, tolerances.traction);
  for (const FieldGap& slip : report.slip) met = met && is_within(slip, tolerances.traction);
  for (Index k = 0; k < report.flux.count(); ++k)
    met = met && is_within(report.flux[k], tolerance_of_flux(tolerances, effects, k));
  return met;
}

bool grow(double& scale, const FieldGap& gap, const Tolerances::Field& tolerance, const VectorXd& penalties,
          const VectorXd& bases, double accurate) {
  if (is_within(gap, tolerance)) return false;
  const double none = std::numeric_limits<double>::infinity();
  const double penalty = (penalties.array() > 0).select(penalties, none).minCoeff();
  const double most = largest_multiple(gap, tolerance, accurate) * bases.maxCoeff() / penalty;
  const double before = std::exchange(scale, std::max(scale, std::min(scale * growth_step, most)));
  return scale > before;
}

}  // namespace mixture_contact
