/// The ways in which a pass evaluates the integral (2.5), by the motion of the nodes of its surfaces.
#pragma once

#include "active_set/active_set.h"
#include "enforcement/enforcement_method.h"

namespace mixture_contact {

/// Recipients of the parts of a tangent.
struct TangentParts {
  AddBlock block;
  AddLoadBlock load;  ///< load blocks, where tangents consist of them; empty: all come as their products
  AddRows rows;       ///< held geometric parts by nodes; empty: blocks by pairs of facets
};

/// Recipients of the couplings of a tangent.
struct Couplings {
  UsePatch patch;
  UseLoad load;  ///< couplings through a load alone, if tangents consist of load blocks; empty: all are patches
  UseRows rows;  ///< couplings by held geometric parts; empty: all are patches
};

class HeldLinearisation;

/// Surfaces that move, or that are fixed. Independent of how conditions are enforced: either goes with any
/// EnforcementMethod.
class ContactGeometry {
 public:
  ContactGeometry() = default;
  ContactGeometry(const ContactGeometry&) = delete;
  ContactGeometry& operator=(const ContactGeometry&) = delete;
  ContactGeometry(ContactGeometry&&) = delete;
  ContactGeometry& operator=(ContactGeometry&&) = delete;
  virtual ~ContactGeometry() = default;

  /// Takes over a projection.
  virtual void update(const FacingPositions& x) = 0;

  /// The functions that ContactPass documents under the same names.
  virtual bool begin_iteration(const FacingFields& fields) = 0;
  virtual void hold_loads(const FacingFields& fields) = 0;
  virtual void relinearise(const FacingFields& fields) = 0;
  virtual void start_inactive(const FacingFields& fields) = 0;
  virtual void take_multipliers() = 0;
  virtual void end_iterations() = 0;
  /// Drops all data of past iterations, so that later ones depend on the state alone.
  virtual void forget_past() = 0;
  /// Retries edge nodes of a solution (see ActiveSet::reconsiders_edge()). Returns whether the solution has any.
  virtual bool reconsiders_edge(const FacingFields& fields) = 0;
  virtual bool is_solution(const FacingFields& fields) const = 0;
  /// The linearisation of iterations; null if surfaces are fixed and gaps linear by themselves.
  virtual HeldLinearisation* held() = 0;

  virtual NodalLoads loads(const FacingFields& fields) const = 0;
  virtual NodeFlags flux_coupled() const = 0;
  virtual void residual(const FacingFields& fields, double dt, const AddVector& add) const = 0;
  virtual void tangent(const FacingFields& fields, double dt, const TangentParts& add) const = 0;
  virtual void for_each_coupling(const Couplings& use) const = 0;
  /// Bytes kept between calls.
  virtual std::size_t memory() const = 0;
};

/// Calls `add` with the tangents of all nodes, in their order.
void node_tangents(const EnforcementMethod& method, const MortarSpace& space,
                   const IndexedVector<NodeLinearisation>& nodes, const NodalLoads& loads, const VectorXd& weights,
                   double dt, const TangentParts& add);

/// Whether the loads at nodes are separate from the other parts.
inline bool takes_loads(const EnforcementMethod& method, const Couplings& use) {
  return use.load && method.has_load_blocks();
}
/// Calls `use` with the couplings of the loads at a node, given the patch around it.
void use_node(const EnforcementMethod& method, const MortarSpace& space, Index node, const Patch& patch,
              const Couplings& use);

/// Calls `use` with the couplings of each effect of a patch.
void use_effects(const MortarSpace& space, const Patch& patch, const UsePatch& use);

}  // namespace mixture_contact
