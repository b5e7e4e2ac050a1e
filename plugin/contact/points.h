/// Where the integral over a surface is sampled: integration points, by the pair of facets that they lie on.
#pragma once

#include "search.h"

#include <vector>

namespace mixture_contact {

/// An integration point of a pair of facets: x1(xi) on the primary facet sees x2(eta) on the secondary one along n1.
struct IntegrationPoint {
  Vector2d xi{0, 0};
  Vector2d eta{0, 0};
  double weight = 0;  ///< da1 = weight |a|
};

/// A facet of the primary surface and one of the secondary surface that it sees, with the points in between.
struct FacetPair {
  int primary = 0;
  int secondary = 0;
  std::vector<IntegrationPoint> points;
};

/// The ray from a point of a facet along its outward normal; reach and tolerance as in Ray.
Ray normal_ray(const Facet& facet, const Matrix3Xd& positions, const Vector2d& xi, double reach, double tolerance);

/// Gauss points at fixed places of the primary facets: each sees the nearest facet that faces it.
class GaussPoints {
 public:
  /// The quadrature rule of every primary facet; order 0: default_quadrature_order.
  GaussPoints(const std::vector<Facet>& primary, const std::vector<Facet>& secondary, int order, double tolerance);

  /// Pairs of facets in ascending order. Of the facets that face a point within `radius` the nearest is taken.
  std::vector<FacetPair> search(const Matrix3Xd& x1, const Matrix3Xd& x2, double radius);

  /// The same without a search: each point looks at the facet that the last search() found for it. A point that leaves
  /// its facet comes back with it: the result depends on that search and the positions alone.
  std::vector<FacetPair> on_same_facets(const Matrix3Xd& x1, const Matrix3Xd& x2) const;

  Index size() const { return static_cast<Index>(points_.size()); }

 private:
  struct Point {
    int facet = 0;
    Vector2d xi;
    double weight = 0;
  };

  const std::vector<Facet>& primary_;
  const std::vector<Facet>& secondary_;
  double tolerance_;
  std::vector<Point> points_;
  std::vector<int> seen_;  ///< per point: the secondary facet that the last search() found, or -1
};

}  // namespace mixture_contact
