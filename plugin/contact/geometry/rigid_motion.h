/// Motions of rigid bodies to which nodes of a surface belong.
#pragma once

#include "base/indexed_vector.h"
#include "base/types.h"

#include <Eigen/Geometry>

namespace mixture_contact {

/// Position and orientation of a rigid body.
struct RigidPose {
  Vector3d centre;  ///< the point whose displacement is an unknown, the body's centre of mass [mm]
  Eigen::Quaterniond rotation;
};

/// The rigid bodies of a surface.
struct RigidParts {
  IndexedVector<RigidPose> poses;  ///< per body
  IndexedVector<int> body;         ///< per node, its body; -1 for a deformable node; empty if there is no rigid body
};

/// The displacements of nodes less those that are linear in displacement u and rotation theta of rigid bodies,
/// u + theta x (x - c) [mm]; shape (3, nodes), zero at deformable nodes. No columns if no body has turned.
///
/// `from`, `to`: the bodies at both states; `before`, `after`: the positions of the nodes there [mm], shape (3, nodes).
Matrix3Xd beyond_linear(const RigidParts& from, const RigidParts& to, const Matrix3Xd& before, const Matrix3Xd& after);

}  // namespace mixture_contact
