#include "loads.h"

#include "contact/quadrature.h"

#include <Eigen/Geometry>

namespace standalone {

MatrixXd unit_forces(const Model& model, const SurfaceLoad& load) {
  using namespace mixture_contact;
  MatrixXd forces = MatrixXd::Zero(model.dofs(), model.mesh.nodes.cols());
  for (const SurfaceFacet& facet : load.facets) {
    const FacetType type = facet.facet.type;
    const FacetCoordinates x = facet_coordinates(facet.facet, model.mesh.nodes);
    for (const QuadraturePoint& point : quadrature(type, default_quadrature_order(type))) {
      const ShapeFunctions shape = shape_functions(type, point.xi);
      const Eigen::Matrix<double, 3, 2> tangents = x * shape.gradient;
      const Vector3d area = point.weight * tangents.col(0).cross(tangents.col(1));
      for (int a = 0; a < node_count(type); ++a) {
        const int node = facet.facet.nodes[static_cast<std::size_t>(a)];
        if (load.fluid) {
          forces(pressure_dof, node) += shape.value[a] * area.norm();
        } else {
          forces.col(node).head<3>() -= shape.value[a] * area;
        }
      }
    }
  }
  return forces;
}

}  // namespace standalone
