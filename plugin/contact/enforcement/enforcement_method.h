/// Enforcement of the contact conditions at nodes by penalties or by unknown multipliers.
#pragma once

#include "base/polymorphic.h"
#include "enforcement/pass_nodes.h"

#include <functional>
#include <memory>

namespace mixture_contact {

/// Receives the residual of a patch.
using AddVector = std::function<void(const Patch&, const VectorXd&)>;
/// Receives a block of the tangent.
using AddBlock = std::function<void(const TangentBlock&)>;
/// Receives blocks of one effect, each with the rows of one node; all are to be multiplied by a factor.
using AddRows = std::function<void(const IndexedVector<TangentBlock>&, double factor)>;
/// Receives a patch whose unknowns are coupled.
using UsePatch = std::function<void(const Patch&)>;
/// Receives a load block of the tangent.
using AddLoadBlock = std::function<void(const LoadBlock&)>;
/// Receives the place of a load block.
using UseLoad = std::function<void(const LoadPlace&)>;
/// Receives blocks of one effect, each with the rows of one node, for a matrix profile.
using UseRows = std::function<void(const IndexedVector<TangentBlock>&)>;

/// The tangent of a node's loads and of the node's own equations: the sum of all parts.
struct NodeTangent {
  std::vector<TangentBlock> blocks;
  std::vector<LoadBlock> loads;
};

/// A method that enforces the conditions at the nodes of a pass, which its functions receive as `at`. A method has no
/// state.
class EnforcementMethod : public Polymorphic {
 public:
  /// Sets the loads of the nodes in contact from the averages around them.
  virtual void load(const NodalLaws& laws, NodalLoads& loads) const = 0;
  /// The loads at a state within an iteration, from the averages that are linearised at `point`.
  virtual NodalLoads predicted_loads(const PassNodes& at, const LinearisationPoint& point,
                                     const FacingFields& fields) const = 0;
  /// True if predicted loads may differ from those of the true averages.
  virtual bool predicts() const = 0;
  /// True if predicted loads are linear in gaps and jumps, which excludes friction and unknown multipliers.
  virtual bool is_linear() const = 0;
  /// Weights of the equations that the method adds at nodes, which give them the size of the residual of their field.
  virtual VectorXd equation_weights(const PassNodes& /*at*/, const NodalLoads& /*loads*/,
                                    const Matrix3Xd& /*x1*/) const {
    return {};
  }
  /// Calls `use` with the couplings of the loads at the nodes of a patch that come from the variation of averages.
  virtual void for_each_coupling(const Patch& patch, const UsePatch& use) const = 0;
  /// True if tangents consist of load blocks only, unless they are symmetrised.
  virtual bool has_load_blocks() const = 0;
  /// Calls `add` with the residual of the method's own equations.
  virtual void equations(const PassNodes& /*at*/, const NodalLoads& /*loads*/, const VectorXd& /*weights*/,
                         double /*dt*/, const AddVector& /*add*/) const {}
  /// The tangent of the loads at a node, and of the node's own equations. In the residual, the loads of node a are t_a
  /// traction_work + dt phi_a A_a weights; the variation of these works belongs to the geometric part of the tangent.
  virtual NodeTangent node_tangent(const PassNodes& at, Index node, const NodeLinearisation& linear,
                                   const NodalLoads& loads, const VectorXd& weights, double dt) const = 0;
};

/// The method that the settings select. `friction`: the friction of the contact.
std::unique_ptr<EnforcementMethod> enforcement_method(Enforcement enforcement, FrictionKind friction);

/// The unknowns on which a field's flux at a node depends: nodes of `patch`, and fields in the order of the columns,
/// its own first. A symmetric tangent has its own field only.
Patch flux_columns(const PassNodes& at, const Patch& patch, int field);
/// Variation of a flux with respect to the displacements (if any) and fields in `columns`, in their order.
VectorXd flux_row(const FluxLaw& law, Index node, const NodeLinearisation& linear, const Patch& columns,
                  bool symmetric);

/// A block of tractions by displacements. `values` are symmetrised if the tangent is symmetric.
TangentBlock traction_block(const MortarSpace& space, const Patch& patch, MatrixXd values);
/// Completes a block of tractions by displacements whose values and row patch are set: it reduces the rows to
/// displacements, sets the columns, and symmetrises the values if the tangent is symmetric.
void set_traction_block(const MortarSpace& space, TangentBlock& block);

}  // namespace mixture_contact
