#include "surface.h"

#include "quadrature.h"

#include <Eigen/Geometry>

namespace mixture_contact {

FacetVector areas_of_nodes(const Facet& facet, const Matrix3Xd& position) {
  const FacetCoordinates x = facet_coordinates(facet, position);
  FacetVector areas = FacetVector::Zero(node_count(facet.type));
  for (const QuadraturePoint& q : piecewise_quadrature(facet.type, default_quadrature_order(facet.type))) {
    const Eigen::Matrix<double, 3, 2> tangents = x * shape_functions(facet.type, q.xi).gradient;
    const double area = q.weight * tangents.col(0).cross(tangents.col(1)).norm();
    areas += area * multiplier_functions(facet.type, sub_facet_at(facet.type, q.xi), q.xi).value;
  }
  return areas;
}

VectorXd nodal_areas(const SurfaceMesh& mesh, const Matrix3Xd& position) {
  VectorXd sum = VectorXd::Zero(mesh.nodes);
  for (const Facet& facet : mesh.facets) {
    const FacetVector areas = areas_of_nodes(facet, position);
    for (Index a = 0; a < areas.size(); ++a) sum[facet.nodes[static_cast<std::size_t>(a)]] += areas[a];
  }
  return sum;
}

double half_diagonal(const Matrix3Xd& position) {
  return 0.5 * (position.rowwise().maxCoeff() - position.rowwise().minCoeff()).norm();
}

}  // namespace mixture_contact
