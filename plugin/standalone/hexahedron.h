/// Shape functions and Gauss rules of hexahedra with 8 and 20 nodes in FEBio's node order, and of their facets.
#pragma once

#include "contact/geometry/facet.h"

#include <vector>

namespace standalone {

using mixture_contact::at;

/// The faces of a hexahedron as corner numbers, counter-clockwise seen from outside.
inline constexpr int hexahedron_faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                               {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

/// Shape functions N_a and their derivatives at xi in [-1, 1]^3: row 0 contains N_a, rows 1 to 3 dN_a/dxi; shape (4,
/// nodes). `nodes`: 8 or 20.
Eigen::Matrix4Xd hexahedron_shape(int nodes, const Eigen::Vector3d& xi);

/// A point of a quadrature rule on [-1, 1]^3; the weights add up to 8.
struct HexahedronPoint {
  Eigen::Vector3d xi;
  double weight;
};

/// FEBio's default rule: 2 x 2 x 2 Gauss points for 8 nodes, 3 x 3 x 3 for 20 nodes.
std::vector<HexahedronPoint> hexahedron_rule(int nodes);

/// A quadrature point of a facet.
struct FacetPoint {
  mixture_contact::FacetVector shape;  ///< shape functions N_a of the facet
  Eigen::Vector3d area;                ///< quadrature weight times area vector, along the normal [mm^2]
};

/// The quadrature points of a facet at these nodal positions, by the core's default rule.
std::vector<FacetPoint> facet_points(const mixture_contact::Facet& facet, const Eigen::Matrix3Xd& positions);

}  // namespace standalone
