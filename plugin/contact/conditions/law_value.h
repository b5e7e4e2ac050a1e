/// The value of a law with its derivative, and the augmented form of the contact laws.
#pragma once

namespace mixture_contact {

/// Value of a law and its derivative with respect to the gap or jump it depends on.
struct LawValue {
  double value;
  double derivative;
};

/// The load lambda + eps g of eqs (2.7)-(2.9) in contact, for a multiplier, a penalty and a gap or jump.
///
/// Traction [MPa]: lambda in MPa, eps in N/mm^3, gap in mm. Solvent flux [mm/s]: lambda in mm/s, eps in mm^3/(N s),
/// jump in MPa. Solute flux [nmol/(mm^2 s)]: lambda in nmol/(mm^2 s), eps in mm/s, jump in mM.
inline LawValue augmented(double lambda, double penalty, double gap) { return {lambda + penalty * gap, penalty}; }

}  // namespace mixture_contact
