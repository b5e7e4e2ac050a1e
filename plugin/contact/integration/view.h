/// The view of facets along a direction: positions of their nodes in the plane across it, and variations with the
/// nodes.
#pragma once

#include "geometry/kinematics.h"

namespace mixture_contact {

/// Rows: two directions across the normal; with it, in this order, they are right-handed.
using PlaneAxes = Eigen::Matrix<double, 2, 3>;

/// The view along the normal at a place on a facet.
struct View {
  Vector3d origin;  ///< that place
  Vector3d normal;
  PlaneAxes axes;

  Vector2d seen(const Vector3d& x) const { return axes * (x - origin); }
  double height(const Vector3d& x) const { return normal.dot(x - origin); }
  /// The place in the plane through the origin that appears there.
  Vector3d place(const Vector2d& seen) const { return origin + axes.transpose() * seen; }
};

View view_at(FacetType type, const FacetCoordinates& x, const Vector2d& xi);

/// How the normal of a view turns towards its axes with the nodes of the facet, shape (2, 3 n).
using ViewTilt = Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, 3 * max_facet_nodes>;
ViewTilt view_tilt(const View& view, FacetType type, const FacetCoordinates& x, const Vector2d& xi);

/// Variation of R numbers that depend on where the nodes of a pair of facets appear: with dx of a node of height h that
/// place moves by axes dx - h tilt. A turn of the axes within the plane is left out: nothing that counts depends on it.
template <int R>
class SeenVariation {
 public:
  explicit SeenVariation(Index nodes) : by_node_(Eigen::Matrix<double, R, Eigen::Dynamic>::Zero(R, 2 * nodes)) {}

  /// Adds the variation of the numbers with the position of a node.
  void add(Index node, double height, const Eigen::Matrix<double, R, 2>& by_place) {
    by_node_.template middleCols<2>(2 * node) += by_place;
    by_tilt_ -= height * by_place;
  }
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
