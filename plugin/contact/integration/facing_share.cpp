#include "integration/facing_share.h"

#include "geometry/kinematics.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace mixture_contact {
namespace {

/// The area vector in the middle of a facet, and its variation with respect to the nodal positions.
struct MiddleArea {
  MiddleArea(FacetType type, const FacetCoordinates& x)
      : gradient(shape_functions(type, parametric_centre(type)).gradient),
        tangents(x * gradient),
        area(tangents.col(0).cross(tangents.col(1)).norm()),
        normal(tangents.col(0).cross(tangents.col(1)) / area) {}

  /// Variation of the cosine between the normal and a constant unit vector n.
  PairVariation<1> cosine_variation(const Vector3d& n) const {
    const Vector3d across = (n - n.dot(normal) * normal) / area;
    return across.transpose() * area_vector_variation(tangents, gradient, gradient.rows());
  }

  FacetGradient gradient;
  Eigen::Matrix<double, 3, 2> tangents;
  double area;
  Vector3d normal;
};

/// The fraction of the interval between both bounds of c that is below `opposition`, 0 to 1.
double fraction_of(double opposition) {
  return std::clamp((opposition - least_opposition) / (full_opposition - least_opposition), 0.0, 1.0);
}

}  // namespace

Vector3d middle_normal(FacetType type, const FacetCoordinates& x) { return MiddleArea(type, x).normal; }

double facing_share(const Vector3d& n1, const Vector3d& n2) {
  const double s = fraction_of(-n1.dot(n2));
  return s * s * (3 - 2 * s);
}

double tilted_reach(const Vector3d& n1, const Vector3d& n2) {
  const double c = std::clamp(-n1.dot(n2), least_opposition, 1.0);
  return 1 + std::sqrt(1 / (c * c) - 1) / parallel_reach;
}

double largest_tilted_reach() { return 1 + std::sqrt(1 / (least_opposition * least_opposition) - 1) / parallel_reach; }

PairVariation<1> facing_share_variation(FacetType first, const FacetCoordinates& x1, FacetType second,
                                        const FacetCoordinates& x2) {
  const MiddleArea one(first, x1);
  const MiddleArea two(second, x2);
  const double s = fraction_of(-one.normal.dot(two.normal));
  const double slope = 6 * (1 - s) / (s * (3 - 2 * s)) / (full_opposition - least_opposition);  // d ln(share)/dc
  PairVariation<1> variation(3 * (x1.cols() + x2.cols()));
  variation << one.cosine_variation(two.normal), two.cosine_variation(one.normal);
  return -slope * variation;
}

}  // namespace mixture_contact
