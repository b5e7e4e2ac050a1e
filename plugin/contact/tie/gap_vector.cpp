#include "tie/gap_vector.h"

#include "geometry/skew.h"

#include <Eigen/Geometry>
#include <array>

namespace mixture_contact {
namespace {

using Eigen::Matrix3d;

/// A mean normal over points on primary facets: n = a/|a| with the sum a of the area vectors x,1 x x,2 at the points.
struct NormalAt {
  Vector3d normal;
  double length = 0;               ///< length |a| of the area vector
  IndexedVector<int> nodes;        ///< nodes of the facets on the primary surface, facet by facet
  IndexedVector<Matrix3d> d_area;  ///< da/dx for each entry of `nodes`

  /// The derivative dn/da.
  Matrix3d by_area() const { return (Matrix3d::Identity() - normal * normal.transpose()) / length; }
};

/// The tangents x,1 and x,2 at a point of a facet, shape (3, 2).
Eigen::Matrix<double, 3, 2> tangents_at(const PlaceOnFacet& place, const Matrix3Xd& x1) {
  Eigen::Matrix<double, 3, 2> tangents = Eigen::Matrix<double, 3, 2>::Zero();
  for (Index b = 0; b < place.nodes.count(); ++b) tangents += x1.col(place.nodes[b]) * place.gradient.row(b);
  return tangents;
}

/// The mean normal at points on primary facets. `places`: a range of PlaceOnFacet.
template <class Places>
NormalAt normal_at(const Places& places, const Matrix3Xd& x1) {
  NormalAt found;
  Vector3d area = Vector3d::Zero();
  for (const PlaceOnFacet& place : places) {
    const Eigen::Matrix<double, 3, 2> tangents = tangents_at(place, x1);
    const Vector3d first = tangents.col(0);
    const Vector3d second = tangents.col(1);
    area += first.cross(second);
    for (Index b = 0; b < place.nodes.count(); ++b) {
      found.nodes.push_back(place.nodes[b]);
      found.d_area.push_back(place.gradient(b, 1) * skew(first) - place.gradient(b, 0) * skew(second));
    }
  }
  found.normal = area.normalized();
  found.length = area.norm();
  return found;
}

NormalAt normal_at(const KeptGap& gap, const Matrix3Xd& x1) {
  return normal_at(std::array<PlaceOnFacet, 1>{gap.at}, x1);
}

/// The column of the first coordinate of a primary node in the variations of a tied node.
Index column_of(const TiedNode& tied, int node) { return 3 * position_in(tied.primary, node); }

void add_variation(const TiedNode& tied, const NormalAt& at, double factor, Matrix3Xd& variation) {
  const Matrix3d by_area = factor * at.by_area();
  for (Index b = 0; b < at.nodes.count(); ++b)
    variation.middleCols<3>(column_of(tied, at.nodes[b])) += by_area * at.d_area[b];
}

/// The second derivative of load.n with the area vector.
Matrix3d hessian_by_area(const NormalAt& at, const Vector3d& load) {
  const Matrix3d across = Matrix3d::Identity() - at.normal * at.normal.transpose();
  const Vector3d part = across * load;
  const Matrix3d mixed = at.normal * part.transpose();
  return -(at.normal.dot(load) * across + mixed + mixed.transpose()) / (at.length * at.length);
}

/// Adds the second derivative of load.n with the positions.
template <class Places>
void add_hessian(const TiedNode& tied, const Places& places, const NormalAt& at, const Vector3d& load,
                 MatrixXd& hessian) {
  const Matrix3d by_area = hessian_by_area(at, load);
  for (Index b = 0; b < at.nodes.count(); ++b) {
    for (Index c = 0; c < at.nodes.count(); ++c)
      hessian.block<3, 3>(column_of(tied, at.nodes[b]), column_of(tied, at.nodes[c])) += at.d_area[b].transpose() *
                                                                                         by_area * at.d_area[c];
  }
  const Matrix3d turning = skew(at.by_area() * load);
  for (const PlaceOnFacet& place : places) {
    for (Index b = 0; b < place.nodes.count(); ++b) {
      for (Index c = 0; c < place.nodes.count(); ++c) {
        const double minor = place.gradient(b, 0) * place.gradient(c, 1) - place.gradient(b, 1) * place.gradient(c, 0);
        hessian.block<3, 3>(column_of(tied, place.nodes[b]), column_of(tied, place.nodes[c])) -= minor * turning;
      }
    }
  }
}

}  // namespace

Vector3d gap_vector(const TiedNode& tied, const FacingPositions& x) {
  // The weights add up to zero. Positions relative to the node are smaller, and the sum has smaller rounding errors.
  const Vector3d origin = x.primary.col(tied.node);
  Vector3d gap = Vector3d::Zero();
  for (Index n = 0; n < tied.primary.count(); ++n)
    gap += tied.traction.weights[n] * (x.primary.col(tied.primary[n]) - origin);
  const Index first = tied.primary.count();
  for (Index n = 0; n < tied.secondary.count(); ++n)
    gap += tied.traction.weights[first + n] * (x.secondary.col(tied.secondary[n]) - origin);
  for (const KeptGap& kept : tied.gaps) gap -= kept.size * normal_at(kept, x.primary).normal;
  return gap;
}

Matrix3Xd gap_variation(const TiedNode& tied, const FacingPositions& x) {
  Matrix3Xd variation = Matrix3Xd::Zero(3, 3 * tied.count());
  for (Index n = 0; n < tied.count(); ++n)
    variation.middleCols<3>(3 * n) = tied.traction.weights[n] * Matrix3d::Identity();
  for (const KeptGap& kept : tied.gaps) add_variation(tied, normal_at(kept, x.primary), -kept.size, variation);
  return variation;
}

MatrixXd gap_hessian(const TiedNode& tied, const FacingPositions& x, const Vector3d& load) {
  MatrixXd hessian = MatrixXd::Zero(3 * tied.count(), 3 * tied.count());
  for (const KeptGap& kept : tied.gaps)
    add_hessian(tied, std::array<PlaceOnFacet, 1>{kept.at}, normal_at(kept, x.primary), -kept.size * load, hessian);
  return hessian;
}

Vector3d normal_of(const TiedNode& tied, const FacingPositions& x) { return normal_at(tied.corners, x.primary).normal; }

Vector3d faced_normal(const TiedNode& tied, const FacingPositions& x) {
  return -normal_at(tied.faced, x.secondary).normal;
}

Matrix3Xd normal_variation(const TiedNode& tied, const FacingPositions& x) {
  Matrix3Xd variation = Matrix3Xd::Zero(3, 3 * tied.count());
  add_variation(tied, normal_at(tied.corners, x.primary), 1, variation);
  return variation;
}

MatrixXd normal_hessian(const TiedNode& tied, const FacingPositions& x, const Vector3d& load) {
  MatrixXd hessian = MatrixXd::Zero(3 * tied.count(), 3 * tied.count());
  add_hessian(tied, tied.corners, normal_at(tied.corners, x.primary), load, hessian);
  return hessian;
}

}  // namespace mixture_contact
