/// Residual and tangent of two flat triangles that face each other. The integration points are treated as fixed on the
/// triangles.
///
/// Gradients, normal and area element are the same at all points of such a pair. Gap, projected point and nodal forces
/// are linear in the shape functions N1 and N2. Sums over the points with the weights w psi_c, for a node c of the
/// primary triangle, therefore depend on the points only through the moments sum w psi_c N1 and sum w psi_c N2.
#pragma once

#include "geometry/facet.h"

namespace mixture_contact {

/// Moments of the integration points of a pair, one row per node c of the primary triangle.
struct FlatMoments {
  Eigen::Matrix3d primary = Eigen::Matrix3d::Zero();    ///< moments sum w psi_c N1_b, shape (c, b)
  Eigen::Matrix3d secondary = Eigen::Matrix3d::Zero();  ///< moments sum w psi_c N2_b, shape (c, b)

  /// Adds a point at xi on the primary and eta on the secondary triangle; psi_c are the shape functions of the primary
  /// triangle.
  void add(double weight, const Vector2d& xi, const Vector2d& eta);
  /// Moments with redistributed functions psi_c. Column c of `heirs` contains the fractions of psi_c that the nodes
  /// receive.
  FlatMoments redistributed(const Eigen::Matrix3d& heirs) const { return {heirs * primary, heirs * secondary}; }
};

/// The coordinates of a triangle's nodes, one column each.
using TriangleCoordinates = Eigen::Matrix3d;
/// One number per node of a flat pair, primary nodes first.
using FlatNodes = Eigen::Matrix<double, 6, 1>;
/// Variation of a number with respect to the positions of a flat pair's nodes: three entries per node, primary nodes
/// first.
using FlatVariation = Eigen::Matrix<double, 18, 1>;
/// Derivative of nodal forces with respect to nodal positions: three rows and three columns per node, primary nodes
/// first.
using FlatTangent = Eigen::Matrix<double, 18, 18>;

/// Geometry of two flat triangles with their moments. Its members give the gaps, forces and areas of the pair.
struct FlatPair {
  FlatMoments moments;
  Vector3d gap{0, 0, 0};          ///< gap moment of each primary node c: sum w psi_c g
  Vector3d area_vector{0, 0, 0};  ///< area vector a = x1,1 x x1,2
  Vector3d normal{0, 0, 0};       ///< unit normal n1 = a/|a|
  double area = 0;                ///< area element |a|

  /// Sum of the weights of each primary node c: sum w psi_c.
  Vector3d weight() const { return moments.primary.rowwise().sum(); }
  /// Weights of the nodes of the pair in the jump sum of primary node c: sum w psi_c h, with h = (N1, -N2).
  FlatNodes jump_weights(Index c) const;
  /// Per primary node c: sum w psi_c times the jump of a field with these nodal values.
  Vector3d jump(const FlatNodes& values) const;
};

/// The flat pair with these moments at these nodal positions.
FlatPair flat_pair(const FlatMoments& moments, const TriangleCoordinates& x1, const TriangleCoordinates& x2);

/// First variations with respect to the nodal positions x_b that are the same at all points of a flat pair. b counts
/// primary nodes, n all nodes.
struct FlatVariations {
  Eigen::Matrix3d area_vector;         ///< variation of the area vector, columns w_b: da = sum_b w_b x dx_b
  Eigen::Matrix3d area;                ///< variation of the area element, columns m_b: d|a| = sum_b m_b.dx_b
  Eigen::Matrix<double, 3, 2> eta;     ///< columns T_beta: deta_beta = sum_n h_n T_beta.dx_n - g sum_b k_b,beta n1.dx_b
  Eigen::Matrix<double, 3, 2> tilted;  ///< coefficients k_b,beta in deta_beta, one row per primary node b
  Vector2d slope;                      ///< components n1.x2,beta of the secondary tangents along n1
};

/// The first variations of a flat pair at these nodal positions.
FlatVariations flat_variations(const FlatPair& pair, const TriangleCoordinates& x1, const TriangleCoordinates& x2);

/// The nodal forces of a unit traction at primary node c, eq (2.5): sum w psi_c h a.
FlatVariation traction_work(const FlatPair& pair, Index c);

/// The part of a pair in the variation of node c's average gap, g_c = INT psi_c g da/A_c, with the positions of the
/// pair: sum_q [w psi_c |a| dg + (g - g_c) w psi_c d|a|]/A_c.
///
/// `mean`: the average gap g_c plus the offset [mm]. `nodal_area`: A_c, the area of node c over all pairs [mm^2].
FlatVariation mean_gap_variation(const FlatPair& pair, const FlatVariations& vary, Index c, double mean,
                                 double nodal_area);

/// The part of a pair in the variation of node c's average jump of a field, INT psi_c [p] da/A_c, with the positions of
/// the pair.
///
/// `values`: the field at the nodes of the pair. `mean`: the average jump of node c. `nodal_area`: A_c, the area of
/// node c over all pairs [mm^2].
FlatVariation mean_jump_variation(const FlatPair& pair, const FlatVariations& vary, Index c, const FlatNodes& values,
                                  double mean, double nodal_area);

/// The nodal forces of normal tractions t_c at the primary nodes.
FlatVariation traction_residual(const FlatPair& pair, const Vector3d& traction);

/// The nodal flows of fluxes at the primary nodes: sum w |a| q h. `flux`: q_c times the time increment.
FlatNodes flux_residual(const FlatPair& pair, const Vector3d& flux);

/// Sums over the points of a flat pair, weighted with a load l that is interpolated from nodal loads l_c, and the
/// derivatives of these sums. Nodal forces and flows are multiples of them.
struct FlatSums {
  Vector3d primary;    ///< sums S1_b = sum w l N1_b at the primary nodes
  Vector3d secondary;  ///< sums S2_b = sum w l N2_b at the secondary nodes
  Vector3d normal;     ///< unit normal n1
  // dS2_b = p_b.(sum_c S1_c dx1_c - sum_c S2_c dx2_c) - sum_c t_bc n1.dx1_c
  Eigen::Matrix3d with_place;  ///< coefficients of dS2_b, columns p_b = N2_b,beta T_beta
  Eigen::Matrix3d with_tilt;   ///< coefficients of dS2_b, t_bc = N2_b,beta k_c,beta sum w l g

