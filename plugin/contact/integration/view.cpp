#include "integration/view.h"

#include <Eigen/Geometry>

namespace mixture_contact {

View view_at(FacetType type, const FacetCoordinates& x, const Vector2d& xi) {
  const ShapeFunctions shape = shape_functions(type, xi);
  const Eigen::Matrix<double, 3, 2> tangents = x * shape.gradient;
  View view;
  view.origin = x * shape.value;
  view.normal = tangents.col(0).cross(tangents.col(1)).normalized();
  view.axes.row(0) = tangents.col(0).normalized();
  view.axes.row(1) = view.normal.cross(view.axes.row(0));
  return view;
}

ViewTilt view_tilt(const View& view, FacetType type, const FacetCoordinates& x, const Vector2d& xi) {
  const FacetGradient gradient = shape_functions(type, xi).gradient;
  const Eigen::Matrix<double, 3, 2> tangents = x * gradient;
  const double area = tangents.col(0).cross(tangents.col(1)).norm();
  return view.axes / area * area_vector_variation(tangents, gradient, x.cols());
}

}  // namespace mixture_contact
