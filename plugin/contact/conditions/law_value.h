/// Values of laws with their derivatives, and the augmented form that the laws of a contact share.
#pragma once

namespace mixture_contact {

/// Value of a law and its derivative with the gap or jump it depends on.
struct LawValue {
  double value;
  double derivative;
};

/// lambda + eps g, the load that (2.7)-(2.9) make of a gap or jump in contact, with a multiplier and a penalty.
///
/// Traction [MPa]: lambda in MPa, eps in N/mm^3, gap in mm. Solvent flux [mm/s]: lambda in mm/s, eps in mm^3/(N s),
/// jump in MPa. Solute flux [nmol/(mm^2 s)]: lambda likewise, eps in mm/s, jump in mM.
inline LawValue augmented(double lambda, double penalty, double gap) { return {lambda + penalty * gap, penalty}; }

}  // namespace mixture_contact
