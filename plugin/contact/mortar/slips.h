/// The variables of friction, averaged around the nodes in contact: slip, normal, how the surface has moved since the
/// step began, and the fluid pressure.
#pragma once

#include "geometry/slip.h"
#include "mortar/mortar_space.h"

namespace mixture_contact {

NodalFriction average_slips(const MortarSpace& space, const NodalLoads& loads, const FacingFields& fields);

/// Sets F_a of the nodes in contact: how the surface has moved since the step began.
void set_convection(NodalFriction& friction, const MortarSpace& space, const NodeFlags& in_contact,
                    const Matrix3Xd& x1);

/// F_a = sum_b x_b C_b^T: the mean over the primary facets around a node that face the other surface, weighted with
/// their areas there when the step began. `pairs`: those around the node; one column per node of `primary`, which holds
/// all nodes of these facets.
Matrix3Xd convection_around(const MortarSpace& space, Index node, const PairsAround& pairs,
                            const IndexedVector<int>& primary);

/// Nodes of both facets of a pair, where they were when the step began.
struct PastFacets {
  FacetCoordinates primary;
  FacetCoordinates secondary;
};
PastFacets past_facets(const MortarSpace& space, const FacetPair& pair);

/// The fluid pressure that bears a part of the load, as it acts on the nodes of one facet of a pair.
struct BearingPressure {
  Index first = 0;    ///< where the nodes of its facet begin in the pair
  FacetVector value;  ///< nodal values of p~ - p*; empty if no fluid bears load

  bool empty() const { return value.size() == 0; }
};
BearingPressure bearing_pressure(const MortarSpace& space, const FacetPair& pair, const FacingFields& fields);

/// The pressure at a point, and how it varies with the place of the point, shape functions held.
double pressure_at(const BearingPressure& pressure, const PointKinematics& point);
PairVariation<1> pressure_variation(const BearingPressure& pressure, const PointKinematics& point,
                                    const KinematicVariations& vary);
/// Its weights with the values at the nodes of the pair.
PairVector pressure_weights(const BearingPressure& pressure, const PointKinematics& point);

}  // namespace mixture_contact
