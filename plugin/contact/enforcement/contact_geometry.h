/// Evaluation of the integral (2.5) by a pass, for surfaces that move and for surfaces that are fixed.
#pragma once

#include "enforcement/pass_parts.h"

namespace mixture_contact {

/// Functions that receive the parts of a tangent.
struct TangentParts {
  AddBlock block;
  AddLoadBlock load;  ///< load blocks; if empty, each load block is passed to `block` as a matrix
  AddRows rows;       ///< held geometric parts by nodes; if empty, they are passed to `block` by pairs of facets
};

/// Functions that receive the couplings of a tangent, for a matrix profile.
struct Couplings {
  /// Couplings of all unknowns of a patch.
  UsePatch patch;
  UseLoad load;  ///< couplings through a load block; if empty, they are passed to `patch`
  UseRows rows;  ///< couplings of held geometric parts; if empty, they are passed to `patch`
};

class MovingGeometry;

/// The evaluation of a pass whose surfaces move (MovingGeometry) or are fixed (FixedGeometry). It can be combined with
/// any EnforcementMethod.
class ContactGeometry : public Polymorphic {
 public:
  /// Updates the data that depend on the pairs after a projection at positions x.
  virtual void update(const FacingPositions& x) = 0;

  /// Notes that the multipliers have been augmented.
  virtual void take_multipliers() {}
  /// Ends the iterations, such that the laws apply to the true gaps and jumps.
  virtual void end_iterations() = 0;
  /// The iterations of surfaces that move; null for fixed surfaces, whose loads are linear by themselves.
  virtual MovingGeometry* moving() { return nullptr; }

  /// The loads of the laws at the nodes.
  virtual NodalLoads loads(const FacingFields& fields) const = 0;
  /// Primary nodes that are in contact and flux-coupled.
  virtual NodeFlags flux_coupled() const = 0;
  /// Calls `add` with the residual of (2.5), one part per pair of facets that carries load.
  virtual void residual(const FacingFields& fields, double dt, const AddVector& add) const = 0;
  /// Calls `add` with the tangent (2.6), effect by effect. The geometric part comes per pair of facets that carries
  /// load, or summed at nodes. The part of the laws comes per node in contact, and couples all nodes of its averages.
  virtual void tangent(const FacingFields& fields, double dt, const TangentParts& add) const = 0;
  /// Calls `use` with the patches of tangent(), for a matrix profile.
  virtual void for_each_coupling(const Couplings& use) const = 0;
  /// Memory kept between calls [bytes].
  virtual std::size_t memory() const = 0;
};

/// Calls `add` with the tangents of all nodes in order. `weights`: EnforcementMethod::equation_weights().
void node_tangents(const PassParts& pass, const IndexedVector<NodeLinearisation>& nodes, const NodalLoads& loads,
                   const VectorXd& weights, double dt, const TangentParts& add);

/// True if the couplings of nodal loads are passed on as loads.
inline bool takes_loads(const PassParts& pass, const Couplings& use) { return use.load && pass.has_load_blocks(); }
/// Calls `use` with the couplings of the loads at a node. `patch`: the nodes and fields of its averages.
void use_node(const PassParts& pass, Index node, const Patch& patch, const Couplings& use);

/// Calls `use` with the couplings of each effect of a patch.
void use_effects(const MortarSpace& space, const Patch& patch, const UsePatch& use);

}  // namespace mixture_contact
