/// Assembly of a tie's residual and tangent into FEBio's equations.
#pragma once

#include "contact/tie/tie.h"
#include "node_equations.h"

class FEGlobalMatrix;
class FEGlobalVector;
class FELinearSystem;

/// Assembles a tie.
class TieAssembly {
 public:
  /// Keeps references.
  TieAssembly(ContactSurfaces& surfaces, const DofMap& dofs) : surfaces_(surfaces), dofs_(dofs) {}

  void add_to_profile(const mixture_contact::Tie& tie, FEGlobalMatrix& matrix) const;
  void residual(const mixture_contact::Tie& tie, FEGlobalVector& residual, double dt) const;
  void tangent(const mixture_contact::Tie& tie, FELinearSystem& system, FEGlobalMatrix& matrix, double dt,
               const mixture_contact::Softening& softening) const;

 private:
  NodeEquations equations_of(const mixture_contact::Tie& tie) const;

  ContactSurfaces& surfaces_;
  const DofMap& dofs_;
};
