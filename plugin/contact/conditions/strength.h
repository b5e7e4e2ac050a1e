/// The strength of a bond by the mode that it is loaded in: criterion of Camanho and Davila (2002),
/// NASA/TM-2002-211737, with the mixing of Benzeggagh and Kenane (1996), Compos Sci Technol 56:439-449.
#pragma once

#include "base/types.h"

#include <algorithm>
#include <cmath>

namespace mixture_contact {

/// A quantity that depends on the mode, given its values in tension and in shear.
struct ByMode {
  double normal = 0;
  double shear = 0;

  /// normal + (shear - normal) B^eta, given that power of the mode.
  double at(double power) const { return normal + (shear - normal) * power; }
};

/// Tractions that a bond bears.
struct Strength {
  ByMode traction;    ///< sigma_c in tension and tau_c in shear [MPa]
  double mixing = 2;  ///< eta, at least 1 [-]

  /// B^eta, for the part B of shear in the square of opening or traction: 0 in tension, 1 in shear.
  double power(double mode) const { return std::pow(mode, mixing); }
  /// The derivative of power() with B.
  double d_power(double mode) const { return mixing * std::pow(mode, mixing - 1); }
  /// The square of the traction that is borne, sigma_c^2 + (tau_c^2 - sigma_c^2) B^eta [MPa^2].
  double square(double power) const {
    return ByMode{traction.normal * traction.normal, traction.shear * traction.shear}.at(power);
  }
};

/// A bond that breaks at once where its load exceeds its strength, at solutions alone.
struct Brittle {
  Strength strength;
};

/// Whether a traction exceeds the strength; compression breaks nothing. `normal`: of unit length.
inline bool exceeds(const Brittle& bond, const Vector3d& traction, const Vector3d& normal) {
  const double tension = std::max(0.0, traction.dot(normal));
  const double shear = (traction - traction.dot(normal) * normal).squaredNorm();
  const double square = tension * tension + shear;
  return square > 0 && square > bond.strength.square(bond.strength.power(shear / square));
}

}  // namespace mixture_contact
