/// Facets that are hidden from each other by the bodies in between.
#pragma once

#include "integration/search.h"

namespace mixture_contact {

/// Finds the points of two surfaces, each of its own body, that a body hides from each other.
///
/// Backwards from a point (along -n1, through its own body), a facet that opposes it either overlaps with it, or is the
/// far side of a body. Two layers in contact, with thicknesses T1 and T2, overlap by d at their near sides. Their far
/// sides seem to overlap by T1 + T2 - d. The ends of a rod and a ring that overlaps sideways with it seem to overlap by
/// at least the smaller of T1 and T2. An overlap therefore counts up to three quarters of the thickness of the thinner
/// body. The thickness is the distance to the first facet that faces away: from the point along -n1, and from the
/// opposite facet along n1.
///
/// Ahead of a point (along n1), the opposite facet is hidden if the point's own body begins, or the other body ends,
/// before the facet.
///
/// Overlaps up to half the thickness of the elements behind both facets always count.
class Visibility {
 public:
  /// Value of `own` in is_hidden() for a node instead of a point of a facet.
  static constexpr int node = -1;

  /// No bodies: nothing is hidden.
  Visibility() = default;
  /// Keeps references to the meshes. Surfaces that may be in contact with themselves hide nothing here; SelfContact
  /// excludes their own facets.
  Visibility(const SurfaceMesh& primary, const SurfaceMesh& secondary);

  /// Sets the present positions of the nodes of both surfaces.
  void move_to(const Matrix3Xd& x1, const Matrix3Xd& x2);

  /// True if a body hides a point of the secondary surface from a point of the primary surface.
  ///
  /// `normal`: n1 at the primary point. `gap`: the gap along it. `own`: facet of the primary point, or `node`. `other`:
  /// facet of the secondary point.
  bool is_hidden(const Vector3d& point, const Vector3d& normal, double gap, int own, int other) const;

  std::size_t memory() const;

 private:
  /// A surface that may hide others.
  struct Screen {
    explicit Screen(const SurfaceMesh& of) : mesh(of) {}
    const SurfaceMesh& mesh;
    MovingSurface moving;
    double size = 0;  ///< diagonal of the box around the surface [length]
  };
  /// A segment of a given length from a point along a unit vector.
  struct Way {
    Vector3d from;
    Vector3d direction;
    double length;
  };

  /// Distance along a segment to the first facet of a surface that turns its back (`sense` 1) or its front (`sense` -1)
  /// to the segment's start. The facet `but` is ignored. Infinite if the segment meets no such facet.
  static double first_met(const Screen& screen, const Way& way, double sense, int but);
  /// The largest overlap that counts between a point and a facet at this gap [mm].
  double deepest_overlap(const Vector3d& point, const Vector3d& normal, double gap, int own, int other) const;
  /// Thickness of the element behind a facet [mm]; 0 if it is unknown.
  static double element_thickness(const Screen& screen, int facet);

  std::vector<Screen> screens_;  ///< the primary and the secondary surface; empty if nothing is hidden
};

}  // namespace mixture_contact
