/// Augmented Lagrangian updates: lambda takes the load of a converged solution; slow fields get a larger penalty.
#pragma once

#include "conditions/nodal_laws.h"

#include <cmath>
#include <vector>

namespace mixture_contact {

/// How well one field meets its condition over the contact area.
struct FieldGap {
  double relative = 0;  ///< rms gap or jump over the drop across the adjoining elements that the load causes [-]
  double largest = 0;   ///< largest |gap| or |jump| in contact, in the field's unit
};

/// Gaps of all fields: traction, each exchanged scalar field in the order of Effects, friction.
struct GapReport {
  FieldGap traction;
  IndexedVector<FieldGap> flux;
  FieldGap slip = {};  ///< of nodes that stick
};

/// The larger of two values; not a number if one of them is none, so that a failed evaluation never looks converged.
inline double larger(double one, double other) { return one > other || std::isnan(one) ? one : other; }

/// Gaps and jumps of the nodes in contact, given the loads at a state.
///
/// The relative measure is free of units: rms(eps0 gap)/rms(load), with eps0 the stiffness or conductance of the
/// adjoining elements. Where no load flows, the jump is compared with the field's own size instead, so 0/0 never
/// arises; and a jump within NodalLaws::field_rounding() is none, so that a pressure that nothing drives is
/// converged.
GapReport measure_gaps(const NodalLaws& laws, const NodalLoads& loads, const FacingFields& fields);

/// Whether a report meets the tolerances of the settings.
bool meets(const GapReport& report, const Tolerances& tolerances, const Effects& effects);

/// Tenfold penalties for the fields that miss the relative tolerance, up to the automatic penalties: plain
/// Uzawa converges by a factor of k/(k + eps) an update, k the bodies' own conductance, and so crawls where eps is
/// small. Returns whether any has grown.
bool grow_penalties(NodalLaws& laws, const GapReport& report, const Tolerances& tolerances);

}  // namespace mixture_contact
