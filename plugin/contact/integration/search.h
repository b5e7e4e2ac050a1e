/// Search: which facet does a ray meet first.
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

/// Curved facets bulge out of the box of their nodes by less than this part of its diagonal.
inline constexpr double box_margin = 0.1;

/// A bounding-volume tree (Eigen's KdBVH) over the facets of a surface in one configuration.
class FacetTree {
 public:
  /// Boxes around the facets' nodes, enlarged by `margin` times their diagonal (curved facets bulge out of their nodes'
  /// box).
  FacetTree(const IndexedVector<Facet>& facets, const Matrix3Xd& positions, double margin);

  /// Indices, ascending, of the facets whose box meets the segment from origin - reach * direction to origin + reach *
  /// direction; with a width, those that come that near to it along the axes.
  std::vector<int> candidates(const Vector3d& origin, const Vector3d& direction, double reach, double width = 0) const;

 private:
  Eigen::KdBVH<double, 3, int> tree_;
};

/// Whether two surfaces come within `reach` of each other, by the boxes around all their nodes: where not, no ray from
/// one meets the other.
bool surfaces_within_reach(const Matrix3Xd& x1, const Matrix3Xd& x2, double reach);

/// How far the points of a surface look for the other one.
struct Reach {
  // Implicit, because a distance converts to a reach.
  Reach(double to) : distance(to) {}  // NOLINT(google-explicit-constructor)
  Reach(double to, double touching) : distance(to), by_facet(true), offset(touching) {}

  double distance;        ///< ahead and behind [length]
  bool by_facet = false;  ///< whether the size of a facet limits how far it looks ahead
  double offset = 0;      ///< gap at which surfaces touch [length]

  /// How far a facet looks ahead for one that is parallel to it [length]; farther for others (tilted_reach()). Infinite
  /// if the distance is the only limit.
  double ahead(const Facet& facet, const Matrix3Xd& position) const;
  friend bool operator==(const Reach& one, const Reach& other) {
    return one.distance == other.distance && one.by_facet == other.by_facet && one.offset == other.offset;
  }
};

/// A ray that looks for the nearest facet that faces it.
struct Ray {
  static constexpr double unlimited = std::numeric_limits<double>::infinity();

  Vector3d origin;
  Vector3d direction;          ///< unit vector: the normal of the surface it leaves
  double reach;                ///< how far it looks, forwards and backwards [length]
  double tolerance;            ///< how far outside a facet a hit still counts, in parametric coordinates
  double overlap = unlimited;  ///< how far backwards a hit still counts [length]
  double ahead = unlimited;    ///< as Reach::ahead()
  Vector3d normal{0, 0, 0};    ///< unit vector that facets have to oppose; 0: the direction

  double backwards() const { return std::min(reach, overlap); }
};

/// How far beyond its edge a facet may be continued, in parametric coordinates: the tolerance of a ray that looks
/// there.
inline constexpr double widest_miss = 1;

/// The point in which a ray meets a surface.
struct SurfaceHit {
  int facet;
  Vector2d eta;
  double gap;
  double outside = 0;  ///< distance beyond the facet's edge [length]
};

/// Whether a hit counts.
using AcceptHit = std::function<bool(const SurfaceHit&)>;

/// The hit of a ray on one facet, given by its index, if its outward normal opposes the ray's direction, and that in
/// its middle the ray's normal by least_opposition.
std::optional<SurfaceHit> facing_hit(int index, const IndexedVector<Facet>& facets, const Matrix3Xd& positions,
                                     const Ray& ray);

/// The nearest hit of a ray on the facets of a tree that face it and, if given, are accepted; empty if there is none.
/// A hit outside its facet, within the tolerance, counts as farther by as much as it lies outside: where facets adjoin
/// at less than 45 degrees the one that the ray does meet wins, so that the gap does not jump as the hit crosses their
/// edge. The choice depends on the configuration alone, never on earlier calls; equal lengths go to the lowest facet
/// index.
std::optional<SurfaceHit> nearest_facing(const FacetTree& tree, const IndexedVector<Facet>& facets,
                                         const Matrix3Xd& positions, const Ray& ray, const AcceptHit& accept = {});

/// The hit of nearest_facing() for the ray of a node. The normal at the edge of a surface at a plane of symmetry, the
/// mean over one side, is off by up to half the turn between two facets: a ray that hits nothing, and passes
/// the edge of a facet by less than a fifth of the gap there (facets that turn by 23 degrees), meets it.
std::optional<SurfaceHit> nearest_facing_or_passed(const FacetTree& tree, const IndexedVector<Facet>& facets,
                                                   const Matrix3Xd& positions, Ray ray, const AcceptHit& accept = {});

/// The facets that a ray of an earlier configuration could meet.
struct RayNeighbours {
  std::array<Vector3d, 2> ends;  ///< of the ray at its last search
  int reference = -1;            ///< reference configuration of the surface in the last search; -1: none yet
  std::vector<int> facets;       ///< ascending
};

/// Search on a surface that moves: the hits of nearest_facing() on a tree of the present configuration, but with a tree
/// built, and rays looked up in it, only as far as motion requires.
///
/// The tree holds the boxes of a reference configuration. While no node has moved by more than d along an axis since, a
/// box's faces have moved by at most d (1 + 2 sqrt(3) box_margin): d along with the nodes, and the margin times the
/// change of the diagonal. That is kept below a slack s; beyond, the present configuration becomes the reference.
/// A ray's neighbours are the facets whose reference boxes, enlarged by 2 s, meet it. While its ends, and with them
/// each of its points, have moved by at most s along an axis as well, it meets no other box.
class MovingSurface {
 public:
  /// Keeps a reference to the facets.
  explicit MovingSurface(const IndexedVector<Facet>& facets) : facets_(facets) {}

  /// Sets the present configuration.
  void move_to(const Matrix3Xd& positions);

  /// As nearest_facing() in the present configuration; nothing before the first. `neighbours` are those of this ray
  /// from earlier calls, and are renewed where it has moved too far; `keep_visible`, if given, leaves those that it may
  /// see. Rays with separate neighbours may be searched in parallel.
  std::optional<SurfaceHit> nearest_facing(const Ray& ray, RayNeighbours& neighbours,
                                           const std::function<void(std::vector<int>&)>& keep_visible = {},
                                           const AcceptHit& accept = {}) const;

  /// Indices of the facets whose boxes a ray from a point along a unit vector meets.
  std::vector<int> met(const Vector3d& from, const Vector3d& direction, double length) const;
  const Matrix3Xd& positions() const { return positions_; }
  std::size_t memory() const;  ///< [bytes]

 private:
  bool holds(const RayNeighbours& neighbours, const std::array<Vector3d, 2>& ends) const;

  const IndexedVector<Facet>& facets_;
  Matrix3Xd positions_;
  std::vector<Eigen::AlignedBox3d> boxes_;  ///< in the present configuration
  Matrix3Xd reference_;
  std::optional<FacetTree> tree_;  ///< in the reference configuration
  double slack_ = 0;               ///< s [length]
  int references_ = 0;             ///< how many reference configurations there have been
};

}  // namespace mixture_contact
