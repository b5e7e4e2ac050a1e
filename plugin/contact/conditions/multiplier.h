/// The equations of multipliers that are unknowns.
#pragma once

namespace mixture_contact {

/// The remaining gap or jump of a contact whose multipliers are unknowns, relative to the drop across the adjoining
/// elements [-]. It is above the rounding of a factorisation, such that a condition on prescribed nodes has a pivot,
/// and below any accuracy of interest.
inline constexpr double multiplier_compliance = 1e-11;

/// The value of a multiplier's equation and its derivatives.
struct ConditionValue {
  double value;
  double d_dgap;         ///< derivative with respect to the gap or jump
  double d_dmultiplier;  ///< derivative with respect to mu
};

/// The equation of a multiplier: gap or jump = 0 in contact, mu = 0 elsewhere.
///
/// `mu`: lambda/k, with the stiffness or conductance k of the adjoining elements. It is the drop across them that the
/// load causes, and has the unit of the gap [mm] or jump. `compliance`: gap or jump that remains, divided by this drop
/// [-].
inline ConditionValue multiplier_condition(bool in_contact, double mu, double gap,
                                           double compliance = multiplier_compliance) {
  if (!in_contact) return {-mu, 0.0, -1.0};
  return {gap - compliance * mu, 1.0, -compliance};
}

/// The equation of a flux that follows a law F, for example of a membrane: (F - lambda)/(k + k_F) = 0. The equation has
/// the unit of the jump for any size of k_F.
///
/// `mu`: lambda/k. `unit`: k, conductance of the adjoining elements. `coefficient`: k_F, derivative of F. `flux`: F.
inline ConditionValue law_condition(double mu, double unit, double coefficient, double flux) {
  const double both = unit + coefficient;
  return {(flux - unit * mu) / both, 1 / both, -unit / both};
}

}  // namespace mixture_contact
