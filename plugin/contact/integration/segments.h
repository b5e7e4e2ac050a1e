/// Segment integration: each primary facet is cut into the pieces that face different secondary facets, and each piece
/// is integrated separately. The fields of the secondary side have kinks at the edges of its facets; these edges are
/// also edges of the pieces, so the quadrature never crosses a kink.
///
/// The facets of both sides count as polygons through their nodes (a quadratic facet: four polygons whose straight
/// edges join neighbouring nodes). They are projected along the normal in the middle of the primary polygon (Puso and
/// Laursen 2004, Comput Methods Appl Mech Eng 193:601-629; Puso, Laursen and Solberg 2008, 197:555-566). The area,
/// centroid and covariance of their overlap give the quadrature points (polygon_quadrature.h). A quadrature point is
/// projected along that normal onto the primary facet, and from there along the facet's own normal onto the secondary
/// facet.
#pragma once

#include "geometry/circle.h"
#include "integration/edge_neighbours.h"
#include "integration/points.h"

#include <map>

namespace mixture_contact {

struct SampledFacet;

/// Order of the quadrature rule on the pieces if the user gives none: 2 if no shape function of either facet is beyond
/// the second degree (tri3, tri6, quad4), else 3. It integrates a uniform load exactly on flat triangles and
/// parallelograms. Order 4 would be exact for psi times an affine gap.
int default_segment_order(FacetType primary, FacetType secondary);

/// Integration points on the overlaps of facing facets.
///
/// A secondary facet is paired with a primary one only if no other facet, except its own neighbours, is nearer within
/// their overlap. The weights of the points are multiplied by the facing share of both facets (facing_share.h).
///
/// A pair is lost abruptly where the facets move out of each other's search distance, or where a body comes between
/// them. A pair that is lost for the second time within the iterations of a step is kept until they end.
class Segments : public PointFinder {
 public:
  /// `order`: order of the quadrature rule on the pieces; 0: default_segment_order. `neighbours`: edge neighbours of
  /// the secondary facets.
  explicit Segments(int order, SelfContact self = {}, EdgeNeighbours neighbours = {}, Visibility visibility = {});

  FacetPairs search(const FacingFacets& facets, const FacingPositions& x, const Reach& reach) override;
  FacetPairs on_same_facets(const FacingFacets& facets, const FacingPositions& x) override;
  bool keep_lost_points() override;
  bool end_iterations() override;
  bool moves_points() const override { return true; }
  void for_each_motion(const FacetPair& pair, const PointsOfPair& points, const FacingFacets& facets,
                       const FacingPositions& x, const UseMotion& use) const override;
  std::size_t memory() const override {
    return self_.memory() + neighbours_.memory() + visibility_.memory() + paired_.capacity() * sizeof(Facing);
  }

 private:
  /// Indices of the facets of a pair.
  struct Facing {
    int primary = 0;
    int secondary = 0;
    bool operator<(const Facing& other) const {
      return primary != other.primary ? primary < other.primary : secondary < other.secondary;
    }
  };
  /// Number of losses from which a pair is kept.
  static constexpr int most_losses = 2;
  /// The surfaces during a search.
  struct SearchedSurfaces {
    const FacingFacets& facets;
    const FacingPositions& x;
    const Reach& reach;
    FacetTree tree;                 ///< secondary facets
    IndexedVector<Circle> circles;  ///< circles around the secondary facets
  };
  /// Sets `near` to the pairs of a primary facet. `memory`: reused memory.
  void find_pairs(int facet, const SearchedSurfaces& at, FacetPairs& near, FacetPairs& memory) const;
  /// Adds the pair of a primary and a secondary facet, if they overlap and the pair is kept or sees its points.
  void add_near(int facet, int other, const SampledFacet& one, const SearchedSurfaces& at, FacetPairs& near) const;
  /// Indices of the secondary facets near a primary one.
  std::vector<int> candidates(int facet, const SearchedSurfaces& at) const;
  /// True if the pair is kept until the iterations end, because it was lost repeatedly.
  bool is_kept(const FacetPair& pair) const;
  /// True if the facets of a pair face each other within reach, and nothing hides them, at one of the pair's points.
  bool sees(const FacetPair& pair, const IntegrationPoint& point, const SearchedSurfaces& at) const;
  /// True if another pair in `all`, on the same primary facet, has a nearer secondary facet.
  static bool occluded(const FacetPair& pair, const FacetPairs& all, const SearchedSurfaces& at);
  /// True if the pairs of a primary facet are fully covered (FacetPair::unbroken).
  bool is_fully_covered(const FacetPairs& of_facet, const SampledFacet& one, const SearchedSurfaces& at) const;
  /// Order of the quadrature rule of a pair.
  int order(const FacingFacets& facets, const Facing& facing) const;
  /// True if the quadrature is exact for a pair: both facets are flat and the order is at least 2.
  bool is_exact(const FacingFacets& facets, const FacetPair& pair) const;

  int order_;
  SelfContact self_;
  EdgeNeighbours neighbours_;
  Visibility visibility_;
  std::vector<Facing> paired_;        ///< pairs found by the last search(), ascending
  std::vector<Facing> at_iteration_;  ///< pairs at the start of the iteration, ascending
  std::map<Facing, int> losses_;      ///< how often each pair was lost within the iterations of this step
};

}  // namespace mixture_contact
