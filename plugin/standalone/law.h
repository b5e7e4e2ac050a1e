/// The mixture at a point: stress, fluxes and contents from deformation, pressure and concentration, as pure functions.
///
/// All quantities refer to the reference configuration, in which the gradients of the shape functions are constant: the
/// integrals are those of (2.1)-(2.3) over the current configuration, pulled back.
#pragma once

#include "error.h"
#include "model.h"

#include <Eigen/Geometry>

#include <cmath>

namespace standalone {

/// The fields at a point, one column each: row 0 contains the value, rows 1 to 3 the gradient in the reference
/// configuration.
template <class T>
using PointFields = Eigen::Matrix<T, 4, max_fields>;

/// The state of a point at the end of the last time step.
struct PointHistory {
  double volume_ratio = 1;  ///< volume ratio J
  double content = 0;       ///< content of solute J phi_w kappa~ c~ [nmol/mm^3]
};

/// The state of a mixture at a point. A material without pores has no fluxes; one without solute has no solute flux and
/// content.
template <class T>
struct PointState {
  using Vector = Eigen::Matrix<T, 3, 1>;

  Eigen::Matrix<T, 3, 3> deformation;    ///< deformation gradient F
  Eigen::Matrix<T, 3, 3> cofactor;       ///< cofactor J F^-T
  T volume_ratio{};                      ///< volume ratio J
  Eigen::Matrix<T, 3, 3> stress;         ///< first Piola-Kirchhoff stress of the mixture [MPa]
  T pressure{};                          ///< pressure p = p~ + R T Phi c [MPa]
  T content{};                           ///< content of solute J phi_w kappa~ c~ [nmol/mm^3]
  Vector solvent_flux = Vector::Zero();  ///< solvent flux w in the current configuration [mm/s]
  Vector solute_flux = Vector::Zero();   ///< solute flux j in the current configuration [nmol/(mm^2 s)]
};

/// Computes the kinematics and the neo-Hookean stress P = mu (F - F^-T) + lambda ln(J) F^-T. `q`: fields at the point.
/// Throws StepFailure if J <= 0.
template <class T>
PointState<T> deform(const Material& material, const PointFields<T>& q) {
  using std::log;
  PointState<T> s;
  s.deformation = q.template block<3, 3>(1, 0).transpose();
  for (int i = 0; i < 3; ++i) s.deformation(i, i) += T(1);
  const auto& f = s.deformation;
  for (int i = 0; i < 3; ++i) s.cofactor.col(i) = f.col((i + 1) % 3).cross(f.col((i + 2) % 3));
  s.volume_ratio = f.col(0).dot(s.cofactor.col(0));
  if (!(s.volume_ratio > 0)) throw StepFailure("an element is inverted");
  const double mu = material.modulus / (2 * (1 + material.poisson));
  const double lambda = material.modulus * material.poisson / ((1 + material.poisson) * (1 - 2 * material.poisson));
  const T pull = (T(lambda * log(s.volume_ratio)) - T(mu)) / s.volume_ratio;
  s.stress = f * T(mu) + s.cofactor * pull;
  return s;
}

/// Adds fluid and solute to a deformed solid `s`: the pressure p = p~ + R T Phi c, and the fluxes of (2.2) and (2.3),
///
///   w = -k~ [grad p~ + R T kappa~ (d/d0) grad c~],   1/k~ = 1/k + R T kappa~ c~ (1 - d/d0) / (phi_w d0),
///   j = kappa~ d (c~ w / d0 - phi_w grad c~).
///
/// `gas_energy`: R T [mJ/nmol]. `q`: fields at the point.
template <class T>
void flow(const Material& material, double gas_energy, const PointFields<T>& q, PointState<T>& s) {
  using Vector = Eigen::Matrix<T, 3, 1>;
  const auto gradient = [&](int field) {
    const Vector spatial = s.cofactor * q.template block<3, 1>(1, field);
    return Vector(spatial / s.volume_ratio);
  };
  T porosity = T(1) - T(material.solid_fraction) / s.volume_ratio;
  if (porosity < 0) porosity = T(0);
  s.pressure = q(0, pressure_dof);
  T resistance = T(1 / material.permeability);
  Vector drive = gradient(pressure_dof);
  if (!material.solute) {
    s.solvent_flux = -drive / resistance;
  } else {
    const Solute& solute = *material.solute;
    const double hindrance = solute.diffusivity / solute.free_diffusivity;
    const double energy = gas_energy * solute.solubility;
    const T& c = q(0, solute_field);
    s.pressure += c * T(energy * material.osmotic);
    if (hindrance < 1) resistance += c * T(energy * (1 - hindrance) / solute.free_diffusivity) / porosity;
    drive += gradient(solute_field) * T(energy * hindrance);
    s.solvent_flux = -drive / resistance;
    const Vector carried = s.solvent_flux * (c * T(1 / solute.free_diffusivity));
    const Vector spread = gradient(solute_field) * porosity;
    s.solute_flux = (carried - spread) * T(solute.solubility * solute.diffusivity);
    s.content = s.volume_ratio * porosity * c * T(solute.solubility);
  }
  s.stress -= s.cofactor * s.pressure;
}

/// The complete state at a point with the fields `q`. `gas_energy`: R T [mJ/nmol].
template <class T>
PointState<T> point_state(const Material& material, double gas_energy, const PointFields<T>& q) {
  PointState<T> s = deform<T>(material, q);
  if (material.porous) flow<T>(material, gas_energy, q, s);
  return s;
}

/// The quantities that are work-conjugate to the fields of a point. Row 0 belongs to the virtual value, rows 1 to 3 to
/// its gradient in the reference configuration. The columns are
///
///   u (2.1)  [0; P_i]    p~ (2.2)  [J_0 - J; dt W]    c~ (2.3)  [m_0 - m; dt J_k]
///
/// with the fluxes pulled back, W = J F^-1 w, the content m, and backward differences in time. `last`: state at the
/// start of the step.
template <class T>
PointFields<T> point_forces(const Material& material, double gas_energy, double dt, const PointHistory& last,
                            const PointFields<T>& q) {
  const PointState<T> s = point_state<T>(material, gas_energy, q);
  PointFields<T> forces;
  forces.row(0) << T(0), T(0), T(0), T(last.volume_ratio) - s.volume_ratio, T(last.content) - s.content;
  forces.template block<3, 3>(1, 0) = s.stress.transpose();
  forces.template block<3, 1>(1, pressure_dof) = s.cofactor.transpose() * s.solvent_flux * T(dt);
  forces.template block<3, 1>(1, solute_field) = s.cofactor.transpose() * s.solute_flux * T(dt);
  return forces;
}

}  // namespace standalone
