/// Integration points with loads that are interpolated from nodal loads.
#pragma once

#include "mortar/mortar_space.h"
#include "mortar/point_integral.h"

#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace mixture_contact {

/// An integration point with its kinematics and loads.
struct PointContact {
  /// A point of a pair whose loads are still to be set. It keeps references to both arguments.
  PointContact(const FacetPair& of, const PointKinematics& at) : pair(&of), kinematics(at) {}

  const FacetPair* pair;
  const PointKinematics& kinematics;
  FacetVector psi;             ///< functions psi_a at the point
  FacetGradient psi_gradient;  ///< gradients psi_a,alpha of these functions
  IndexedVector<int> fields;   ///< exchanged scalar fields at the point, by their indices in Effects
  PairFields values;           ///< values of these fields at the nodes of the pair
  PointLoads loads;
};

/// An integration point with the first variations of its kinematics.
struct VaryingPoint {
  VaryingPoint(PointContact at, const PointMotion& motion)
      : contact(std::move(at)), vary(kinematic_variations(contact.kinematics, motion)) {}

  PointContact contact;
  KinematicVariations vary;

  /// Variation d|a| + |a| dw/w of the weighted area element.
  PairVariation<1> weighted_area_variation() const {
    if (!vary.wanders()) return vary.area;
    return vary.area + contact.kinematics.area * vary.weight;
  }
};

/// The loads at the nodes of a primary facet.
struct FacetLoads {
  FacetVector traction;             ///< normal tractions t_n
  FacetCoordinates friction;        ///< friction tractions, one column per node; no columns without friction
  IndexedVector<FacetVector> flux;  ///< fluxes per exchanged field
};
/// The loads at the nodes of a facet. `fields`: indices of the exchanged fields.
FacetLoads facet_loads(const Facet& facet, const NodalLoads& loads, const IndexedVector<int>& fields);

/// The loads interpolated with the functions psi_a of a facet at a point; quadrature weight and slopes are not set.
PointLoads loads_at(const FacetLoads& nodal, const FacetVector& psi);

/// A flat pair with its variations and nodal loads.
struct VaryingFlatPair {
  FlatPair pair;
  FlatVariations vary;
  Vector3d traction;             ///< normal tractions of the primary nodes
  IndexedVector<Vector3d> flux;  ///< per exchanged field: fluxes of the primary nodes times the time increment
};

/// A pair with its first variations, as a flat pair with moments or as points.
struct VaryingPair {
  std::optional<VaryingFlatPair> flat;
  std::vector<VaryingPoint> points;  ///< empty for a flat pair
};

/// The first variations of a pair with the given nodal loads. `dt`: time increment [s].
VaryingPair varying_pair(const MortarSpace& space, const FacetPair& pair, const NodalLoads& loads,
                         const FacingFields& fields, double dt);
/// Sets `varying` to varying_pair() with the same arguments. It reuses the memory of `varying`, which may contain
/// another pair.
void set_varying_pair(const MortarSpace& space, const FacetPair& pair, const NodalLoads& loads,
                      const FacingFields& fields, double dt, VaryingPair& varying);

/// Calls `use` for every integration point of a pair, in order. The pair must not be a flat pair with moments.
void for_each_loaded_point(const MortarSpace& space, const FacetPair& pair, const NodalLoads& loads,
                           const FacingFields& fields, double dt, const std::function<void(const PointContact&)>& use);

}  // namespace mixture_contact
