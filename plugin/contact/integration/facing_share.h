/// The facing share: a weight from 0 to 1 of a pair of facets, by the angle between them.
///
/// A gap along a normal n1 is the distance between the surfaces divided by c = -n1.n2. The side of a body next to a
/// contact edge may lean towards the other body at c near 0. Its gaps are then many times the distance, and would
/// dominate the average gaps of the nodes on the edge. The weights of integration points are therefore multiplied by a
/// share that depends on c:
///
/// - The share is 1 from c = 1/sqrt(3) on. A body with right-angled corners that rests on a plane has at least
///   one face with this c in any position. A cube on its corner has it on three faces.
/// - The share is 0 up to c = 1/sqrt(5), where a side leans by half of its length. The sides of a soft block that is
///   pressed to half its height lean by 0.4.
/// - The share grows smoothly in between, and no angle makes a pair appear or disappear abruptly. Within these
///   9 degrees, the mean normal of the nodes on a contact edge turns from one side of the body to both. A narrower
///   interval takes more iterations where an edge tilts under friction.
///
/// n1 and n2 are the normals in the middle of the two facets: a pair has one share.
#pragma once

#include "geometry/facet.h"

namespace mixture_contact {

/// Values of c = -n1.n2 at which the share begins to grow from 0, and at which it reaches 1.
inline constexpr double least_opposition = 0.44721359549996;  // 1/sqrt(5), rounded up
inline constexpr double full_opposition = 0.57735026918962;   // 1/sqrt(3), rounded down
/// The search distance ahead of a facet for parallel facets, divided by the facet's longest edge. Parallel facets
/// farther away touch none of its nodes where surfaces bend gently, but would distort the nodal averages.
inline constexpr double parallel_reach = 0.25;

/// Unit normal in the middle of a facet.
Vector3d middle_normal(FacetType type, const FacetCoordinates& x);
inline Vector3d middle_normal(const Facet& facet, const Matrix3Xd& positions) {
  return middle_normal(facet.type, facet_coordinates(facet, positions));
}

/// The facing share of two facets with these unit normals in their middles, 0 to 1.
double facing_share(const Vector3d& n1, const Vector3d& n2);

/// Factor by which the search distance ahead of a facet is larger for a facet with normal n2 than for a parallel one. A
/// facet of length L that touches at one end and is turned there by an angle t has its other end at a distance of L
/// tan(t).
double tilted_reach(const Vector3d& n1, const Vector3d& n2);
/// The largest value of tilted_reach(), at c = least_opposition.
double largest_tilted_reach();

/// Relative variation d(share)/share of a pair with a positive share, with the positions of the nodes of the first
/// facet, then of the second one.
PairVariation<1> facing_share_variation(FacetType first, const FacetCoordinates& x1, FacetType second,
                                        const FacetCoordinates& x2);

}  // namespace mixture_contact
