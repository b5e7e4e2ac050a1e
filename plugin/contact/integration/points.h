/// Integration points of a primary surface, grouped by the pair of facets that they lie on.
#pragma once

#include "base/lists.h"
#include "base/polymorphic.h"
#include "base/settings.h"
#include "geometry/kinematics.h"
#include "integration/search.h"
#include "integration/self_contact.h"
#include "integration/visibility.h"

#include <functional>
#include <iterator>
#include <memory>
#include <vector>

namespace mixture_contact {

/// An integration point of a pair of facets. Its point x1(xi) on the primary facet is paired with the point x2(eta) on
/// the secondary facet along the normal n1.
struct IntegrationPoint {
  Vector2d xi{0, 0};
  Vector2d eta{0, 0};
  double weight = 0;  ///< weight of the quadrature: da1 = weight |a|, a: area vector of the primary facet
  int sub_facet = 0;  ///< number of the linear piece of the primary facet that contains the point
};

/// A facet of the primary surface and a facet of the secondary surface that faces it.
struct FacetPair {
  int primary = 0;
  int secondary = 0;
  Index first = 0;   ///< index of the pair's first point among the points of all pairs
  Index points = 0;  ///< number of the pair's points
  /// True if the pair is fully covered: integrals over all pairs of its primary facet are exact, and the secondary
  /// surface continues across each edge that divides them. If such an edge moves, one pair gains the area that its
  /// neighbour loses. Sums over the pairs then do not depend on the motion of their points.
  bool unbroken = false;
};

/// The integration points of a pair, in order.
using PointsOfPair = Span<IntegrationPoint>;

/// Pairs of facets with their integration points.
class FacetPairs {
 public:
  const IndexedVector<FacetPair>& pairs() const { return pairs_; }
  PointsOfPair points(const FacetPair& pair) const { return {std::next(points_.data(), pair.first), pair.points}; }
  /// The points of all pairs, pair by pair.
  const IndexedVector<IntegrationPoint>& points() const { return points_; }

  void clear();
  /// Adds a pair without points.
  void add_pair(int primary, int secondary) { pairs_.push_back({primary, secondary, points_.count(), 0}); }
  /// Adds a point to the last pair.
  void add_point(const IntegrationPoint& point);
  /// Adds a pair of another list, with its points.
  void add(const FacetPairs& others, const FacetPair& pair);
  /// Marks all pairs as fully covered (FacetPair::unbroken).
  void set_unbroken();
  void remove_last_pair();
  /// Memory of the pairs and points [bytes].
  std::size_t memory() const;

 private:
  IndexedVector<FacetPair> pairs_;
  IndexedVector<IntegrationPoint> points_;  ///< points of all pairs, pair by pair
};

/// The ray from a point xi of a facet along the facet's outward normal. `reach` and `tolerance`: as in Ray.
Ray normal_ray(FacetType type, const FacetCoordinates& x, const Vector2d& xi, double reach, double tolerance);
inline Ray normal_ray(const Facet& facet, const Matrix3Xd& positions, const Vector2d& xi, double reach,
                      double tolerance) {
  return normal_ray(facet.type, facet_coordinates(facet, positions), xi, reach, tolerance);
}

/// A point of a pair in space.
struct PlacedPoint {
  Ray ray;         ///< ray from the primary point along the primary normal
  Vector3d apart;  ///< vector from the primary to the secondary point
  double gap() const { return apart.dot(ray.direction); }
};
PlacedPoint placed_point(const Facet& primary, const Facet& secondary, const IntegrationPoint& point,
                         const Matrix3Xd& x1, const Matrix3Xd& x2);

/// Pointers to the pairs whose primary facets contain a node.
using PairsAround = Span<const FacetPair*>;

/// Function that receives the motion of an integration point.
using UseMotion = std::function<void(const PointMotion&)>;

/// Calls `use` once for each of `points` points, with a motion of zero.
void use_no_motion(Index points, const UseMotion& use);

/// Finds the integration points of a primary surface and the points of the secondary surface that they are paired with.
/// Its functions receive the facets of both surfaces and the positions `x` of their nodes.
class PointFinder : public Polymorphic {
 public:
  /// Finds the pairs of facets that face each other within reach, in ascending order of the primary facets. Within an
  /// iteration, the result depends on the positions alone.
  virtual FacetPairs search(const FacingFacets& facets, const FacingPositions& x, const Reach& reach) = 0;

  /// Projects the points at other positions, without a search, onto the secondary facets that the last search() found
  /// for them. The result depends on that search and on the positions alone.
  virtual FacetPairs on_same_facets(const FacingFacets& facets, const FacingPositions& x) = 0;

