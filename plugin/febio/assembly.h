/// Assembly of the core's residual and tangent into FEBio's equations, with nodal loads in mixed form if they have
/// equations.
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

/// A node whose contact status may be predicted with the matrix of an iteration.
struct UndecidedLoad {
  mixture_contact::Side surface;
  int node;
  double traction;            ///< traction at the start of the iteration if the node was in contact [MPa]
  bool is_in_contact;         ///< true if the node is in contact at the start of the iteration
  newton::Condition changed;  ///< condition that gives the node the other status
  std::vector<newton::Condition::Entry> change;  ///< change of the traction by an increment, per equation [MPa]
  double change_by_condition;  ///< change of the traction by the unknown of the condition `changed` [MPa]
};

/// Properties of FEBio's matrix on which the assembly depends.
struct MatrixForm {
  bool is_constrained = false;  ///< true if linear constraints couple degrees of freedom of the model
  newton::DeviceSet devices;    ///< devices that may act on the matrix
  bool has(newton::Device device) const { return newton::has(devices, device); }
};

/// Assembles a sliding contact.
class Assembly {
 public:
  Assembly(const BoundContact& contact, const LoadEquations& loads) : contact_(contact), loads_(loads) {}

  /// Adds the couplings of the present active set to the profile of the matrix.
  void add_to_profile(FEGlobalMatrix& matrix, const MatrixForm& form);

  /// Adds the residual of the contact. `dt`: time increment [s].
  void residual(FEGlobalVector& residual, double dt) const;
  /// Adds the residual of the change of the loads at the start of the iteration. Returns false if the change is
  /// unknown.
  bool residual_change(FEGlobalVector& residual, double dt) const;
  /// The conditions that correct a matrix for a changed status: loads in the matrix that are now zero, and loads that
  /// are not in the matrix.
  std::vector<newton::Condition> conditions(double dt) const;
  /// The tractions that may be removed from the matrix or added to it at the start of an iteration. Nodes that depend
  /// on prescribed values are excluded.
  std::vector<UndecidedLoad> undecided_loads(double dt) const;
  /// The equations of all nodes and loads of the contact, on which its conditions and deferred parts depend.
  std::vector<int> equations() const;
  /// The displacements of the surfaces' nodes by an increment [mm]; zero for nodes without equations of their own.
  mixture_contact::PerSide<mixture_contact::Matrix3Xd> displacements(const std::vector<double>& increment) const;
  const BoundContact& contact() const { return contact_; }
  /// Adds the tangent of the contact to FEBio's system.
  void tangent(FELinearSystem& system, FEGlobalMatrix& matrix, double dt);
  /// Discards the data of the last matrix, after equations have been renumbered.
  void forget_matrix();
  /// The deferred part of the last tangent, which the matrix does not contain.
  const newton::MatrixPart& beside_matrix() const { return beside_; }
  /// True if the last tangent has loads as unknowns of the matrix.
  bool has_unknown_loads() const { return !unknown_loads_.empty(); }
  /// Eliminates the unknowns of nodes from the rows of their loads, if the matrix permits it. The tangents of all
  /// contacts have to be in the matrix. Returns the row operations.
  newton::RowOperations eliminate_nodes(FEGlobalMatrix& matrix) const;

 private:
  using Location = mixture_contact::ContactInterface::Location;
  using UseBlock = std::function<void(const std::vector<int>& equations)>;
  /// Receives a load in mixed form, and the equations of the unknowns on which it depends.
  using UseLoad = std::function<void(const UnknownLoad& load, const std::vector<int>& others)>;
  /// Receives the equations of a node, and those of the unknowns on which its row depends.
  using UseRow = std::function<void(const std::vector<int>& own, const std::vector<int>& others)>;
  void for_each_coupling(const UseBlock& use_block, const UseLoad& use_load, const UseRow& use_row) const;
  /// The equations that a node's row of the tangent couples.
  struct CoupledRow {
    std::vector<int> own;     ///< equations of the node
    std::vector<int> others;  ///< equations of the row's columns in the matrix
    bool both_ways = false;   ///< true if the rows of those equations also contain the node's equations
  };
  CoupledRow coupled_row(const NodeEquations& equations, mixture_contact::Side first,
                         const mixture_contact::TangentBlock& row) const;
  /// The condition that adds a load to a matrix that does not contain it.
  newton::Condition condition_of(const NodeEquations& equations, mixture_contact::Side first,
                                 const mixture_contact::LoadBlock& load) const;
  /// True if couplings of a pass are deferred. This requires that its loads are unknowns of the matrix.
  bool splits(mixture_contact::Side first) const {
    return takes_rows_ && form_.has(newton::Device::deferred_coupling) &&
           form_.has(newton::Device::loads_as_unknowns) && loads_.has(first);
  }
  /// The columns of a node's row that are in FEBio's matrix.
  mixture_contact::Patch in_matrix(const NodeEquations& equations, mixture_contact::Side first,
                                   const mixture_contact::TangentBlock& row) const;
  /// A function that adds parts of a residual to FEBio's vector. It keeps references.
  static mixture_contact::ContactInterface::AddResidual adder(const NodeEquations& equations, FEGlobalVector& residual);

  const BoundContact& contact_;
  const LoadEquations& loads_;
  MatrixForm form_;          ///< properties of the matrix
  bool takes_rows_ = false;  ///< true if the matrix takes the geometric part by nodes
  /// Deferred part of the last tangent.
  newton::MatrixPart beside_;
  std::vector<UnknownLoad> unknown_loads_;          ///< loads that are unknowns of the last matrix
  std::vector<UnknownTraction> unknown_tractions_;  ///< tractions that are unknowns of the last matrix
};
