/// The parts of a contact's tangent into FEBio's matrix.
#pragma once

#include "bound_contact.h"
#include "load_equations.h"
#include "matrix_rows.h"

#include <vector>

class FEGlobalMatrix;
class FELinearSystem;

/// Where the parts of one tangent go: straight into the rows of the matrix where FEBio stores it by rows and equations
/// are free, else through FEBio's own assembly; and loads that have equations in mixed form.
class TangentAssembly {
 public:
  using Location = mixture_contact::ContactInterface::Location;

  /// Keeps references. `is_constrained`: whether linear constraints tie degrees of freedom of the model to each other.
  TangentAssembly(const mixture_contact::ContactInterface& core, const DofMap& dofs, const LoadEquations& loads,
                  FELinearSystem& system, FEGlobalMatrix& matrix, bool is_constrained);

  void add(const Location& rows, const Location& columns, const mixture_contact::MatrixXd& values) const;
  void add_load(mixture_contact::Side first, const mixture_contact::LoadBlock& load);
  /// Sets the diagonal of loads that there have been none of: their unknowns are zero.
  void close_unused_equations() const;

 private:
  struct Ids {
    std::vector<int> nodes;
    std::vector<int> rows;
    std::vector<int> columns;
  };
  Ids ids_of(const Location& rows, const Location& columns) const;
  void add_mixed(int own, const Ids& ids, const mixture_contact::LoadBlock& load) const;

  const mixture_contact::ContactInterface& core_;
  const DofMap& dofs_;
  const LoadEquations& loads_;
  FELinearSystem& system_;
  FEGlobalMatrix& matrix_;
  MatrixRows rows_;
  bool takes_blocks_;
  mixture_contact::IndexedVector<bool> used_;  ///< per equation of a load
};

/// Whether a matrix takes blocks of free equations as they are.
bool takes_blocks(FEGlobalMatrix& matrix, bool is_constrained);
