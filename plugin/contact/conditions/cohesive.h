/// The cohesive law: a bond that softens as it opens (Turon, Camanho, Costa and Davila 2006, Mechanics of Materials
/// 38:1072-1089).
///
/// The energy per area of a bond with the gap vector D, the normal n, the penalty K and the damage d is
///
///     psi = K/2 [(1 - d) lambda^2 + min(0, D_n)^2],    D_n = D.n,    lambda^2 = |D|^2 - min(0, D_n)^2
///
/// Damage does not affect compression. Loads are the derivatives of psi with respect to D and n; the forces of a
/// bond then have no moment. With the fraction B of shear in lambda^2,
///
///     d = f (lambda - o)/(lambda (f - o)) for lambda between o and f; d never decreases
///     (K o)^2 = sigma_c^2 + (tau_c^2 - sigma_c^2) B^eta,    f = 2 (G_n + (G_s - G_n) B^eta)/(K o)
///
/// The state variable is d, not the largest lambda. Both are equivalent in a constant mode; in a
/// changing mode, d never decreases.
///
/// With a viscosity, damage follows a retarded opening r in place of lambda: dr/dt = (lambda - r)/tau. A step dt uses
/// the implicit update r = r_0 + dt/(dt + tau) (lambda - r_0).
#pragma once

#include "conditions/strength.h"

namespace mixture_contact {

/// Parameters of the cohesive law.
struct Cohesive {
  Strength strength;
  ByMode energy;    ///< fracture energies G_n in tension and G_s in shear [N/mm]
  double pace = 1;  ///< factor dt/(dt + tau) of the step; 1 without a viscosity tau [-]
};

/// Derivative of the energy with respect to the gap vector and the normal, in this order.
using BondGradient = Eigen::Matrix<double, 6, 1>;
/// Second derivatives of the energy with respect to the gap vector and the normal.
using BondHessian = Eigen::Matrix<double, 6, 6>;

/// The loads of a bond and its damage.
struct BondLoad {
  /// Derivatives of the energy psi: d psi/dD, the traction on the primary surface [MPa], then d psi/dn [N/mm].
  BondGradient value;
  BondHessian derivative;  ///< derivative of `value`; symmetric unless damage grows in a changing mode
  double damage = 0;       ///< damage d, at least that of the accepted state [-]
};

/// The loads of a bond. `penalty`: K. `damage`: d of the accepted state. `normal`: unit normal out of the primary body.
BondLoad bond_load(const Cohesive& law, double penalty, double damage, const Vector3d& gap, const Vector3d& normal);

/// A quantity that the derivative of a bond's loads takes as constant although damage grows. The energy of a bond is
/// then concave in the opening and in its square.
enum class Constant {
  /// The traction while the bond opens. Moves are long. They may turn back and overshoot if bonds shear.
  traction,
  /// The damage. Moves are short. The energy is below its second-order expansion wherever the bond moves without
  /// closing, and iterations reduce it.
  damage
};

/// The part of softening that the derivative of a bond's loads includes.
struct Softening {
  double part = 1;                        ///< between 0 and 1; with 1 the derivative is the true one [-]
  Constant without = Constant::traction;  ///< constant quantity of the derivative without softening
};

/// The derivative of the loads of a bond without softening.
BondHessian derivative_at(Constant constant, double penalty, double damage, const Vector3d& gap,
                          const Vector3d& normal);

/// Energy dissipated per area [N/mm].
struct Dissipated {
  double by_damage = 0;
  double by_viscosity = 0;
};

/// The opening lambda of a gap vector [mm]. `normal`: unit normal.
double opening_size(const Vector3d& gap, const Vector3d& normal);

/// The energy that a bond dissipates in a step in which its damage grows. `before`, `after`: damage at the start and
/// end of the step. `from`: opening at the start [mm]. `gap`: gap vector at the end, whose mode counts. Damage from 0
/// to 1 dissipates the fracture energy.
Dissipated dissipated(const Cohesive& law, double penalty, double before, double after, double from,
                      const Vector3d& gap, const Vector3d& normal);

/// The lower bound of the penalty K for which f > o in every mode [N/mm^3].
double least_penalty(const Cohesive& law);

}  // namespace mixture_contact
