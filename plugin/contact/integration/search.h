/// Search for the first facet of a surface that a ray meets.
#pragma once

#include "geometry/projection.h"
#include "geometry/surface.h"

#include <Eigen/Geometry>
#include <unsupported/Eigen/BVH>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace mixture_contact {

/// Factor of the margin around the box of a facet's nodes: a curved facet extends beyond this box by less than this
/// fraction of the box's diagonal.
inline constexpr double box_margin = 0.1;

/// A bounding-volume tree (Eigen's KdBVH) over the facets of a surface in one configuration.
class FacetTree {
 public:
  /// Builds the tree from the boxes around the facets' nodes, enlarged by `margin` times their diagonal.
  FacetTree(const IndexedVector<Facet>& facets, const Matrix3Xd& positions, double margin);

  /// Indices, ascending, of the facets whose boxes meet the segment from origin - reach * direction to origin + reach *
  /// direction. The boxes are enlarged by `width` [length] on all sides.
  std::vector<int> candidates(const Vector3d& origin, const Vector3d& direction, double reach, double width = 0) const;

 private:
  Eigen::KdBVH<double, 3, int> tree_;
};

/// True if the boxes around all nodes of two surfaces are within `reach` of each other. If false, no ray of this reach
/// from one surface meets the other.
bool surfaces_within_reach(const Matrix3Xd& x1, const Matrix3Xd& x2, double reach);

/// The search distance of the points of a surface.
struct Reach {
  /// A limit by distance alone. Implicit, because a distance converts to a reach.
  Reach(double to) : distance(to) {}  // NOLINT(google-explicit-constructor)
  /// A limit by distance and by the size of each facet; `touching`: the gap at which the surfaces touch.
  Reach(double to, double touching) : distance(to), by_facet(true), offset(touching) {}

  double distance;        ///< search distance along the normal, forwards and backwards [length]
  bool by_facet = false;  ///< true if the size of a facet also limits its search distance ahead
  double offset = 0;      ///< gap at which the surfaces touch [length]
  /// The distance by which overlaps may exceed `distance` [length].
  double beyond = 0;

  /// Search distance backwards [length].
  double backwards() const { return distance + beyond; }

  /// Search distance ahead of a facet for a parallel facet [length]; tilted_reach() is its factor for other facets.
  /// Infinite if `distance` is the only limit.
  double ahead(const Facet& facet, const Matrix3Xd& position) const;
  friend bool operator==(const Reach& one, const Reach& other) {
    return one.distance == other.distance && one.by_facet == other.by_facet && one.offset == other.offset &&
           one.beyond == other.beyond;
  }
};

/// A ray that searches for the nearest facet facing it.
struct Ray {
  /// Value of a distance without a limit.
  static constexpr double unlimited = std::numeric_limits<double>::infinity();

  Vector3d origin;
  Vector3d direction;          ///< unit vector along the normal of the surface at the origin
  double reach;                ///< search distance, forwards and backwards, without `beyond` [length]
  double tolerance;            ///< distance outside a facet within which a hit still counts, in parametric coordinates
  double overlap = unlimited;  ///< largest overlap: distance backwards within which a hit still counts [length]
  double ahead = unlimited;    ///< search distance ahead for a parallel facet [length], see Reach::ahead()
  Vector3d normal{0, 0, 0};  ///< unit vector that the middle normal of a facet has to oppose; zero: the ray's direction
  double beyond = 0;         ///< Reach::beyond [length]

  /// Search distance backwards [length].
  double backwards() const { return std::min(reach + beyond, overlap); }
};

/// Largest distance outside a facet at which the extended facet still counts as hit, in parametric coordinates: the
/// tolerance of rays that search beyond edges.
inline constexpr double widest_miss = 1;

/// The intersection of a ray with a facet of a surface.
struct SurfaceHit {
  int facet;
  Vector2d eta;
  double gap;
  double outside = 0;  ///< distance of the hit from the facet's edge [length]; 0 for a hit within the facet
};

/// Predicate: true if a hit counts.
using AcceptHit = std::function<bool(const SurfaceHit&)>;

/// The hit of a ray on the facet with this index. Empty unless the facet's normal at the hit opposes the ray's
/// direction, its middle normal opposes the ray's normal by least_opposition, and the gap is within the ray's limits.
std::optional<SurfaceHit> facing_hit(int index, const IndexedVector<Facet>& facets, const Matrix3Xd& positions,
                                     const Ray& ray);

