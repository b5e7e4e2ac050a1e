/// The mixture at a point: stress, fluxes and contents from deformation, pressure and concentrations. Pure functions.
///
/// Everything refers to the reference configuration, so that the gradients of the shape functions never change: the
/// integrals are those of (2.1)-(2.3) over the current configuration, pulled back.
#pragma once

#include "error.h"
#include "model.h"

#include <Eigen/Geometry>

#include <cmath>

namespace standalone {

/// Fields at a point, one column each in the order u1 u2 u3 p~ c~...: row 0 the value, rows 1 to 3 the reference
/// gradient.
template <class T, int Fields>
using PointFields = Eigen::Matrix<T, 4, Fields>;

/// What the last time step left at a point.
struct PointHistory {
  double volume_ratio = 1;  ///< J
  VectorXd content;         ///< J phi_w kappa~ c~ per solute of the material [nmol/mm^3]
};

/// Number of solutes among the fields of a material.
constexpr int solutes_of(int fields) { return fields > 4 ? fields - 4 : 0; }

/// A mixture at a point.
template <class T, int Fields>
struct PointState {
  static constexpr int columns = Fields > 4 ? Fields - 4 : 1;  ///< per solute; there are no matrices without columns

  Eigen::Matrix<T, 3, 3> deformation;        ///< F
  Eigen::Matrix<T, 3, 3> cofactor;           ///< J F^-T
  T volume_ratio{};                          ///< J
  Eigen::Matrix<T, 3, 3> stress;             ///< first Piola-Kirchhoff stress of the mixture [MPa]
  Eigen::Matrix<T, 3, 1> solvent_flux;       ///< w in the current configuration [mm/s]
  Eigen::Matrix<T, 3, columns> solute_flux;  ///< j per solute in the current configuration [nmol/(mm^2 s)]
  Eigen::Matrix<T, columns, 1> content;      ///< J phi_w kappa~ c~ per solute [nmol/mm^3]
};

/// Kinematics and the neo-Hookean stress P = mu (F - F^-T) + lambda ln(J) F^-T. Throws StepFailure where J <= 0.
template <class T, int Fields>
PointState<T, Fields> deform(const Material& material, const PointFields<T, Fields>& q) {
  using std::log;
  PointState<T, Fields> s;
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

/// Adds to a deformed solid what flows through it: pressure p = p~ + R T Phi SUM c, and the fluxes of (2.2) and (2.3),
///
///   w = -k~ [grad p~ + R T SUM kappa~ (d/d0) grad c~],   1/k~ = 1/k + R T SUM kappa~ c~ (1 - d/d0) / (phi_w d0),
///   j = kappa~ d (c~ w / d0 - phi_w grad c~).
template <class T, int Fields>
void flow(const Material& material, double gas_energy, const PointFields<T, Fields>& q, PointState<T, Fields>& s) {
  const auto gradient = [&](int field) {
    const Eigen::Matrix<T, 3, 1> spatial = s.cofactor * q.template block<3, 1>(1, field);
    return Eigen::Matrix<T, 3, 1>(spatial / s.volume_ratio);
  };
  T porosity = T(1) - T(material.solid_fraction) / s.volume_ratio;
  if (porosity < 0) porosity = T(0);
  T pressure = q(0, pressure_dof);
  T resistance = T(1 / material.permeability);
  Eigen::Matrix<T, 3, 1> drive = gradient(pressure_dof);
  for (int k = 0; k < solutes_of(Fields); ++k) {
    const Solute& solute = material.solutes[static_cast<std::size_t>(k)];
    const double hindrance = solute.diffusivity / solute.free_diffusivity;
    const double energy = gas_energy * solute.solubility;
    const T& c = q(0, 4 + k);
    pressure += c * T(energy * material.osmotic);
    if (hindrance < 1) resistance += c * T(energy * (1 - hindrance) / solute.free_diffusivity) / porosity;
    drive += gradient(4 + k) * T(energy * hindrance);
  }
  s.stress -= s.cofactor * pressure;
  s.content.setZero();
  s.solvent_flux = -drive / resistance;
  for (int k = 0; k < solutes_of(Fields); ++k) {
    const Solute& solute = material.solutes[static_cast<std::size_t>(k)];
    const T& c = q(0, 4 + k);
    const Eigen::Matrix<T, 3, 1> carried = s.solvent_flux * (c * T(1 / solute.free_diffusivity));
    const Eigen::Matrix<T, 3, 1> spread = gradient(4 + k) * porosity;
    s.solute_flux.col(k) = (carried - spread) * T(solute.solubility * solute.diffusivity);
    s.content[k] = s.volume_ratio * porosity * c * T(solute.solubility);
  }
}

/// The whole state at a point.
template <class T, int Fields>
PointState<T, Fields> point_state(const Material& material, double gas_energy, const PointFields<T, Fields>& q) {
  PointState<T, Fields> s = deform<T, Fields>(material, q);
  if constexpr (Fields > 3) flow<T, Fields>(material, gas_energy, q, s);
  return s;
}

/// What the fields of a point do work on: row 0 with the virtual value, rows 1 to 3 with its reference gradient, per
/// column
///
///   u (2.1)  [0; P_i]    p~ (2.2)  [J_0 - J; dt W]    c~ (2.3)  [m_0 - m; dt J_k]
///
/// with the fluxes pulled back, W = J F^-1 w, the content m, and backward differences in time.
template <class T, int Fields>
PointFields<T, Fields> point_forces(const Material& material, double gas_energy, double dt, const PointHistory& last,
                                    const PointFields<T, Fields>& q) {
  const auto s = point_state<T, Fields>(material, gas_energy, q);
  PointFields<T, Fields> forces = PointFields<T, Fields>::Zero();
  if constexpr (Fields > 3) {
    forces(0, pressure_dof) = T(last.volume_ratio) - s.volume_ratio;
    forces.template block<3, 1>(1, pressure_dof) = s.cofactor.transpose() * s.solvent_flux * T(dt);
    for (int k = 0; k < solutes_of(Fields); ++k) {
      forces(0, 4 + k) = T(last.content[k]) - s.content[k];
      forces.template block<3, 1>(1, 4 + k) = s.cofactor.transpose() * s.solute_flux.col(k) * T(dt);
    }
  }
  forces.template block<3, 3>(1, 0) = s.stress.transpose();
  return forces;
}

}  // namespace standalone
