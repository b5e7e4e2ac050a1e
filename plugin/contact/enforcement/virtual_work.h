/// The virtual work (2.5) of loads that are interpolated from the nodes, and its change with the geometry (2.6).
#pragma once

#include "enforcement/enforcement_method.h"
#include "mortar/loaded_points.h"

#include <optional>

namespace mixture_contact {

/// Residual at the nodes of pairs of facets that carry load, in one part for all pairs that exchange the same fields.
void nodal_residual(const MortarSpace& space, const NodalLoads& loads, const FacingFields& fields, double dt,
                    const AddVector& add);

/// Residual of loads at the nodes of a linearisation, whose works are those of the state that it was made at.
void linear_residual(const IndexedVector<NodeLinearisation>& nodes, const NodalLoads& loads, const FacingFields& fields,
                     double dt, const AddVector& add);

/// The geometric part of the tangent of one effect of a pair. `Flat`: FlatForces or FlatFlows.
template <class Flat>
struct EffectTangent {
  TangentBlock block;        ///< without values where `flat` has them
  std::optional<Flat> flat;  ///< of a flat pair, except in a symmetric tangent
};
using TractionTangent = EffectTangent<FlatForces>;
using FluxTangent = EffectTangent<FlatFlows>;

/// Blocks with their values.
TangentBlock with_values(const TractionTangent& tangent);
TangentBlock with_values(const FluxTangent& tangent);

/// The part of the tangent in which loads stay and the geometry changes, of a pair.
struct GeometricTangent {
  TractionTangent traction;         ///< friction included
  std::vector<FluxTangent> fluxes;  ///< proportional to the time increment; none in a symmetric tangent
};

/// Geometric tangents of the pairs of a pass, in their order; empty for a pair that carries no load.
using GeometricParts = IndexedVector<std::optional<GeometricTangent>>;

GeometricTangent geometric_tangent(const MortarSpace& space, const FacetPair& pair, const VaryingPair& varying);
/// Sets `tangent` to the geometric tangent of a pair and reuses its memory, which may be another pair's.
void set_geometric_tangent(const MortarSpace& space, const FacetPair& pair, const VaryingPair& varying,
                           GeometricTangent& tangent);

/// Calls `add` with the geometric tangent of each pair that carries load, effect by effect. `dt`: time increment [s].
void geometric_tangents(const MortarSpace& space, const NodalLoads& loads, const FacingFields& fields, double dt,
                        const AddBlock& add);

}  // namespace mixture_contact