/// The nearest hit of a ray on the facing facets of a tree for which `accept` (if given) is true; empty if there is
/// none.
///
/// The length of a hit is its gap plus its distance outside the facet. If facets adjoin at less than 45 degrees, the
/// facet that the ray really meets is therefore nearer, and the gap does not jump as the hit crosses their edge. The
/// choice depends on the configuration alone and not on earlier calls. If hits have equal lengths, the lowest facet
/// index counts.
std::optional<SurfaceHit> nearest_facing(const FacetTree& tree, const IndexedVector<Facet>& facets,
                                         const Matrix3Xd& positions, const Ray& ray, const AcceptHit& accept = {});

/// The hit of nearest_facing() for the ray of a node, with a wider tolerance at edges. At the edge of a surface, for
/// example at a plane of symmetry, the nodal normal is a mean over one side only, and is off by up to half the angle
/// between two facets. A ray that hits nothing, but misses a facet by less than a fifth of the gap, therefore counts as
/// hitting this facet; a fifth suffices for facets that turn by 23 degrees.
std::optional<SurfaceHit> nearest_facing_or_passed(const FacetTree& tree, const IndexedVector<Facet>& facets,
                                                   const Matrix3Xd& positions, Ray ray, const AcceptHit& accept = {});

/// The facets near a ray, kept from an earlier configuration.
struct RayNeighbours {
  std::array<Vector3d, 2> ends;  ///< ends of the ray at its last search
  int reference = -1;       ///< number of the surface's reference configuration at the last search; -1: no search yet
  std::vector<int> facets;  ///< indices of the facets, ascending
};

/// Search on a moving surface. It finds the hits of nearest_facing() in the present configuration, but rebuilds its
/// tree, and repeats the tree search of a ray, only after sufficient motion.
///
/// The tree contains the boxes of a reference configuration. If no node has moved by more than d along any axis since
/// then, a face of a box has moved by at most d (1 + 2 sqrt(3) box_margin): by d with the nodes, and by the margin
/// times the change of the diagonal. As soon as this bound exceeds a slack s, the present configuration becomes the
/// reference.
///
/// The neighbours of a ray are the facets whose reference boxes, enlarged by 2 s, meet the ray. They contain every
/// facet whose present box meets the ray, as long as its two ends have moved by at most s along any axis.
class MovingSurface {
 public:
  /// Sets the present positions of the nodes. `facets`: the same in all calls.
  void move_to(const IndexedVector<Facet>& facets, const Matrix3Xd& positions);

  /// The hit of nearest_facing() in the present configuration; empty before the first move_to().
  ///
  /// `neighbours`: the facets near this ray, kept between calls. They are updated if the ray or the surface has moved
  /// too far. `keep_visible` (optional) removes facets that the ray cannot see from a new list of neighbours. Rays with
  /// separate neighbours may be searched in parallel.
  std::optional<SurfaceHit> nearest_facing(const IndexedVector<Facet>& facets, const Ray& ray,
                                           RayNeighbours& neighbours,
                                           const std::function<void(std::vector<int>&)>& keep_visible = {},
                                           const AcceptHit& accept = {}) const;

  /// Indices of the facets whose boxes meet the segment of this length from a point along a unit vector.
  std::vector<int> met(const Vector3d& from, const Vector3d& direction, double length) const;
  /// The present positions of the nodes.
  const Matrix3Xd& positions() const { return positions_; }
  std::size_t memory() const;  ///< memory of the boxes and positions [bytes]

 private:
  /// True if the neighbours still contain all facets near a ray with these ends.
  bool holds(const RayNeighbours& neighbours, const std::array<Vector3d, 2>& ends) const;

  Matrix3Xd positions_;
  std::vector<Eigen::AlignedBox3d> boxes_;  ///< boxes of the facets in the present configuration
  /// Positions of the nodes in the reference configuration.
  Matrix3Xd reference_;
  std::optional<FacetTree> tree_;  ///< tree of the reference configuration
  double slack_ = 0;               ///< slack s: largest motion without a new reference configuration [length]
  int references_ = 0;             ///< number of reference configurations so far
};

}  // namespace mixture_contact
