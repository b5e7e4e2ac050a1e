/// The strength of bonds in mixed mode. Cohesive bonds: criterion of Camanho and Davila (2002), NASA/TM-2002-211737,
/// with the mixed-mode law of Benzeggagh and Kenane (1996), Compos Sci Technol 56:439-449. Brittle bonds: quadratic
/// criterion of Brewer and Lagace (1988), J Compos Mater 22:1141-1155.
#pragma once

#include "base/types.h"

#include <algorithm>
#include <cmath>

namespace mixture_contact {

/// A quantity that depends on the mode: its values in pure tension and in pure shear.
struct ByMode {
  double normal = 0;
  double shear = 0;

  /// The value normal + (shear - normal) B^eta. `power`: B^eta, see Strength::power().
  double at(double power) const { return normal + (shear - normal) * power; }
};

/// The tractions at which a bond begins to soften.
struct Strength {
  ByMode traction;    ///< strengths sigma_c in tension and tau_c in shear [MPa]
  double mixing = 2;  ///< exponent eta of mixed modes, at least 1 [-]

  /// The power B^eta. `mode`: B, the fraction of shear in the square of opening or traction, 0 in tension, 1 in shear.
  double power(double mode) const { return std::pow(mode, mixing); }
  /// The derivative of power() with B.
  double d_power(double mode) const { return mixing * std::pow(mode, mixing - 1); }
  /// The square of the strength, sigma_c^2 + (tau_c^2 - sigma_c^2) B^eta [MPa^2]. `power`: B^eta.
  double square(double power) const {
    return ByMode{traction.normal * traction.normal, traction.shear * traction.shear}.at(power);
  }
};

/// A brittle bond: it breaks completely if its traction exceeds the strength at an accepted solution.
struct Brittle {
  ByMode strength;  ///< strength in tension and in shear [MPa]
};

/// True if a traction exceeds the strength: (<t_n>/sigma_c)^2 + (t_s/tau_c)^2 > 1. Compression does not contribute.
/// `normal`: unit normal of the secondary surface, as in FEBio's `sticky`.
inline bool exceeds(const Brittle& bond, const Vector3d& traction, const Vector3d& normal) {
  const double tension = std::max(0.0, traction.dot(normal)) / bond.strength.normal;
  const double shear = (traction - traction.dot(normal) * normal).norm() / bond.strength.shear;
  return tension * tension + shear * shear > 1;
}

}  // namespace mixture_contact
