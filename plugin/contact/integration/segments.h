/// Segment integration: each primary facet is cut into the pieces that face different secondary facets, and the
/// integral is taken piece by piece, exactly where fields of the secondary side have kinks at its facets' edges.
///
/// Facets of both sides are polygons through their nodes (quadratic ones: four polygons whose straight edges
/// join neighbouring nodes), seen along the normal in the middle of the primary polygon (Puso and Laursen 2004, Comput
/// Methods Appl Mech Eng 193:601-629; Puso, Laursen and Solberg 2008, 197:555-566). Points on their overlap follow its
/// area, centroid and covariance (polygon_quadrature.h). A point of such a piece is carried along that normal to the
/// primary facet, and from there along the facet's own normal, as everywhere, to the secondary one.
#pragma once

#include "integration/clipping.h"
#include "integration/edge_neighbours.h"
#include "integration/points.h"

#include <map>

namespace mixture_contact {

struct Circle;

/// Order of the rule on the pieces where the user gives none: 2 where the shape functions of both facets have no term
/// beyond the second degree (tri3, tri6, quad4), else 3. It makes a uniform load exact on flat triangles and
/// parallelograms; psi times an affine gap with 4.
int default_segment_order(FacetType primary, FacetType secondary);

/// Integration points on the segments of facing facets.
///
/// A secondary facet counts only where no other one, which is not its neighbour, lies nearer within its overlap with
/// the primary facet. The weights of its points are multiplied by the share of both facets (facing_share.h).
///
/// The view of facets of each other ends with a jump: farther ahead than they look, or where a body comes between. Two
/// facets that lose each other for the second time between iterations are at such an edge: until the iterations end
/// they see each other.
class Segments : public PointFinder {
 public:
  /// order: of the quadrature rule on the pieces; 0: default_segment_order. neighbours: of secondary facets.
  Segments(const IndexedVector<Facet>& primary, const IndexedVector<Facet>& secondary, int order, SelfContact self = {},
           EdgeNeighbours neighbours = {}, Visibility visibility = {});

  FacetPairs search(const Matrix3Xd& x1, const Matrix3Xd& x2, const Reach& reach) override;
  FacetPairs on_same_facets(const Matrix3Xd& x1, const Matrix3Xd& x2) override;
  bool begin_iteration() override;
  bool end_iterations() override;
  bool moves_points() const override { return true; }
  void for_each_motion(const FacetPair& pair, const PointsOfPair& points, const Matrix3Xd& x1, const Matrix3Xd& x2,
                       const UseMotion& use) const override;
  std::size_t memory() const override {
    return self_.memory() + neighbours_.memory() + visibility_.memory() + paired_.capacity() * sizeof(Facing);
  }

 private:
  struct Facing {
    int primary = 0;
    int secondary = 0;
    bool operator<(const Facing& other) const {
      return primary != other.primary ? primary < other.primary : secondary < other.secondary;
    }
  };
  static constexpr int most_losses = 2;
  /// The secondary facets that may face a primary one.
  std::vector<int> candidates(int facet, const FacetTree& tree, const Matrix3Xd& x1, const Reach& reach) const;
  /// Whether two facets are at the edge of their view of each other.
  bool is_kept(const FacetPair& pair) const;
  /// Whether the facets of a pair face each other at one of its points.
  bool sees(const FacetPair& pair, const IntegrationPoint& point, const Matrix3Xd& x1, const Matrix3Xd& x2,
            const Reach& reach) const;
  /// Whether another one of the pairs of its primary facet lies nearer; `circles`: around secondary facets.
  bool occluded(const FacetPair& pair, const FacetPairs& all, const Matrix3Xd& x1, const Matrix3Xd& x2,
                const IndexedVector<Circle>& circles) const;
  int order(const Facing& facing) const;
  /// Whether the rule for a pair is exact: both facets are flat, and the integrand is of the second degree.
  bool is_exact(const FacetPair& pair) const;

  const IndexedVector<Facet>& primary_;
  const IndexedVector<Facet>& secondary_;
  int order_;
  SelfContact self_;
  EdgeNeighbours neighbours_;
  Visibility visibility_;
  std::vector<Facing> paired_;        ///< result of the last search(), ascending
  std::vector<Facing> at_iteration_;  ///< result at the start of the iteration
  std::map<Facing, int> losses_;      ///< how often pairs were lost since the iteration before
};

}  // namespace mixture_contact
