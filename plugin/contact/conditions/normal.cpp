#include "conditions/normal.h"

namespace mixture_contact {
namespace {

double one_sided_factor(bool both_ways) { return both_ways ? two_pass_traction_factor : default_traction_factor; }

}  // namespace

bool Unilateral::begins(const LawValue& trial, double touch) const {
  const bool is_apart = trial.value > trial.derivative * touch;
  return !is_apart && trial.derivative > 0;
}

double Unilateral::penalty_factor(bool both_ways) const { return one_sided_factor(both_ways); }

double Bilateral::penalty_factor(bool both_ways) const {
  return std::min(one_sided_factor(both_ways), tension_traction_factor);
}

VectorXd admissible(const NormalCondition& condition, const VectorXd& tractions) {
  return tractions.unaryExpr([&](double traction) { return condition.admissible(traction); });
}

const NormalCondition& normal_condition(const GapRule& gap) {
  static const Unilateral unilateral;
  static const Bilateral bilateral;
  return gap.tension ? static_cast<const NormalCondition&>(bilateral) : unilateral;
}

}  // namespace mixture_contact
