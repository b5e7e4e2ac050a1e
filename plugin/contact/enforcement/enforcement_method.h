/// The enforcement of the conditions of contact at nodes, by penalties or by unknown multipliers.
#pragma once

#include "conditions/nodal_laws.h"
#include "mortar/linearisation.h"

#include <functional>
#include <memory>

namespace mixture_contact {

using AddVector = std::function<void(const Patch&, const VectorXd&)>;
using AddBlock = std::function<void(const TangentBlock&)>;
/// Blocks of one effect, each with the rows of one node, times a factor.
using AddRows = std::function<void(const IndexedVector<TangentBlock>&, double factor)>;
using UsePatch = std::function<void(const Patch&)>;
using AddLoadBlock = std::function<void(const LoadBlock&)>;
using UseLoad = std::function<void(const LoadPlace&)>;
/// Blocks of one effect, each with the rows of one node.
using UseRows = std::function<void(const IndexedVector<TangentBlock>&)>;

/// The tangent of the loads at a node and of the node's equations: the sum of all its parts.
struct NodeTangent {
  std::vector<TangentBlock> blocks;
  std::vector<LoadBlock> loads;
};

/// A way to enforce the conditions. Evaluations are const.
class EnforcementMethod {
 public:
  /// Keeps references.
  EnforcementMethod(const MortarSpace& space, const NodalLaws& laws) : space_(space), laws_(laws) {}
  EnforcementMethod(const EnforcementMethod&) = delete;
  EnforcementMethod& operator=(const EnforcementMethod&) = delete;
  EnforcementMethod(EnforcementMethod&&) = delete;
  EnforcementMethod& operator=(EnforcementMethod&&) = delete;
  virtual ~EnforcementMethod() = default;

  /// Loads of the nodes in contact from the averages around them.
  virtual void load(NodalLoads& loads) const = 0;
  /// Loads within an iteration.
  virtual NodalLoads predicted_loads(const LinearisationPoint& point, const FacingFields& fields) const = 0;
  /// Whether predicted loads may differ from those of the true averages.
  virtual bool predicts() const = 0;
  /// Weights of the equations that the method adds at nodes, of the size of their fields' residual.
  virtual VectorXd equation_weights(const NodalLoads& loads, const Matrix3Xd& x1) const = 0;
  /// Calls `use` with the couplings of the loads at the nodes of a patch, as their averages vary.
  virtual void for_each_coupling(const Patch& patch, const UsePatch& use) const = 0;
  /// Whether tangents consist of load blocks alone.
  virtual bool has_load_blocks() const = 0;
  /// Residual of these equations.
  virtual void equations(const NodalLoads& loads, const VectorXd& weights, double dt, const AddVector& add) const = 0;
  /// Tangent of the loads at a node, and of its equations. The residual holds t_a traction_work + dt phi_a A_a weights;
  /// the variation of the works is the geometric part.
  virtual NodeTangent node_tangent(Index node, const NodeLinearisation& linear, const NodalLoads& loads,
                                   const VectorXd& weights, double dt) const = 0;
  /// The unknowns of the law of a field's flux, given the patch around a node: fields in the order of the columns, its
  /// own first; its own alone in a symmetric tangent.
  Patch flux_columns(const Patch& patch, int field) const;

 protected:
  /// Variation of a flux with displacements, if there are any, and fields, in the order of `columns`.
  VectorXd flux_row(const FluxLaw& law, Index node, const NodeLinearisation& linear, const Patch& columns) const;
  const MortarSpace& space() const { return space_; }
  const NodalLaws& laws() const { return laws_; }
  const Effects& effects() const { return space_.effects(); }

 private:
  const MortarSpace& space_;
  const NodalLaws& laws_;
};

/// The method by the settings.
std::unique_ptr<EnforcementMethod> enforcement_method(Enforcement enforcement, const MortarSpace& space,
                                                      const NodalLaws& laws);

/// A block of tractions by displacements; its symmetric part if the tangent is symmetric.
TangentBlock traction_block(const MortarSpace& space, const Patch& patch, MatrixXd values);
/// Completes a block of tractions by displacements that has its values, and its patch as `rows`: sets the columns,
/// leaves displacements alone as unknowns, and takes the symmetric part of the values if the tangent is symmetric.
void set_traction_block(const MortarSpace& space, TangentBlock& block);

}  // namespace mixture_contact
