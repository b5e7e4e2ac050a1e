/// Bodies hide the surfaces behind them.
#pragma once

#include "integration/search.h"

namespace mixture_contact {

/// The facets that two surfaces, each of a body of its own, hide from each other.
///
/// Behind a point, through its own body, a facet that opposes it is one that overlaps with it, or the far side of a
/// body that lies behind its own one or next to it: two layers on each other, of thickness T1 and T2, overlap by d at
/// their near sides, and by T1 + T2 - d as their far sides see it; ends of a rod and a ring around it, which overlap a
/// little sideways, by the smaller of T1 and T2 or more. An overlap therefore counts up to three quarters of the
/// thickness of the thinner body: from the point along -n1, and from the facet it meets along n1, to where facets turn
/// their backs. No far side can be seen if none of them does.
///
/// Ahead of a point, along n1, neither its own body begins before the facet that it meets, nor the other one ends.
///
/// Overlaps up to half the thickness of the elements behind both facets are not looked at.
class Visibility {
 public:
  static constexpr int node = -1;

  /// Bodies that hide nothing.
  Visibility() = default;
  /// Keeps references. A body that may meet itself hides nothing here: SelfContact excludes its own facets.
  Visibility(const SurfaceMesh& primary, const SurfaceMesh& secondary);

  /// Sets the present configuration.
  void move_to(const Matrix3Xd& x1, const Matrix3Xd& x2);

  /// Whether a body hides a point on a facet of the secondary surface from a point of the primary one, given the gap
  /// along the normal. `own`: the facet of the point, or `node`.
  bool is_hidden(const Vector3d& point, const Vector3d& normal, double gap, int own, int other) const;

  std::size_t memory() const;

 private:
  /// A surface that hides.
  struct Screen {
    explicit Screen(const SurfaceMesh& of) : mesh(of), moving(of.facets) {}
    const SurfaceMesh& mesh;
    MovingSurface moving;
    double size = 0;  ///< diagonal of the box around it [length]
  };
  /// A segment from a point along a unit vector.
  struct Way {
    Vector3d from;
    Vector3d direction;
    double length;
  };

  /// The way to the first facet, except one of them, whose normal is along it (`sense` 1) or against it (-1);
  /// infinite where it does not.
  static double first_met(const Screen& screen, const Way& way, double sense, int but);
  /// The deepest overlap that counts between a point and a facet that it meets.
  double deepest_overlap(const Vector3d& point, const Vector3d& normal, double gap, int own, int other) const;
  /// Thickness of the element behind a facet [mm]; 0 where it is not known.
  static double element_thickness(const Screen& screen, int facet);

  std::vector<Screen> screens_;  ///< of the primary and of the secondary surface; empty if nothing is hidden
};

}  // namespace mixture_contact
