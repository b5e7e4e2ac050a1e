/// First variations of the averages on which friction depends. Without friction they are empty, and the functions do
/// nothing.
#pragma once

#include "mortar/corner_point.h"

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

  bool empty() const { return work.size() == 0; }
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

/// Sets the variations of a node to zero. `patch`: the nodes of its averages. `pairs`: the pairs around it.
void set_zero(SlipLinearisation& linear, const MortarSpace& space, Index node, const Patch& patch,
              const PairsAround& pairs);
/// Sets the parts of a pair to zero, one for each node of its primary facet.
void set_zero(IndexedVector<PairSlip>& corners, const MortarSpace& space, const LocalLayout& displacements);
/// Adds the parts of the points of a pair, which are in ascending order.
void add_slips(IndexedVector<PairSlip>& corners, const MortarSpace& space, const FacetPair& pair,
               const std::vector<CornerPoint>& points, const FacingFields& fields, ScopedTimer& laps);
/// Adds the part of a pair to the sums around a node of its primary facet. `corner`: number of the node in the facet.
void scatter(const IndexedVector<PairSlip>& corners, Index corner, const PairPlaces& place, SlipLinearisation& sum);
/// Divides the sums around a node by its area: d(Y/A) = (dY - Y/A dA)/A.
void divide_by_area(SlipLinearisation& sum, const NodalLoads& loads, Index node);

/// Adds the changes of a node's averages to `friction`. `patch`: nodes of the averages. `moved`: their displacements.
/// `change`: changes of positions and fields.
void predict(NodalFriction& friction, Index node, const SlipLinearisation& linear, const Patch& patch,
             const VectorXd& moved, const FacingFields& change);

/// Memory of the variations [bytes].
std::size_t bytes_of(const SlipLinearisation& linear);

}  // namespace mixture_contact
