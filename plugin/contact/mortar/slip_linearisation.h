/// First variations of the averages on which friction depends.
#pragma once

#include "base/indexed_vector.h"
#include "geometry/kinematics.h"

namespace mixture_contact {

/// First variations of the averages on which friction depends; empty without friction. Rows are vector components.
struct SlipLinearisation {
  /// Derivatives of s_a and of NodalFriction::area_vector, in this order, with the position of each node of the
  /// patch.
  IndexedVector<Eigen::Matrix<double, 6, 3>> average_variation;
  VectorXd area_variation;    ///< derivative of the node's area, in the order of NodeLinearisation::gap_variation
  Matrix3Xd trial_variation;  ///< derivative dtau_a/du of the trial friction, columns in the order of
                              ///< NodeLinearisation::gap_variation
  Matrix3Xd convection;       ///< coefficients C_b of F_a = sum_b x_b C_b^T, over the primary nodes of the patch
  /// Virtual work of a unit friction traction, sum_q w psi_a |a| h, one entry per node of the patch.
  VectorXd work;
  VectorXd pressure_variation;  ///< derivative d(p~ - p*)/du at fixed nodal values, in the order of
                                ///< NodeLinearisation::gap_variation
  /// Derivative of p~ - p* with respect to the nodal values of p~, one per node of the patch; empty without fluid.
  VectorXd pressure_weights;

  /// The number of nodes, from the first of the patch, on which the mean normal or the node's area depends: all nodes
  /// if points move on their facets, else the primary ones. The remaining nodes affect the slip only.
  Index turning = 0;
  int pressure_field = 0;  ///< index of the pressure in the order of Effects

  bool has_fluid() const { return pressure_weights.size() > 0; }
};

/// The part of a pair in the SlipLinearisation of one node of its primary facet.
struct PairSlip {
  PairVariation<6> average_variation;
  PairVariation<1> area_variation;  ///< variation of the node's area
  PairVector work;
  /// Variation of the pressure, as SlipLinearisation::pressure_variation; empty without fluid.
  PairVariation<1> pressure_variation;
  // Empty without fluid.
  PairVector pressure_weights;

  bool has_fluid() const { return pressure_weights.size() > 0; }
};

/// Memory of the variations [bytes].
std::size_t bytes_of(const SlipLinearisation& linear);

}  // namespace mixture_contact
