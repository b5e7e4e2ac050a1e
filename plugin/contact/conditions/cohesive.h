/// The cohesive law: a bond that softens as it opens (Turon, Camanho, Costa and Davila 2006,
/// Mechanics of Materials 38:1072-1089).
///
/// The energy per area of a bond with the gap vector D, the normal n, the penalty K and the damage d is
///
///     psi = K/2 [(1 - d) lambda^2 + min(0, D_n)^2],    D_n = D.n,    lambda^2 = |D|^2 - min(0, D_n)^2
///
/// Compression is borne undamaged. Loads are the derivatives of psi with D and with n, so that forces of a bond have no
/// moment. With the part B of shear in lambda^2,
///
///     d = f (lambda - o)/(lambda (f - o)) between o and f, and never less than it was
///     (K o)^2 = sigma_c^2 + (tau_c^2 - sigma_c^2) B^eta,    f = 2 (G_n + (G_s - G_n) B^eta)/(K o)
///
/// The state is d and not the largest lambda: both are equivalent in a constant mode, and d never decreases in a
/// changing one.
///
/// With a viscosity, damage follows a retarded opening r in place of lambda, dr/dt = (lambda - r)/tau, which a step dt
/// takes at its end: r = r_0 + dt/(dt + tau) (lambda - r_0).
#pragma once

#include "conditions/strength.h"

namespace mixture_contact {

struct Cohesive {
  Strength strength;
  ByMode energy;    ///< G_n and G_s, which it takes to break the bond in tension and in shear [N/mm]
  double pace = 1;  ///< dt/(dt + tau) of the step; 1 without a viscosity tau [-]
};

/// Derivatives with the gap vector and with the normal, in this order.
using BondGradient = Eigen::Matrix<double, 6, 1>;
using BondHessian = Eigen::Matrix<double, 6, 6>;

/// The loads of a bond, and its damage.
struct BondLoad {
  BondGradient value;      ///< d psi/dD, the traction on the primary surface [MPa], and d psi/dn [N/mm]
  BondHessian derivative;  ///< of these loads; symmetric unless damage grows in a mode that changes
  double damage = 0;       ///< d, at least that of the accepted state
};

/// The load of a bond. `damage`: d of the accepted state; `normal`: of unit length.
BondLoad bond_load(const Cohesive& law, double penalty, double damage, const Vector3d& gap, const Vector3d& normal);

/// The derivative of the loads of a bond that yields: as if its traction stayed as the bond opens. The energy of a bond
/// whose damage grows is concave in the opening, and its tangent plane is above it: iterations with this derivative go
/// down.
BondHessian yielding_derivative(double penalty, double damage, const Vector3d& gap, const Vector3d& normal);

/// Energy that is lost per area [N/mm].
struct Dissipated {
  double by_damage = 0;
  double by_viscosity = 0;
};

/// lambda of a gap vector [mm]. `normal`: of unit length.
double opening_size(const Vector3d& gap, const Vector3d& normal);

/// The energy that damage from `before` to `after` dissipates in a step, at the mode of the gap vector that it ends
/// with and from the opening that it began with [mm]. From 0 to 1, damage takes the energy of the law.
Dissipated dissipated(const Cohesive& law, double penalty, double before, double after, double from,
                      const Vector3d& gap, const Vector3d& normal);

/// The penalty that a bond has to exceed, so that it softens and f > o in every mode [N/mm^3].
double least_penalty(const Cohesive& law);

}  // namespace mixture_contact
