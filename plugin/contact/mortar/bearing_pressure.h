/// The fluid pressure that bears a part of the load of a contact with friction.
#pragma once

#include "integration/facing_pairs.h"

namespace mixture_contact {

/// The fluid pressure that bears a part of the load, at the nodes of one facet of a pair.
struct BearingPressure {
  Index first = 0;    ///< index of the facet's first node in the pair
  FacetVector value;  ///< nodal values of p~ - p*; empty if no fluid bears load

  bool empty() const { return value.size() == 0; }
};
/// The fluid pressure on a pair: that of the primary facet if its body has fluid, else that of the secondary facet;
/// empty if neither has fluid. `ambient`: ambient pressure p* [MPa].
BearingPressure bearing_pressure(const FacingPairs& facing, const FacetPair& pair, const FacingFields& fields,
                                 double ambient);

/// The excess pressure p~ - p* at a point.
double pressure_at(const BearingPressure& pressure, const PointKinematics& point);
/// Variation of the excess pressure with respect to the nodal positions at fixed nodal values: its change as the point
/// moves on its facet.
PairVariation<1> pressure_variation(const BearingPressure& pressure, const PointKinematics& point,
                                    const KinematicVariations& vary);
/// Derivatives of the excess pressure at a point with respect to the values of p~ at the nodes of the pair.
PairVector pressure_weights(const BearingPressure& pressure, const PointKinematics& point);

}  // namespace mixture_contact
