#include "tie/gap_vector.h"

#include "geometry/skew.h"

namespace mixture_contact {
namespace {

using Eigen::Matrix3d;

/// The normal at a point of a primary facet, n = a/|a| with the area vector a = x,1 x x,2.
struct NormalAt {
  Vector3d normal;
  double length = 0;               ///< |a|
  IndexedVector<Matrix3d> d_area;  ///< da/dx per node of the facet

  /// I - n n: what of da turns the normal, times |a|.
  Matrix3d across() const { return Matrix3d::Identity() - normal * normal.transpose(); }
};

NormalAt normal_at(const TiedNode& tied, const KeptGap& gap, const Matrix3Xd& x1) {
  Vector3d first = Vector3d::Zero();
  Vector3d second = Vector3d::Zero();
  for (Index b = 0; b < gap.places.count(); ++b) {
    const Vector3d x = x1.col(tied.primary[gap.places[b]]);
    first += gap.gradient(b, 0) * x;
    second += gap.gradient(b, 1) * x;
  }
  const Vector3d area = first.cross(second);
  NormalAt found{area.normalized(), area.norm(), {}};
  for (Index b = 0; b < gap.places.count(); ++b)
    found.d_area.push_back(gap.gradient(b, 1) * skew(first) - gap.gradient(b, 0) * skew(second));
  return found;
}

/// The second derivative of load.n with the area vector.
Matrix3d hessian_by_area(const NormalAt& at, const Vector3d& load) {
  const Vector3d across = at.across() * load;
  const Matrix3d mixed = at.normal * across.transpose();
  return -(at.normal.dot(load) * at.across() + mixed + mixed.transpose()) / (at.length * at.length);
}

void subtract_hessian(const KeptGap& gap, const NormalAt& at, const Vector3d& load, MatrixXd& hessian) {
  const Matrix3d by_area = hessian_by_area(at, load);
  const Matrix3d turning = skew(at.across() * load / at.length);
  for (Index b = 0; b < gap.places.count(); ++b) {
    for (Index c = 0; c < gap.places.count(); ++c) {
      const double minor = gap.gradient(b, 0) * gap.gradient(c, 1) - gap.gradient(b, 1) * gap.gradient(c, 0);
      const Matrix3d of_nodes = at.d_area[b].transpose() * by_area * at.d_area[c] - minor * turning;
      hessian.block<3, 3>(3 * gap.places[b], 3 * gap.places[c]) -= gap.size * of_nodes;
    }
  }
}

}  // namespace

Vector3d gap_vector(const TiedNode& tied, const FacingPositions& x) {
  Vector3d gap = Vector3d::Zero();
  for (Index n = 0; n < tied.primary.count(); ++n) gap += tied.traction.weights[n] * x.primary.col(tied.primary[n]);
  const Index first = tied.primary.count();
  for (Index n = 0; n < tied.secondary.count(); ++n)
    gap += tied.traction.weights[first + n] * x.secondary.col(tied.secondary[n]);
  for (const KeptGap& kept : tied.gaps) gap -= kept.size * normal_at(tied, kept, x.primary).normal;
  return gap;
}

Matrix3Xd gap_variation(const TiedNode& tied, const FacingPositions& x) {
  Matrix3Xd variation = Matrix3Xd::Zero(3, 3 * tied.count());
  for (Index n = 0; n < tied.count(); ++n)
    variation.middleCols<3>(3 * n) = tied.traction.weights[n] * Matrix3d::Identity();
  for (const KeptGap& kept : tied.gaps) {
    const NormalAt at = normal_at(tied, kept, x.primary);
    const Matrix3d d_normal = at.across() / at.length;
    for (Index b = 0; b < kept.places.count(); ++b)
      variation.middleCols<3>(3 * kept.places[b]) -= kept.size * d_normal * at.d_area[b];
  }
  return variation;
}

MatrixXd gap_hessian(const TiedNode& tied, const FacingPositions& x, const Vector3d& load) {
  MatrixXd hessian = MatrixXd::Zero(3 * tied.count(), 3 * tied.count());
  for (const KeptGap& kept : tied.gaps) subtract_hessian(kept, normal_at(tied, kept, x.primary), load, hessian);
  return hessian;
}

}  // namespace mixture_contact
