/// Membranes: thin layers between the surfaces that resist the fluxes of solvent and solutes.
///
/// The laws are those of Kedem and Katchalsky (1958), Biochim Biophys Acta 27:229, integrated over the membrane after
/// Spiegler and Kedem (1966), Desalination 1:311. Within a membrane of thickness d, with the coordinate z from the
/// primary side,
///
///     w = -L_p d (dp~/dz + R T sum_k (1 - sigma_k) dc~_k/dz)        j_k = -P_k d dc~_k/dz + (1 - sigma_k) c~_k w.
///
/// Both fluxes are constant across a membrane without storage. The dissipation per volume, w^2/(L_p d) + R T sum_k P_k
/// d (dc~_k/dz)^2/c~_k, is never negative. c~ is the concentration of a solution in equilibrium with the mixture; R T
/// ln c~ is also the electrochemical potential of a charged solute.
#pragma once

#include "base/settings.h"
#include "conditions/scalar.h"

#include <memory>
#include <utility>

namespace mixture_contact {

/// The solvent flux through a membrane: w_n = L_p ([p~] + R T sum_k (1 - sigma_k) [c~_k]) [mm/s]. Solutes with sigma_k
/// = 1 do not contribute.
class SolventMembrane final : public ScalarCondition {
 public:
  /// `conductance`: L_p [mm^3/(N s)]. `drive`: coefficients of the jumps of all fields in the driving pressure, 1 for
  /// p~ and R T (1 - sigma_k) for c~_k [MPa/mM].
  SolventMembrane(int field, double conductance, VectorXd drive)
      : ScalarCondition(field), conductance_(conductance), drive_(std::move(drive)) {}

  bool is_enforced() const override { return false; }
  FieldMask drivers() const override;
  FluxLaw flux(const NodalLoads& at, Index node, const Enforcing& by) const override;

 private:
  double conductance_;
  VectorXd drive_;
};

/// The flux of solute k through a membrane, j_k = P_k [c~_k] + (1 - sigma_k) <c~_k> w_n [nmol/(mm^2 s)]. <c~_k> is the
/// mean of the concentration profile in the membrane; with s = (1 - sigma_k) w_n,
///
///     j_k = s c1 + P_k B(s/P_k) [c~_k],        B(x) = x/(e^x - 1).
///
/// A slow flow transports the arithmetic mean of both sides, a fast flow the upstream concentration.
class SoluteMembrane final : public ScalarCondition {
 public:
  /// `solvent`: the solvent's condition, to which the pointer is kept; null if no solvent crosses.
  SoluteMembrane(int field, SoluteFilm film, const SolventMembrane* solvent)
      : ScalarCondition(field), film_(film), solvent_(solvent) {}

  bool is_enforced() const override { return false; }
  FieldMask drivers() const override;
  FluxLaw flux(const NodalLoads& at, Index node, const Enforcing& by) const override;

 private:
  /// The convective velocity s = (1 - sigma_k) w_n at a node [mm/s].
  FluxLaw carrying_flow(const NodalLoads& at, Index node) const;

  SoluteFilm film_;
  const SolventMembrane* solvent_;
};

/// The diffusive coefficient P B(s/P) of a membrane with the permeance P against the convective velocity s [mm/s], and
/// its derivative with s. P B(0) is P; for P = 0 the coefficient is max(0, -s).
LawValue against_flow(double permeance, double flow);

/// The conditions of all exchanged fields, in the order of Effects.
///
/// `share`: factor of the membrane's coefficients, a half if both surfaces have conditions of their own, because the
/// fluxes of both cross the same membrane.
IndexedVector<std::unique_ptr<ScalarCondition>> scalar_conditions(const Effects& effects, const MembraneRule& rule,
                                                                  double share);

}  // namespace mixture_contact
