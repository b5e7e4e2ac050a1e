/// Assembly: the core's patches in FEBio's equations, and its loads in mixed form where they have equations.
#pragma once

#include "bound_contact.h"
#include "fingerprint.h"
#include "load_equations.h"
#include "newton/border.h"

#include <functional>
#include <vector>

class FEGlobalMatrix;
class FEGlobalVector;
class FELinearSystem;

class Assembly {
 public:
  Assembly(const BoundContact& contact, ContactSurfaces& surfaces, const DofMap& dofs, const LoadEquations& loads)
      : contact_(contact), surfaces_(surfaces), dofs_(dofs), loads_(loads) {}

  /// Adds the blocks of the present active set to the profile of the matrix. `is_constrained`: whether linear
  /// constraints tie degrees of freedom of the model to each other.
  void add_to_profile(FEGlobalMatrix& matrix, bool is_constrained);
  /// Whether they are those that were added last.
  bool fits_matrix() const { return couplings() == couplings_of_matrix_; }

  void residual(FEGlobalVector& residual, double dt) const;
  /// Adds what loads that have changed as the iteration began make of it. Returns whether that is known.
  bool residual_change(FEGlobalVector& residual, double dt) const;
  /// What a matrix with the loads of another status lacks: it has loads that are zero, and others are added.
  std::vector<newton::Condition> conditions(double dt) const;
  /// What of it is of nodes that begin the step in contact though they are open.
  void residual_ahead(FEGlobalVector& residual, double dt) const;
  void tangent(FELinearSystem& system, FEGlobalMatrix& matrix, bool is_constrained, double dt) const;

 private:
  using Location = mixture_contact::ContactInterface::Location;
  using UseBlock = std::function<void(const std::vector<int>& equations)>;
  /// With the equation of a load in mixed form, and those of what it depends on.
  using UseLoad = std::function<void(int own, const std::vector<int>& others)>;
  /// With the equations of a node, and those of what it depends on.
  using UseRow = std::function<void(const std::vector<int>& own, const std::vector<int>& others)>;
  void for_each_coupling(const UseBlock& use_block, const UseLoad& use_load, const UseRow& use_row) const;
  Fingerprint couplings() const;
  /// Adds parts of residuals to a vector. Keeps references.
  static mixture_contact::ContactInterface::AddResidual adder(const NodeEquations& equations, FEGlobalVector& residual);

  const BoundContact& contact_;
  ContactSurfaces& surfaces_;
  const DofMap& dofs_;
  const LoadEquations& loads_;
  Fingerprint couplings_of_matrix_;
  bool takes_rows_ = false;  ///< whether the matrix takes geometric parts by nodes
};
