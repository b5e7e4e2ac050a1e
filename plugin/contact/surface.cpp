#include "surface.h"

#include "quadrature.h"

#include <Eigen/Geometry>

namespace mixture_contact {

VectorXd nodal_areas(const SurfaceMesh& mesh, const Matrix3Xd& position) {
  VectorXd areas = VectorXd::Zero(mesh.nodes);
  for (const Facet& facet : mesh.facets) {
    const FacetCoordinates x = facet_coordinates(facet, position);
    for (const QuadraturePoint& q : quadrature(facet.type, default_quadrature_order(facet.type))) {
      const ShapeFunctions shape = shape_functions(facet.type, q.xi);
      const Eigen::Matrix<double, 3, 2> tangents = x * shape.gradient;
      const FacetVector psi = multiplier_functions(facet.type, sub_facet_at(facet.type, q.xi), q.xi).value;
      const double area = q.weight * tangents.col(0).cross(tangents.col(1)).norm();
      for (Index a = 0; a < psi.size(); ++a) {
        areas[facet.nodes[static_cast<std::size_t>(a)]] += area * psi[a];
      }
    }
  }
  return areas;
}

double half_diagonal(const Matrix3Xd& position) {
  return 0.5 * (position.rowwise().maxCoeff() - position.rowwise().minCoeff()).norm();
}

}  // namespace mixture_contact
