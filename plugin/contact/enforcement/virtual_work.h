/// The virtual work (2.5) of loads that are interpolated from the nodes, and its change with the geometry (2.6).
#pragma once

#include "enforcement/enforcement_method.h"
#include "mortar/loaded_points.h"

#include <optional>

namespace mixture_contact {

/// Calls `add` with the residual of all pairs of facets that carry load, one part for all pairs that exchange the same
/// fields.
void nodal_residual(const MortarSpace& space, const NodalLoads& loads, const FacingFields& fields, double dt,
                    const AddVector& add);

/// Calls `add` with the residual of nodal loads that act through the virtual works of a linearisation.
void linear_residual(const IndexedVector<NodeLinearisation>& nodes, const NodalLoads& loads, const FacingFields& fields,
                     double dt, const AddVector& add);

/// The geometric part of the tangent of one effect of a pair. Flat: FlatForces or FlatFlows.
template <class Flat>
struct EffectTangent {
  TangentBlock block;        ///< the block; without values if `flat` contains them
  std::optional<Flat> flat;  ///< terms of a flat pair; empty for other pairs and for a symmetric tangent
};
using TractionTangent = EffectTangent<FlatForces>;
using FluxTangent = EffectTangent<FlatFlows>;

/// The block of a tangent with its values.
TangentBlock with_values(const TractionTangent& tangent);
TangentBlock with_values(const FluxTangent& tangent);

/// The geometric part of the tangent of a pair: the derivative of the residual at constant nodal loads.
struct GeometricTangent {
  TractionTangent traction;  ///< includes friction
  /// Per exchanged field, proportional to the time increment; empty for a symmetric tangent.
  std::vector<FluxTangent> fluxes;
};

/// Geometric tangents of the pairs of a pass, in their order. Pairs that carry no load have no entry.
using GeometricParts = IndexedVector<std::optional<GeometricTangent>>;

/// The geometric tangent of a pair with the loads in `varying`.
GeometricTangent geometric_tangent(const MortarSpace& space, const FacetPair& pair, const VaryingPair& varying);
/// Sets `tangent` to geometric_tangent() with the same arguments. It reuses the memory of `tangent`, which may be
/// another pair's.
void set_geometric_tangent(const MortarSpace& space, const FacetPair& pair, const VaryingPair& varying,
                           GeometricTangent& tangent);

/// Calls `add` with the geometric tangent of each pair that carries load, effect by effect. `dt`: time increment [s].
void geometric_tangents(const MortarSpace& space, const NodalLoads& loads, const FacingFields& fields, double dt,
                        const AddBlock& add);

}  // namespace mixture_contact
