/// Kinematics of one integration point: area vector, gap, projected point, and their exact variations with respect to
/// the nodal positions.
#pragma once

#include "geometry/facet.h"

namespace mixture_contact {

/// A point of the primary facet and its projection on the secondary facet.
///
/// The area vector a = x1,1 x x1,2 carries both the normal n1 = a/|a| and the area element da1 = |a| dxi. The projected
/// point satisfies x2(eta) - x1 = g n1 with the gap g.
struct PointKinematics {
  FacetVector primary_shape;                       ///< shape functions N1_a(xi)
  FacetGradient primary_gradient;                  ///< gradients N1_a,alpha(xi)
  FacetVector secondary_shape;                     ///< shape functions N2_b(eta)
  FacetGradient secondary_gradient;                ///< gradients N2_b,beta(eta)
  Eigen::Matrix<double, 3, 2> primary_tangents;    ///< tangents x1,alpha
  Eigen::Matrix<double, 3, 2> secondary_tangents;  ///< tangents x2,beta
  Vector3d area_vector;                            ///< area vector a
  Vector3d normal;                                 ///< unit normal n1
  double area = 0;                                 ///< area element |a|
  double gap = 0;                                  ///< gap g = (x2 - x1).n1, negative where the bodies overlap

  Index primary_nodes() const { return primary_shape.size(); }
  Index nodes() const { return primary_shape.size() + secondary_shape.size(); }

  /// Weights of the nodes in the jump of a field, h = (N1, -N2): jump = h . nodal values. They add up to zero.
  PairVector jump_weights() const;
};

/// The kinematics for the shape functions at xi and eta and the nodal coordinates of both facets.
PointKinematics point_kinematics(const ShapeFunctions& primary, const FacetCoordinates& x1,
                                 const ShapeFunctions& secondary, const FacetCoordinates& x2);

/// Moves the point of a pair of flat facets to the position where the shape functions have these values; normal and
/// area stay the same.
void move_on_flat_facets(PointKinematics& point, const FacetVector& primary, const FacetCoordinates& x1,
                         const FacetVector& secondary, const FacetCoordinates& x2);

/// Variations of a point's position on the primary facet and of its weight with respect to the nodal positions of both
/// facets. Both are empty for a point that is fixed on the facet.
struct PointMotion {
  PairVariation<2> xi;                                  ///< variation d xi_alpha of the position on the primary facet
  PairVariation<1> weight;                              ///< relative variation d(weight)/weight
  Eigen::Matrix3d curvature = Eigen::Matrix3d::Zero();  ///< columns x1,11, x1,22, x1,12, at the point

  /// True for a point that is fixed on the facet.
  bool is_none() const { return weight.size() == 0; }
};

/// Variation of an area vector a = x,1 x x,2 with the nodal positions of its facet at fixed xi, shape (3, 3 nodes).
/// `tangents`: x,alpha. `nodes`: number of nodes with columns; the columns of nodes beyond the facet's own are zero.
PairVariation<3> area_vector_variation(const Eigen::Matrix<double, 3, 2>& tangents, const FacetGradient& gradient,
                                       Index nodes);

/// Derivative of an area vector with respect to xi. `tangents`: x,alpha. `curvature`: columns x,11, x,22, x,12.
Eigen::Matrix<double, 3, 2> area_vector_slope(const Eigen::Matrix<double, 3, 2>& tangents,
                                              const Eigen::Matrix3d& curvature);

/// First variations of a point's kinematics with respect to the nodal positions of both facets, three columns per node.
struct KinematicVariations {
  PairVariation<1> gap;          ///< variation dg of the gap
  PairVariation<2> eta;          ///< variation d eta_beta: motion of the projected point on the secondary facet
  PairVariation<3> area_vector;  ///< variation da of the area vector
  PairVariation<1> area;         ///< variation d|a| of the area element
  PairVariation<2> xi;      ///< variation d xi_alpha: motion of the point on the primary facet; empty for a fixed point
  PairVariation<1> weight;  ///< relative variation d(weight)/weight; empty for a fixed point

  /// True if the point moves on the primary facet.
  bool wanders() const { return weight.size() > 0; }
};

/// The exact variations of a point, from (x2(eta) - x1).x1,alpha = 0 and g = (x2 - x1).n1. `motion`: the point's motion
/// on the primary facet.
KinematicVariations kinematic_variations(const PointKinematics& point, const PointMotion& motion = {});

}  // namespace mixture_contact
