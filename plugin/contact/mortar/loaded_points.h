/// Integration points with loads interpolated from the nodes around them.
#pragma once

#include "mortar/mortar_space.h"
#include "mortar/point_integral.h"

#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace mixture_contact {

/// An integration point that bears load, with its kinematics and loads.
struct PointContact {
  /// A point of a pair without its loads; refers to both.
  PointContact(const FacetPair& of, const PointKinematics& at) : pair(&of), kinematics(at) {}

  const FacetPair* pair;
  const PointKinematics& kinematics;
  FacetVector psi;             ///< psi_a at the point
  FacetGradient psi_gradient;  ///< psi_a,alpha
  IndexedVector<int> fields;   ///< exchanged scalar fields at the point, as indices by Effects
  PairFields values;           ///< nodal values of these fields
  PointLoads loads;  ///< interpolated from the nodes; derivatives are 0, because those of the nodes' averages are added
                     ///< separately
};

/// A point with the first variations of its kinematics.
struct VaryingPoint {
  VaryingPoint(PointContact at, const PointMotion& motion)
      : contact(std::move(at)), vary(kinematic_variations(contact.kinematics, motion)) {}

  PointContact contact;
  KinematicVariations vary;

  /// d|a| + |a| dw/w
  PairVariation<1> weighted_area_variation() const {
    if (!vary.wanders()) return vary.area;
    return vary.area + contact.kinematics.area * vary.weight;
  }
};

/// The loads of the nodes of a primary facet.
struct FacetLoads {
  FacetVector traction;
  FacetCoordinates friction;        ///< one column per node; none without friction
  IndexedVector<FacetVector> flux;  ///< per exchanged field
};
FacetLoads facet_loads(const Facet& facet, const NodalLoads& loads, const IndexedVector<int>& fields);

/// The loads for these values of the functions psi_a of a facet; without weight and slopes.
PointLoads loads_at(const FacetLoads& nodal, const FacetVector& psi);

/// A flat pair with its variations and loads.
struct VaryingFlatPair {
  FlatPair pair;
  FlatVariations vary;
  Vector3d traction;             ///< of the primary nodes
  IndexedVector<Vector3d> flux;  ///< likewise, per exchanged field, times the time increment
};

/// A pair with first variations, by moments or by points.
struct VaryingPair {
  std::optional<VaryingFlatPair> flat;
  std::vector<VaryingPoint> points;  ///< none of a flat pair
};

VaryingPair varying_pair(const MortarSpace& space, const FacetPair& pair, const NodalLoads& loads,
                         const FacingFields& fields, double dt);
/// Sets `varying` to a pair with its first variations and reuses its memory, which may be another pair's.
void set_varying_pair(const MortarSpace& space, const FacetPair& pair, const NodalLoads& loads,
                      const FacingFields& fields, double dt, VaryingPair& varying);

/// Calls `use` for every point, in order, of a pair that bears load and is not flat.
void for_each_loaded_point(const MortarSpace& space, const FacetPair& pair, const NodalLoads& loads,
                           const FacingFields& fields, double dt, const std::function<void(const PointContact&)>& use);

}  // namespace mixture_contact
