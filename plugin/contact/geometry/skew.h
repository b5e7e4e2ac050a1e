/// The cross product as a matrix.
#pragma once

#include "base/types.h"

namespace mixture_contact {

/// Matrix of the cross product: skew(v) w = v x w.
inline Eigen::Matrix3d skew(const Vector3d& v) {
  return (Eigen::Matrix3d() << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0).finished();
}

}  // namespace mixture_contact