  /// Begins a Newton iteration at the positions of the last search. The finder keeps points paired from now on that
  /// have repeatedly lost the other surface at its edge. Returns true if a search at the same positions would therefore
  /// find more pairs.
  virtual bool keep_lost_points() { return false; }

  /// Ends the iterations of a time step, or those before an augmentation: no point is kept at an edge any more. Returns
  /// true if any point was kept.
  virtual bool end_iterations() { return false; }

  /// True if the points or their weights vary with the nodal positions. If false, for_each_motion() gives zero motions.
  virtual bool moves_points() const = 0;

  /// Calls `use` with the motion of each point of a pair, in order: how the point found at these positions varies with
  /// them. The points of fully covered pairs count as fixed.
  virtual void for_each_motion(const FacetPair& pair, const PointsOfPair& points, const FacingFacets& facets,
                               const FacingPositions& x, const UseMotion& use) const = 0;

  /// Memory of the finder [bytes].
  virtual std::size_t memory() const = 0;
};

/// Makes the finder that the settings select: segments or Gauss points.
std::unique_ptr<PointFinder> point_finder(const SurfaceMesh& primary, const SurfaceMesh& secondary,
                                          const Settings& settings);

/// Gauss points at fixed parametric coordinates of the primary facets. Each point is paired with the nearest facet that
/// faces it. Its weight is the quadrature weight times the facing share of both facets (facing_share.h).
///
/// The load of a point drops to zero where the point passes the edge of the other surface. This jump may leave no
/// equilibrium on either side of the edge if a whole contact depends on one point. A point that loses its projection
/// for the second time within the iterations of a step is therefore kept until they end: it stays paired with its last
/// facet, which is extended beyond its edge.
class GaussPoints : public PointFinder {
 public:
  /// `order`: order of the quadrature rule on every primary facet, 0 for default_quadrature_order. `tolerance`:
  /// distance outside a facet within which a point still projects on it, in parametric coordinates.
  GaussPoints(const IndexedVector<Facet>& primary, int order, double tolerance, SelfContact self = {},
              Visibility visibility = {});

  FacetPairs search(const FacingFacets& facets, const FacingPositions& x, const Reach& reach) override;
  /// A point that has left its facet is paired again when it returns to that facet.
  FacetPairs on_same_facets(const FacingFacets& facets, const FacingPositions& x) override;
  bool keep_lost_points() override;
  bool end_iterations() override;
  bool moves_points() const override { return has_shares_; }  ///< true if a share below 1 varies the weights
  void for_each_motion(const FacetPair& pair, const PointsOfPair& points, const FacingFacets& facets,
                       const FacingPositions& x, const UseMotion& use) const override;
  std::size_t memory() const override;

 private:
  /// A Gauss point of a primary facet.
  struct Point {
    int facet = 0;
    Vector2d xi;
    double weight = 0;
    int sub_facet = 0;
  };
  /// Index of the facet of a point that has none.
  static constexpr int unpaired = -1;
  /// Number of lost projections from which a point is kept.
  static constexpr int most_losses = 2;
  /// The secondary facets that a point was paired with at several times; `unpaired` if it had none.
  struct ProjectionHistory {
    int facet = unpaired;         ///< facet found by the last search()
    int at_iteration = unpaired;  ///< facet at the start of the iteration
    int last = unpaired;          ///< last facet found at the start of an iteration of this step
    int losses = 0;               ///< how often the projection was lost within the iterations of this step

    /// True if the point is kept on its last facet beyond the edge.
    bool is_kept() const { return losses >= most_losses; }
  };

  /// The point of the secondary surface that a Gauss point is paired with.
  struct Partner {
    int facet;
    Vector2d eta;
    double share;  ///< facing share of the two facets
  };
  /// Makes the pairs from the partner that `partner_of` returns for each point, if any.
  FacetPairs paired(const std::function<std::optional<Partner>(Index)>& partner_of);
  /// The search ray of a Gauss point of this facet.
  Ray ray_from(const Point& point, const Facet& facet, const Matrix3Xd& x1, const Reach& reach) const;

  double tolerance_;
  SelfContact self_;
  Visibility visibility_;
  bool has_shares_ = false;  ///< true if a pair of the last search has a share below 1
  IndexedVector<Point> points_;
  IndexedVector<ProjectionHistory> histories_;  ///< history of each point
  MovingSurface moving_;                        ///< the secondary surface
  IndexedVector<RayNeighbours> neighbours_;     ///< facets near the ray of each point
};

}  // namespace mixture_contact
