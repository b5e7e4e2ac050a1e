/// The overlap of a primary facet with a secondary facet in segment integration (segments.h): its integration points,
/// and their motion with the nodes.
#pragma once

#include "geometry/circle.h"
#include "geometry/sub_facets.h"
#include "integration/points.h"
#include "integration/polygon_quadrature.h"
#include "integration/view.h"

namespace mixture_contact {

/// A facet of a pair with its nodal coordinates.
struct PlacedFacet {
  FacetType type;
  FacetCoordinates x;
};
PlacedFacet placed(const Facet& facet, const Matrix3Xd& x);

/// The projection of a linear piece of the primary facet, with which secondary facets are clipped.
template <class Number>
struct Piece {
  const SubFacet& part;
  View view;
  Circle circle;
  Polygon<Number> polygon;
  double area = 0;  ///< twice the area of the polygon
  Alignment<Number> aligned;
};

template <class Number>
using Pieces = std::pmr::vector<Piece<Number>>;

/// A primary facet with the quantities that all its overlaps have in common.
struct SampledFacet {
  PlacedFacet placed;
  Pieces<double> pieces;
  Vector3d normal;  ///< unit normal in the middle of the facet
};
/// Divides a facet at nodal positions x into its pieces. `memory`: for the pieces.
SampledFacet sampled(const Facet& facet, const Matrix3Xd& x, std::pmr::memory_resource* memory);

/// Largest number of linear pieces of a facet.
inline constexpr std::size_t max_pieces = 6;
/// Upper bound for most facets of the memory of all pieces, with their polygons and tilts [bytes].
template <class Number>
inline constexpr std::size_t bytes_of_pieces = max_pieces *
                                               (sizeof(Piece<Number>) + max_piece_corners * sizeof(Place<Number>) +
                                                sizeof(ViewTilt));

/// Adds the points between a primary facet and a secondary facet at x2 to the last pair. `circle`: around the secondary
/// facet. `order`: order of the quadrature rule. Returns true if there is a point and all points were projected.
bool add_points_between(const SampledFacet& primary, const Facet& two, const Matrix3Xd& x2, const Circle& circle,
                        int order, FacetPairs& pairs);

/// Calls use(motion) with the motion of each point of a pair, in order. `points`: points that add_points_between()
/// found at these positions.
void for_each_overlap_motion(const PointsOfPair& points, const PlacedFacet& primary, const PlacedFacet& secondary,
                             int order, const UseMotion& use);

/// True if a segment is over the interior of a piece, not only along its outline. `from`, `to`: its ends in the view of
/// the piece.
bool lies_over(const Piece<double>& piece, const Vector2d& from, const Vector2d& to);

}  // namespace mixture_contact
