/// The equation of a multiplier that is an unknown.
#pragma once

namespace mixture_contact {

/// Compliance of a contact whose multipliers are unknowns, over that of the adjoining elements [-]: remaining gap or
/// jump over their drop. Above the rounding of a factorisation, so that a condition on nodes that are all prescribed
/// has a pivot, and below every figure of interest.
inline constexpr double multiplier_compliance = 1e-11;

/// The equation of a multiplier that is an unknown, and its derivatives.
struct ConditionValue {
  double value;
  double d_dgap;         ///< d(value)/d(gap or jump)
  double d_dmultiplier;  ///< d(value)/dmu
};

/// In contact, gap or jump = 0; elsewhere, mu = 0.
///
/// mu = lambda/k, with k the stiffness or conductance of the adjoining elements, is the drop across them that the load
/// causes: it has the unit of the gap [mm] or jump.
inline ConditionValue multiplier_condition(bool in_contact, double mu, double gap) {
  if (!in_contact) return {-mu, 0.0, -1.0};
  return {gap - multiplier_compliance * mu, 1.0, -multiplier_compliance};
}

/// The equation of a flux that is a law of the scene, (F - lambda)/(k + k_F) = 0 with the law's flux F and its
/// coefficient k_F, given mu = lambda/k: F takes the place of the gap, and the equation has the unit of the jump,
/// however large or small k_F is.
inline ConditionValue law_condition(double mu, double unit, double coefficient, double flux) {
  const double both = unit + coefficient;
  return {(flux - unit * mu) / both, 1 / both, -unit / both};
}

}  // namespace mixture_contact
