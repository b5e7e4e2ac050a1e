/// The gap vector of a tied node, D_a = sum_j W_aj x_j - INT psi_a g0 n1 dA / A_a, and its derivatives.
///
/// A gap that is kept follows the normal of the primary surface, so that D turns with the bodies: D(Q x + c) = Q D(x).
/// Forces that are derivatives of a function of |D| then have no moment.
#pragma once

#include "tie/tied_node.h"

namespace mixture_contact {

/// D_a at these positions [mm].
Vector3d gap_vector(const TiedNode& tied, const FacingPositions& x);

/// dD_a/dx, shape (3, 3 nodes).
Matrix3Xd gap_variation(const TiedNode& tied, const FacingPositions& x);

/// The second derivative of load.D_a with the positions, shape (3 nodes, 3 nodes); symmetric, zero without kept gaps.
MatrixXd gap_hessian(const TiedNode& tied, const FacingPositions& x, const Vector3d& load);

/// The unit normal of a tied node out of the primary body, as its facets lie now; find_normals() gives it these. Then
/// dn/dx, shape (3, 3 nodes), and the second derivative of load.n, shape (3 nodes, 3 nodes).
Vector3d normal_of(const TiedNode& tied, const FacingPositions& x);
Matrix3Xd normal_variation(const TiedNode& tied, const FacingPositions& x);
MatrixXd normal_hessian(const TiedNode& tied, const FacingPositions& x, const Vector3d& load);

}  // namespace mixture_contact
