/// The gap vector of a tied node, D_a = sum_j W_aj x_j - INT psi_a g0 n1 dA / A_a, and its derivatives.
///
/// A kept initial gap g0 n1 follows the normal of the primary surface, so that D rotates with the bodies: D(Q x + c) =
/// Q D(x). Forces that derive from a function of |D| therefore have no moment.
#pragma once

#include "tie/tied_node.h"

namespace mixture_contact {

/// The gap vector D_a at the positions x [mm].
Vector3d gap_vector(const TiedNode& tied, const FacingPositions& x);

/// The derivative dD_a/dx with the positions of the tied node's nodes, shape (3, 3 nodes).
Matrix3Xd gap_variation(const TiedNode& tied, const FacingPositions& x);

/// The second derivative of load.D_a with the positions, shape (3 nodes, 3 nodes). It is symmetric, and zero if no gap
/// is kept.
MatrixXd gap_hessian(const TiedNode& tied, const FacingPositions& x, const Vector3d& load);

/// The present unit normal at a tied node, out of the primary body; find_normals() must have set the facets.
Vector3d normal_of(const TiedNode& tied, const FacingPositions& x);
/// The present unit normal of the facets that a tied node faces, out of the primary body; find_faced_normals() must
/// have set the facets.
Vector3d faced_normal(const TiedNode& tied, const FacingPositions& x);
/// The derivative dn/dx of normal_of(), shape (3, 3 nodes).
Matrix3Xd normal_variation(const TiedNode& tied, const FacingPositions& x);
/// The second derivative of load.n with the positions, where n is normal_of(); shape (3 nodes, 3 nodes).
MatrixXd normal_hessian(const TiedNode& tied, const FacingPositions& x, const Vector3d& load);

}  // namespace mixture_contact
