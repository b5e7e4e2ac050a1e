/// Nodal averages for friction: slip, normal, convection F_a of the surface since the start of the step, and fluid
/// pressure. They are empty without friction.
#pragma once

#include "geometry/slip.h"
#include "mortar/mortar_space.h"

namespace mixture_contact {

/// True if the averages of a node include its convection.
inline bool convects(const MortarSpace& space) { return space.effects().has_friction(); }

/// The averages for friction at the nodes in contact.
NodalFriction average_slips(const MortarSpace& space, const NodalLoads& loads, const FacingFields& fields);

/// Sets the convection F_a of the nodes in contact: how the surface around a node has deformed since the start of the
/// step. `x1`: present positions of the primary surface.
void set_convection(NodalFriction& friction, const MortarSpace& space, const NodeFlags& in_contact,
                    const Matrix3Xd& x1);

/// The coefficients C_b of F_a = sum_b x_b C_b^T, one column per node of `primary`. F_a is the mean over the paired
/// primary facets around a node, weighted with their areas at the start of the step.
///
/// `pairs`: the pairs around the node. `primary`: primary nodes that include all nodes of these facets.
Matrix3Xd convection_around(const MortarSpace& space, Index node, const PairsAround& pairs,
                            const IndexedVector<int>& primary);

/// Positions of the nodes of a pair's facets at the start of the step.
struct PastFacets {
  FacetCoordinates primary;
  FacetCoordinates secondary;
};
PastFacets past_facets(const MortarSpace& space, const FacetPair& pair);

/// The fluid pressure that bears a part of the load, at the nodes of one facet of a pair.
struct BearingPressure {
  Index first = 0;    ///< index of the facet's first node in the pair
  FacetVector value;  ///< nodal values of p~ - p*; empty if no fluid bears load

  bool empty() const { return value.size() == 0; }
};
/// The fluid pressure on a pair: that of the primary facet if its body has fluid, else that of the secondary facet;
/// empty if neither has fluid.
BearingPressure bearing_pressure(const MortarSpace& space, const FacetPair& pair, const FacingFields& fields);

/// The excess pressure p~ - p* at a point.
double pressure_at(const BearingPressure& pressure, const PointKinematics& point);
/// Variation of the excess pressure with respect to the nodal positions at fixed nodal values: its change as the point
/// moves on its facet.
PairVariation<1> pressure_variation(const BearingPressure& pressure, const PointKinematics& point,
                                    const KinematicVariations& vary);
/// Derivatives of the excess pressure at a point with respect to the values of p~ at the nodes of the pair.
PairVector pressure_weights(const BearingPressure& pressure, const PointKinematics& point);

}  // namespace mixture_contact