  /// Derivative dS2_b/dx1_c.
  Vector3d with_primary(Index b, Index c) const { return primary[c] * with_place.col(b) - with_tilt(b, c) * normal; }
  /// Derivative dS2_b/dx2_c.
  Vector3d with_secondary(Index b, Index c) const { return -secondary[c] * with_place.col(b); }
};

/// Terms of the derivative of nodal flows with respect to the positions at fixed nodal fluxes. The flow is S1_b |a| at
/// a primary node and -S2_b |a| at a secondary node.
struct FlatFlows {
  FlatSums fluxes;            ///< sums of the fluxes
  double area;                ///< area element |a|
  Eigen::Matrix3d with_area;  ///< columns m_b of FlatVariations::area
};

/// The terms for fluxes at the primary nodes; `flux`: fluxes times the time increment.
FlatFlows flat_flows(const FlatPair& pair, const FlatVariations& vary, const Vector3d& flux);

/// The exact derivative of the flow at a primary node with respect to the positions of the primary nodes. It does not
/// depend on the secondary nodes.
Eigen::Matrix<double, 1, 9> primary_rows(const FlatFlows& flows, Index node);

/// The exact derivative of the flow at a secondary node with respect to the positions of all nodes of the pair.
Eigen::Matrix<double, 1, 18> secondary_rows(const FlatFlows& flows, Index node);

/// The exact derivative of the flows at all nodes, one row per node, primary nodes first.
Eigen::Matrix<double, 6, 18> flux_tangent(const FlatFlows& flows);

/// Terms of the derivative (2.6) of nodal forces with the positions at fixed nodal tractions. The force is S1_b a at a
/// primary node and -S2_b a at a secondary node.
struct FlatForces {
  FlatSums tractions;           ///< sums of the normal tractions
  Vector3d area_vector;         ///< area vector a
  Eigen::Matrix3d with_normal;  ///< columns w_b of FlatVariations::area_vector
};

/// The terms for normal tractions at the primary nodes.
FlatForces flat_forces(const FlatPair& pair, const FlatVariations& vary, const Vector3d& traction);

/// The exact derivative of the force at a primary node with respect to the positions of the primary nodes. It does not
/// depend on the secondary nodes.
Eigen::Matrix<double, 3, 9> primary_rows(const FlatForces& forces, Index node);

/// The exact derivative of the force at a secondary node with respect to the positions of all nodes of the pair.
Eigen::Matrix<double, 3, 18> secondary_rows(const FlatForces& forces, Index node);

/// The exact derivative of the forces at all nodes.
FlatTangent traction_tangent(const FlatForces& forces);

}  // namespace mixture_contact
