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

/// The part of the tangent in which loads stay and the geometry changes, of a pair.
struct GeometricTangent {
  std::vector<TangentBlock> fluxes;  ///< proportional to the time increment; none in a symmetric tangent
  TangentBlock traction;             ///< friction included; without values where `flat` has them
  std::optional<FlatForces> flat;    ///< of a flat pair, unless the tangent is to be symmetric
};

/// With its values.
TangentBlock traction_block(const GeometricTangent& tangent);

/// Of pairs, in their order; none of those that carry no load.
using GeometricParts = IndexedVector<std::optional<GeometricTangent>>;

GeometricTangent geometric_tangent(const MortarSpace& space, const FacetPair& pair, const VaryingPair& varying);
/// The same in the memory of that of another pair.
void set_geometric_tangent(const MortarSpace& space, const FacetPair& pair, const VaryingPair& varying,
                           GeometricTangent& tangent);

/// The same for each of these pairs.
void geometric_tangents(const MortarSpace& space, const NodalLoads& loads, const FacingFields& fields, double dt,
                        const AddBlock& add);

}  // namespace mixture_contact
