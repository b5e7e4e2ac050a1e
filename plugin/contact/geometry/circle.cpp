#include "geometry/circle.h"

#include "base/parallel.h"

#include <Eigen/Geometry>

namespace mixture_contact {
namespace {

/// Relative error that is allowed for in the sum of two lengths.
constexpr double rounding = 1e-6;

}  // namespace

double radius_around(const FacetCoordinates& x, const Vector3d& centre) {
  return (x.colwise() - centre).colwise().norm().maxCoeff();
}

Circle circle_around(const FacetCoordinates& x) {
  const Vector3d centre = x.rowwise().mean();
  return {centre, radius_around(x, centre)};
}

IndexedVector<Circle> circles_around(const IndexedVector<Facet>& facets, const Matrix3Xd& x) {
  IndexedVector<Circle> circles(facets.count());
  in_parallel(facets.count(),
              [&](Index index) { circles[index] = circle_around(facet_coordinates(facets[index], x)); });
  return circles;
}

bool are_apart(const Circle& one, const Circle& two, const Vector3d& n) {
  const double reach = (1 + rounding) * (one.radius + two.radius);
  return (two.centre - one.centre).cross(n).squaredNorm() > reach * reach;
}

bool is_passed(const Circle& circle, const Vector3d& point, const Vector3d& n) {
  return are_apart({point, 0}, circle, n);
}

}  // namespace mixture_contact
