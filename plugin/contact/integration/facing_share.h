/// The weight of two facets for each other, by the angle between them.
///
/// A gap along a normal n1 is the distance between the surfaces over c = -n1.n2. A side that turns away from contact at
/// an edge and leans a little still faces the other body, at c near 0: its gaps are many times the distance, and
/// averages around the nodes of the edge would be lost in them. Facets therefore count for each other by a share that
/// depends on c:
///
/// - All of it from c = 1/sqrt(3) on. One face of a body with right-angled corners has that at least, however it
///   rests on a plane; a cube on its corner has it on all three.
/// - Nothing up to c = 1/2, where the side of an edge leans by 30 degrees, or 0.58 of its length: the sides of a soft
///   block that is pressed to half its height lean by 0.4.
/// - In between the share grows smoothly, so that no lean switches anything on or off.
///
/// The normals are those in the middle of both facets: the share is one number for a pair.
#pragma once

#include "geometry/facet.h"

namespace mixture_contact {

/// Bounds of c = -n1.n2 between which the share grows.
inline constexpr double least_opposition = 0.5;
inline constexpr double full_opposition = 0.57735026918962;  // 1/sqrt(3), not more
/// The distance of the search between parallel facets, over the longest edge of the searching one: farther facets touch
/// no node of it if surfaces bend gently, but would spoil its averages.
inline constexpr double parallel_reach = 0.25;

/// Unit normal in the middle of a facet.
Vector3d middle_normal(FacetType type, const FacetCoordinates& x);

/// The share of facets with these unit normals, from 0 to 1.
double facing_share(const Vector3d& n1, const Vector3d& n2);

/// Extra distance of the search between facets with these normals, compared with parallel ones. A facet of length L
/// that touches with one end and is turned by an angle t there has its other end L tan(t) away along its normal.
double tilted_reach(const Vector3d& n1, const Vector3d& n2);
/// The largest of it, where the share ends.
double largest_tilted_reach();

/// d(share)/share of a pair of facets that have one, with the nodes of the first and then of the second facet.
PairVariation<1> facing_share_variation(FacetType first, const FacetCoordinates& x1, FacetType second,
                                        const FacetCoordinates& x2);

}  // namespace mixture_contact
