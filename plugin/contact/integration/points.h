/// The points at which the integral over a surface is sampled, by the pair of facets that they lie on.
#pragma once

#include "base/lists.h"
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

/// An integration point of a pair of facets: x1(xi) on the primary facet is paired with x2(eta) on the secondary one
/// along n1.
struct IntegrationPoint {
  Vector2d xi{0, 0};
  Vector2d eta{0, 0};
  double weight = 0;  ///< da1 = weight |a|
  int sub_facet = 0;  ///< of the primary facet, that it lies on
};

/// A facet of the primary surface and one of the secondary surface that faces it.
struct FacetPair {
  int primary = 0;
  int secondary = 0;
  Index first = 0;   ///< of the points in between, among those of all pairs
  Index points = 0;  ///< how many there are
  /// Whether integrals over all pairs of the primary facet are exact, and the secondary surface continues across all of
  /// their edges within the facet. As such an edge moves, one pair gains the area that the next one loses: no sum over
  /// the pairs depends on the motion of their points.
  bool unbroken = false;
};

/// The points of a pair, in their order.
using PointsOfPair = Span<IntegrationPoint>;

/// Pairs of facets with the points in between.
class FacetPairs {
 public:
  const IndexedVector<FacetPair>& pairs() const { return pairs_; }
  PointsOfPair points(const FacetPair& pair) const { return {std::next(points_.data(), pair.first), pair.points}; }
  /// The points of all pairs, pair by pair.
  const IndexedVector<IntegrationPoint>& points() const { return points_; }

  void clear();
  /// Adds a pair, and another point to the last pair.
  void add_pair(int primary, int secondary) { pairs_.push_back({primary, secondary, points_.count(), 0}); }
  void add_point(const IntegrationPoint& point);
  /// Adds a pair of others with its points.
  void add(const FacetPairs& others, const FacetPair& pair);
  /// Says of all pairs that they are.
  void set_unbroken();
  void remove_last_pair();
  std::size_t memory() const;

 private:
  IndexedVector<FacetPair> pairs_;
  IndexedVector<IntegrationPoint> points_;  ///< those of one pair after those of the other
};

/// The ray from a point of a facet along its outward normal; reach and tolerance as in Ray.
Ray normal_ray(const Facet& facet, const Matrix3Xd& positions, const Vector2d& xi, double reach, double tolerance);

/// The pairs of facets around a node.
using PairsAround = Span<const FacetPair*>;

/// Takes the motion of a point.
using UseMotion = std::function<void(const PointMotion&)>;

/// Calls `use` for so many points that do not move.
void use_no_motion(Index points, const UseMotion& use);

/// Finds the integration points of a primary surface and their opposite points on a secondary one.
class PointFinder {
 public:
  PointFinder() = default;
  PointFinder(const PointFinder&) = delete;
  PointFinder& operator=(const PointFinder&) = delete;
  PointFinder(PointFinder&&) = delete;
  PointFinder& operator=(PointFinder&&) = delete;
  virtual ~PointFinder() = default;

  /// Pairs of facets that face each other within reach, in ascending order of the primary facets. The result depends on
  /// the positions alone within an iteration.
  virtual FacetPairs search(const Matrix3Xd& x1, const Matrix3Xd& x2, const Reach& reach) = 0;

  /// Pairs at other positions without a search: points keep to the facets that the last search() found for them. The
  /// result depends on that search and the positions alone.
  virtual FacetPairs on_same_facets(const Matrix3Xd& x1, const Matrix3Xd& x2) = 0;

  /// Begins a Newton iteration where the last search was made. Returns whether a search there would now find more,
  /// since points at the edge of the other surface are kept on it from now on.
  virtual bool begin_iteration() { return false; }

  /// Ends the iterations of a step, or those before an augmentation: no point is kept any more. Returns whether any
  /// was.
  virtual bool end_iterations() { return false; }

  /// Whether points or their weights move as the surfaces move; if not, their motions are none.
  virtual bool moves_points() const = 0;

  /// How the points of a pair, found at these positions, move with them: calls `use` for each in their order. Those of
  /// fully covered pairs count as fixed.
  virtual void for_each_motion(const FacetPair& pair, const PointsOfPair& points, const Matrix3Xd& x1,
                               const Matrix3Xd& x2, const UseMotion& use) const = 0;

  /// Memory that it keeps [bytes].
  virtual std::size_t memory() const = 0;
};

/// The finder by the settings. Keeps references to the facets.
std::unique_ptr<PointFinder> point_finder(const SurfaceMesh& primary, const SurfaceMesh& secondary,
                                          const Settings& settings);

/// Gauss points at fixed places of the primary facets: each is paired with the nearest facet that faces it. The weight
/// of a point is that of the rule times the share of both facets (facing_share.h).
///
/// The load of a point ends where it passes the edge of the other surface: it is a jump, and where a whole contact
/// hangs on one point there may be no equilibrium on either side of it. A point that loses its projection on the
/// surface for the second time between iterations is at its edge: until they end it is kept on the facet that it was
/// paired with last, continued beyond its edge.
class GaussPoints : public PointFinder {
 public:
  /// The quadrature rule of every primary facet; order 0: default_quadrature_order.
  GaussPoints(const IndexedVector<Facet>& primary, const IndexedVector<Facet>& secondary, int order, double tolerance,
              SelfContact self = {}, Visibility visibility = {});

  FacetPairs search(const Matrix3Xd& x1, const Matrix3Xd& x2, const Reach& reach) override;
  /// A point that leaves its facet comes back with it.
  FacetPairs on_same_facets(const Matrix3Xd& x1, const Matrix3Xd& x2) override;
  bool begin_iteration() override;
  bool end_iterations() override;
  bool moves_points() const override { return has_shares_; }
  void for_each_motion(const FacetPair& pair, const PointsOfPair& points, const Matrix3Xd& x1, const Matrix3Xd& x2,
                       const UseMotion& use) const override;
  std::size_t memory() const override;

 private:
  struct Point {
    int facet = 0;
    Vector2d xi;
    double weight = 0;
    int sub_facet = 0;
  };
  static constexpr int unpaired = -1;
  static constexpr int most_losses = 2;
  /// The secondary facets that a point was paired with, or unpaired.
  struct ProjectionHistory {
    int facet = unpaired;         ///< result of the last search()
    int at_iteration = unpaired;  ///< pair at the start of the iteration
    int last = unpaired;          ///< the last pair as an iteration of the step began
    int losses = 0;               ///< how often the projection was lost since the iteration before

    /// Whether the point is at the edge of the other surface.
    bool is_kept() const { return losses >= most_losses; }
  };

  /// The partner of a point.
  struct Partner {
    int facet;
    Vector2d eta;
    double share;  ///< of the facets for each other
  };
  /// Pairs each point with the partner that `partner_of` finds for it.
  FacetPairs paired(const std::function<std::optional<Partner>(Index)>& partner_of);
  double share(int primary, int secondary, const Matrix3Xd& x1, const Matrix3Xd& x2) const;
  Ray ray_from(const Point& point, const Matrix3Xd& x1, const Reach& reach) const;

  const IndexedVector<Facet>& primary_;
  const IndexedVector<Facet>& secondary_;
  double tolerance_;
  SelfContact self_;
  Visibility visibility_;
  bool has_shares_ = false;  ///< whether a pair of the last search counts in part
  IndexedVector<Point> points_;
  IndexedVector<ProjectionHistory> histories_;  ///< per point
  MovingSurface moving_;                        ///< the secondary surface
  IndexedVector<RayNeighbours> neighbours_;     ///< per point
};

}  // namespace mixture_contact
