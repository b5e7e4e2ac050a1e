/// Projection of facets along a direction: the positions of their nodes in the plane normal to it, and the variations
/// of quantities in that plane with the nodal positions.
#pragma once

#include "geometry/kinematics.h"

namespace mixture_contact {

/// Two unit vectors in the plane, one per row; they and the normal form a right-handed system.
using PlaneAxes = Eigen::Matrix<double, 2, 3>;

/// A parallel projection along the normal at a point of a facet.
struct View {
  Vector3d origin;  ///< the point of the facet
  /// Unit normal of the facet at the origin.
  Vector3d normal;
  /// Axes of the plane of projection.
  PlaneAxes axes;

  /// Coordinates of a point's projection in the plane.
  Vector2d seen(const Vector3d& x) const { return axes * (x - origin); }
  /// Height of a point above the plane through the origin [length].
  double height(const Vector3d& x) const { return normal.dot(x - origin); }
  /// The point of the plane through the origin that has these plane coordinates.
  Vector3d place(const Vector2d& seen) const { return origin + axes.transpose() * seen; }
};

/// The projection along the normal at the point xi of a facet.
View view_at(FacetType type, const FacetCoordinates& x, const Vector2d& xi);

/// Components of the normal's variation along the two plane axes, with the nodal positions of the facet, shape (2, 3
/// n).
using ViewTilt = Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, 3 * max_facet_nodes>;
ViewTilt view_tilt(const View& view, FacetType type, const FacetCoordinates& x, const Vector2d& xi);

/// Variation of R numbers that depend on the projections of the nodes of a pair of facets. If a node at height h moves
/// by dx, its projection moves by axes dx - h tilt. A rotation of the axes within the plane is left out, because none
/// of the numbers may depend on it.
template <int R>
class SeenVariation {
 public:
  explicit SeenVariation(Index nodes) : by_node_(Eigen::Matrix<double, R, Eigen::Dynamic>::Zero(R, 2 * nodes)) {}

  /// Adds the derivatives of the numbers with respect to the projection of a node. `height`: height of the node above
  /// the plane.
  void add(Index node, double height, const Eigen::Matrix<double, R, 2>& by_place) {
    by_node_.template middleCols<2>(2 * node) += by_place;
    by_tilt_ -= height * by_place;
  }
  /// The variation of the numbers with respect to the nodal positions, in the order of the nodes of the pair.
  PairVariation<R> with_nodes(const View& view, const ViewTilt& tilt) const {
    PairVariation<R> variation(R, 3 * by_node_.cols() / 2);
    for (Index node = 0; 2 * node < by_node_.cols(); ++node) {
      variation.template middleCols<3>(3 * node) = by_node_.template middleCols<2>(2 * node).lazyProduct(view.axes);
    }
    variation.leftCols(tilt.cols()) += by_tilt_.lazyProduct(tilt);
    return variation;
  }

 private:
  Eigen::Matrix<double, R, Eigen::Dynamic, (R == 1 ? Eigen::RowMajor : 0), R, 2 * max_pair_nodes> by_node_;
  Eigen::Matrix<double, R, 2> by_tilt_ = Eigen::Matrix<double, R, 2>::Zero();
};

}  // namespace mixture_contact
