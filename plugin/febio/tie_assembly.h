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
  /// Keeps a reference.
  explicit TieAssembly(const DofMap& dofs) : dofs_(dofs) {}

  void add_to_profile(const mixture_contact::Tie& tie, FEGlobalMatrix& matrix) const;
  void residual(const mixture_contact::Tie& tie, FEGlobalVector& residual, double dt) const;
  void tangent(const mixture_contact::Tie& tie, FELinearSystem& system, FEGlobalMatrix& matrix, double dt,
               const mixture_contact::Softening& softening) const;

 private:
  NodeEquations equations_of(const mixture_contact::Tie& tie) const;

  const DofMap& dofs_;
};
