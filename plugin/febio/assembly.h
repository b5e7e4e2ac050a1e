/// Assembly: the core's patches in FEBio's equations.
#pragma once

#include "bound_contact.h"
#include "fingerprint.h"

class FEGlobalMatrix;
class FEGlobalVector;
class FELinearSystem;

class Assembly {
 public:
  Assembly(const BoundContact& contact, ContactSurfaces& surfaces, const DofMap& dofs)
      : contact_(contact), surfaces_(surfaces), dofs_(dofs) {}

  /// Adds the blocks of the present active set to the profile of the matrix.
  void add_to_profile(FEGlobalMatrix& matrix);
  /// Whether they are those that were added last.
  bool fits_matrix() const { return couplings() == couplings_of_matrix_; }

  void residual(FEGlobalVector& residual, double dt) const;
  /// What of it is of nodes that begin the step in contact though they are open.
  void residual_ahead(FEGlobalVector& residual, double dt) const;
  /// `is_constrained`: whether linear constraints tie degrees of freedom of the model to each other.
  void tangent(FELinearSystem& system, FEGlobalMatrix& global, bool is_constrained, double dt) const;

 private:
  Fingerprint couplings() const;
  /// Adds parts of residuals to a vector.
  mixture_contact::ContactInterface::AddResidual adder(FEGlobalVector& residual) const;

  const BoundContact& contact_;
  ContactSurfaces& surfaces_;
  const DofMap& dofs_;
  Fingerprint couplings_of_matrix_;
};
