/// Two flat triangles that face each other over points that count as fixed, by moments of the points.
///
/// Slopes, normal and area element are the same at all points of the pair. The sums over the points with the
/// weights w psi_c, for a node c of the primary triangle, depend on them through sum w psi_c N1 and sum w psi_c N2
/// alone: gap, projected place and forces at the nodes are linear in N1 and N2.
#pragma once

#include "geometry/facet.h"

namespace mixture_contact {

/// Sums over the points of a pair, one row per node c of the primary triangle.
struct FlatMoments {
  Eigen::Matrix3d primary = Eigen::Matrix3d::Zero();    ///< (c, b): sum w psi_c N1_b
  Eigen::Matrix3d secondary = Eigen::Matrix3d::Zero();  ///< (c, b): sum w psi_c N2_b

  /// Adds a point with this quadrature weight; on a triangle psi_c are the shape functions.
  void add(double weight, const Vector2d& xi, const Vector2d& eta);
  /// Sums with psi_c that are redistributed: column c contains the parts of psi_c that the nodes take.
  FlatMoments redistributed(const Eigen::Matrix3d& heirs) const { return {heirs * primary, heirs * secondary}; }
};

/// The coordinates of a triangle's nodes, one column each.
using TriangleCoordinates = Eigen::Matrix3d;
/// A number per node of a flat pair, primary nodes first.
using FlatNodes = Eigen::Matrix<double, 6, 1>;
/// A number that varies with the positions of a flat pair's nodes, three entries per node, in the same order.
using FlatVariation = Eigen::Matrix<double, 18, 1>;
/// Three rows and three columns per node, likewise.
using FlatTangent = Eigen::Matrix<double, 18, 18>;

/// The positions of the triangles: the source of the gaps, forces and areas of the pair.
struct FlatPair {
  FlatMoments moments;
  Vector3d gap{0, 0, 0};          ///< per node c: sum w psi_c g
  Vector3d area_vector{0, 0, 0};  ///< a = x1,1 x x1,2
  Vector3d normal{0, 0, 0};       ///< n1 = a/|a|
  double area = 0;                ///< |a|

  /// Per node c: sum w psi_c.
  Vector3d weight() const { return moments.primary.rowwise().sum(); }
  /// Per node of the pair: sum w psi_c h, with h = (N1, -N2).
  FlatNodes jump_weights(Index c) const;
  /// Per node c: sum w psi_c times the jump of a field with these nodal values.
  Vector3d jump(const FlatNodes& values) const;
};

FlatPair flat_pair(const FlatMoments& moments, const TriangleCoordinates& x1, const TriangleCoordinates& x2);

/// First variations that all points have in common, with the positions x_b of the nodes.
struct FlatVariations {
  Eigen::Matrix3d area_vector;         ///< columns w_b: da = sum_b w_b x dx_b
  Eigen::Matrix3d area;                ///< columns m_b: d|a| = sum_b m_b.dx_b
  Eigen::Matrix<double, 3, 2> eta;     ///< columns T: deta_beta = sum_n h_n T_beta.dx_n - g sum_b k_b,beta n1.dx_b
  Eigen::Matrix<double, 3, 2> tilted;  ///< k, one row per primary node
  Vector2d slope;                      ///< n1.x2,beta
};

FlatVariations flat_variations(const FlatPair& pair, const TriangleCoordinates& x1, const TriangleCoordinates& x2);

/// The force at the nodes of a traction of 1 at node c, (2.5): sum w psi_c h a.
FlatVariation traction_work(const FlatPair& pair, Index c);

/// The variation of a node's average gap, g_c = INT psi_c g da/A_c, with the positions of the pair, to which it is
/// `mean`, the offset included, over the area A_c of all pairs: sum_q [w psi_c |a| dg + (g - g_c) w psi_c d|a|]/A_c.
FlatVariation mean_gap_variation(const FlatPair& pair, const FlatVariations& vary, Index c, double mean,
                                 double nodal_area);

/// The variation of a node's average jump of a field, INT psi_c [p] da/A_c, with the positions of the pair. `values`:
/// the field at the nodes of the pair; `mean`: the average jump over the area A_c of all pairs, `nodal_area` [mm^2].
FlatVariation mean_jump_variation(const FlatPair& pair, const FlatVariations& vary, Index c, const FlatNodes& values,
                                  double mean, double nodal_area);

/// The forces at the nodes of tractions t_c of the primary nodes.
FlatVariation traction_residual(const FlatPair& pair, const Vector3d& traction);

/// The flows at the nodes of fluxes q_c of the primary nodes, times a time increment: sum w |a| q h.
FlatNodes flux_residual(const FlatPair& pair, const Vector3d& flux);

/// Sums of loads l_c of the primary nodes over the points, which forces and flows at the nodes are made of, with their
/// derivatives.
struct FlatSums {
  Vector3d primary;    ///< S1_b = sum w l N1_b
  Vector3d secondary;  ///< S2_b = sum w l N2_b
  Vector3d normal;     ///< n1
  // dS2_b = p_b.(sum_c S1_c dx1_c - sum_c S2_c dx2_c) - sum_c t_bc n1.dx1_c
  Eigen::Matrix3d with_place;  ///< columns p_b = N2_b,beta T_beta
  Eigen::Matrix3d with_tilt;   ///< t_bc = N2_b,beta k_c,beta sum w l g

  /// dS2_b/dx1_c
  Vector3d with_primary(Index b, Index c) const { return primary[c] * with_place.col(b) - with_tilt(b, c) * normal; }
  /// dS2_b/dx2_c
  Vector3d with_secondary(Index b, Index c) const { return -secondary[c] * with_place.col(b); }
};

/// The terms of the derivative of these flows with the positions, the fluxes held: S1_b |a| at a primary node and
/// -S2_b |a| at a secondary one.
struct FlatFlows {
  FlatSums fluxes;
  double area;                ///< |a|
  Eigen::Matrix3d with_area;  ///< columns m_b, as FlatVariations::area
};

FlatFlows flat_flows(const FlatPair& pair, const FlatVariations& vary, const Vector3d& flux);

/// The exact derivative of the flow at a primary node with the positions of the primary nodes, on which alone it
/// depends.
Eigen::Matrix<double, 1, 9> primary_rows(const FlatFlows& flows, Index node);

/// The exact derivative of the flow at a secondary node with the positions of all nodes of the pair.
Eigen::Matrix<double, 1, 18> secondary_rows(const FlatFlows& flows, Index node);

/// All rows, one per node.
Eigen::Matrix<double, 6, 18> flux_tangent(const FlatFlows& flows);

/// The terms of the derivative of these forces, (2.6), the tractions held: S1_b a at a primary node and -S2_b a at
/// a secondary one.
struct FlatForces {
  FlatSums tractions;
  Vector3d area_vector;         ///< a
  Eigen::Matrix3d with_normal;  ///< columns w_b, as FlatVariations::area_vector
};

FlatForces flat_forces(const FlatPair& pair, const FlatVariations& vary, const Vector3d& traction);

/// The exact derivative of the force at a primary node with the positions of the primary nodes, on which alone it
/// depends.
Eigen::Matrix<double, 3, 9> primary_rows(const FlatForces& forces, Index node);

/// The exact derivative of the force at a secondary node with the positions of all nodes of the pair.
Eigen::Matrix<double, 3, 18> secondary_rows(const FlatForces& forces, Index node);

/// All rows.
FlatTangent traction_tangent(const FlatForces& forces);

}  // namespace mixture_contact
