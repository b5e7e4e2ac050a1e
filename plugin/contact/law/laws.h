/// The interface laws (2.7)-(2.9) of Ateshian, Maas and Weiss (2012), augmented Lagrangian form: value and derivative.
#pragma once

#include <algorithm>

namespace mixture_contact {

/// Value of a law and its derivative with the gap or jump it depends on.
struct LawValue {
  double value;
  double derivative;
};

/// Normal traction t_n = min(0, lambda_n + eps_n g), eq (2.7). g < 0 where the bodies overlap, t_n < 0 is compression.
///
/// lambda in MPa, eps in N/mm^3, gap in mm. Within `touch` [mm] of the kink the derivative is that of contact, so that
/// surfaces which touch to rounding act on each other; the value is exact everywhere.
inline LawValue normal_traction(double lambda, double penalty, double gap, double touch) {
  const double trial = lambda + penalty * gap;
  if (trial > penalty * touch) return {0.0, 0.0};
  return {std::min(0.0, trial), penalty};
}

/// Normal traction of surfaces that pull as well as push, t_n = lambda_n + eps_n g [MPa], tension where t_n > 0.
/// Sliding stays free.
inline LawValue two_sided_traction(double lambda, double penalty, double gap) {
  return {lambda + penalty * gap, penalty};
}

/// Normal flux w_n = lambda_p + eps_p (p1 - p2), eq (2.8), or j_n = lambda_k + eps_k (c1_k - c2_k), eq (2.9), positive
/// from the primary to the secondary body.
///
/// Solvent: lambda in mm/s, eps in mm^3/(N s), jump in MPa. Solute: lambda in nmol/(mm^2 s), eps in mm/s, jump in mM.
inline LawValue normal_flux(double lambda, double penalty, double jump) { return {lambda + penalty * jump, penalty}; }

/// Compliance of a contact whose multipliers are unknowns, over that of the adjoining elements [-]: what is left of a
/// gap or jump over their drop. Above the rounding of a factorisation, so that a condition on nodes that are all
/// prescribed has a pivot, and below every figure of interest.
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

}  // namespace mixture_contact
