/// Assembly: the core's patches in FEBio's equations, and its loads in mixed form where they have equations.
#pragma once

#include "bound_contact.h"
#include "load_equations.h"
#include "solver/border.h"
#include "solver/devices.h"
#include "solver/row_operations.h"
#include "solver/splitting.h"

#include <functional>
#include <vector>

class FEGlobalMatrix;
class FEGlobalVector;
class FELinearSystem;

/// The traction of a node whose status the matrix of an iteration may change.
struct UndecidedLoad {
  mixture_contact::Side surface;
  int node;
  double traction;                               ///< as the iteration begins, were it in contact [MPa]
  bool is_in_contact;                            ///< as the iteration begins
  newton::Condition changed;                     ///< gives the node the other status
  std::vector<newton::Condition::Entry> change;  ///< change of the traction by an increment [MPa]
  double change_by_condition;                    ///< the same of the unknown that `changed` adds
};

/// The parts of contacts that FEBio's matrix takes.
struct MatrixForm {
  bool is_constrained = false;  ///< linear constraints tie degrees of freedom of the model to each other
  newton::DeviceSet devices;    ///< those that may act on it
  bool has(newton::Device device) const { return newton::has(devices, device); }
};

class Assembly {
 public:
  Assembly(const BoundContact& contact, ContactSurfaces& surfaces, const DofMap& dofs, const LoadEquations& loads)
      : contact_(contact), surfaces_(surfaces), dofs_(dofs), loads_(loads) {}

  /// Adds the blocks of the present active set to the profile of the matrix.
  void add_to_profile(FEGlobalMatrix& matrix, const MatrixForm& form);

  void residual(FEGlobalVector& residual, double dt) const;
  /// Adds the residual of the change of the loads at the start of the iteration. Returns false if it is unknown.
  bool residual_change(FEGlobalVector& residual, double dt) const;
  /// The conditions that a matrix of another status lacks: those of loads that become zero, and of loads that are
  /// added.
  std::vector<newton::Condition> conditions(double dt) const;
  /// Loads that it may take away and add as an iteration begins: tractions of nodes that depend on no prescribed
  /// values.
  std::vector<UndecidedLoad> undecided_loads(double dt) const;
  /// The displacements of nodes of surfaces by an increment [mm], without nodes that have no equations of their own.
  mixture_contact::PerSide<mixture_contact::Matrix3Xd> displacements(const std::vector<double>& increment) const;
  const BoundContact& contact() const { return contact_; }
  void tangent(FELinearSystem& system, FEGlobalMatrix& matrix, double dt);
  /// Drops the data of old equations after a new numbering.
  void forget_matrix();
  /// The part of the last tangent that the matrix does not include.
  const newton::MatrixPart& beside_matrix() const { return beside_; }
  /// Whether the last tangent has loads as unknowns of the matrix.
  bool has_unknown_loads() const { return !unknown_loads_.empty(); }
  /// Eliminates the unknowns of their nodes from the rows of loads, if the matrix allows it. Requires the tangents of
  /// all contacts. Returns the row operations.
  newton::RowOperations eliminate_nodes(FEGlobalMatrix& matrix) const;

 private:
  using Location = mixture_contact::ContactInterface::Location;
  using UseBlock = std::function<void(const std::vector<int>& equations)>;
  /// Takes a load in mixed form, and the equations of the unknowns that it depends on.
  using UseLoad = std::function<void(const UnknownLoad& load, const std::vector<int>& others)>;
  /// Takes the equations of a node, and those of the unknowns that it depends on.
  using UseRow = std::function<void(const std::vector<int>& own, const std::vector<int>& others)>;
  void for_each_coupling(const UseBlock& use_block, const UseLoad& use_load, const UseRow& use_row) const;
  /// The unknowns that a row of the tangent couples.
  struct CoupledRow {
    std::vector<int> own;     ///< equations of the node
    std::vector<int> others;  ///< those that the matrix has in its rows
    bool both_ways = false;   ///< whether those have its equations in their rows, too
  };
  CoupledRow coupled_row(const NodeEquations& equations, mixture_contact::Side first,
                         const mixture_contact::TangentBlock& row) const;
  /// The condition that couples a load to its variables, which the matrix lacks.
  newton::Condition condition_of(const NodeEquations& equations, mixture_contact::Side first,
                                 const mixture_contact::LoadBlock& load) const;
  /// Whether the solver defers couplings of a pass, if its loads are unknowns.
  bool splits(mixture_contact::Side first) const {
    return takes_rows_ && form_.has(newton::Device::deferred_coupling) &&
           form_.has(newton::Device::loads_as_unknowns) && loads_.has(first);
  }
  /// The columns of a row that FEBio's matrix holds.
  mixture_contact::Patch in_matrix(const NodeEquations& equations, mixture_contact::Side first,
                                   const mixture_contact::TangentBlock& row) const;
  /// Adds parts of residuals to a vector. Keeps references.
  static mixture_contact::ContactInterface::AddResidual adder(const NodeEquations& equations, FEGlobalVector& residual);

  const BoundContact& contact_;
  ContactSurfaces& surfaces_;
  const DofMap& dofs_;
  const LoadEquations& loads_;
  MatrixForm form_;          ///< of the matrix
  bool takes_rows_ = false;  ///< whether the matrix takes geometric parts by nodes
  newton::MatrixPart beside_;
  std::vector<UnknownLoad> unknown_loads_;          ///< of the last tangent
  std::vector<UnknownTraction> unknown_tractions_;  ///< alike
};
