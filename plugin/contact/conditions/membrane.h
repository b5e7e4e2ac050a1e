/// Membranes: films between the surfaces that resist the solvent and solutes.
///
/// The laws are those of Kedem and Katchalsky (1958), Biochim Biophys Acta 27:229, integrated over the film as Spiegler
/// and Kedem (1966), Desalination 1:311, do: within the film, of thickness d and coordinate z from the primary side,
///
///     w = -L_p d (dp~/dz + R T sum_k (1 - sigma_k) dc~_k/dz)        j_k = -P_k d dc~_k/dz + (1 - sigma_k) c~_k w.
///
/// Both fluxes are constant over a film that stores nothing. The dissipation per volume, w^2/(L_p d) + R T sum_k P_k d
/// (dc~_k/dz)^2/c~_k, is never negative. c~ is the concentration of the solution that would be in equilibrium with the
/// mixture, and R T ln c~ the electrochemical potential of a charged solute, too.
#pragma once

#include "base/settings.h"
#include "conditions/scalar.h"

#include <memory>
#include <utility>

namespace mixture_contact {

/// Solvent through a film: w_n = L_p ([p~] + R T sum_k (1 - sigma_k) [c~_k]) [mm/s]. Solutes that cross freely do not
/// contribute.
class SolventMembrane final : public ScalarCondition {
 public:
  /// `conductance`: L_p [mm^3/(N s)]. `drive`: coefficient of each field's jump in the driving pressure, 1 for p~ and R
  /// T (1 - sigma_k) for c~_k [MPa/mM].
  SolventMembrane(int field, double conductance, VectorXd drive)
      : ScalarCondition(field), conductance_(conductance), drive_(std::move(drive)) {}

  bool is_enforced() const override { return false; }
  FieldMask drivers() const override;
  FluxLaw flux(const NodalLoads& at, Index node, const Enforcing& by) const override;

 private:
  double conductance_;
  VectorXd drive_;
};

/// Solute k through a film, j_k = P_k [c~_k] + (1 - sigma_k) <c~_k> w_n [nmol/(mm^2 s)], with the mean <c~_k> of the
/// film's own profile: with s = (1 - sigma_k) w_n,
///
///     j_k = s c1 + P_k B(s/P_k) [c~_k],        B(x) = x/(e^x - 1).
///
/// A slow flow transports the arithmetic mean of both sides, a fast one the upstream concentration.
class SoluteMembrane final : public ScalarCondition {
 public:
  /// `solvent`: the membrane of the solvent; null without one. Keeps the pointer.
  SoluteMembrane(int field, SoluteFilm film, const SolventMembrane* solvent)
      : ScalarCondition(field), film_(film), solvent_(solvent) {}

  bool is_enforced() const override { return false; }
  FieldMask drivers() const override;
  FluxLaw flux(const NodalLoads& at, Index node, const Enforcing& by) const override;

 private:
  /// (1 - sigma_k) w_n at a node.
  FluxLaw carrying_flow(const NodalLoads& at, Index node) const;

  SoluteFilm film_;
  const SolventMembrane* solvent_;
};

/// Diffusion through a film against a flow, over the permeance: P B(s/P) [mm/s] and its derivative with s. P B(0)
/// is P; without permeance max(0, -s) is left.
LawValue against_flow(double permeance, double flow);

/// Conditions of the exchanged fields, in the order of Effects.
///
/// `share`: a half if each of two surfaces has its own conditions, because their fluxes cross the same film.
IndexedVector<std::unique_ptr<ScalarCondition>> scalar_conditions(const Effects& effects, const MembraneRule& rule,
                                                                  double share);

}  // namespace mixture_contact
