/// Eigen types of the contact core.
#pragma once

#include <Eigen/Core>
#include <limits>

namespace mixture_contact {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// A vector of NaN, for values that are not known yet; comparisons with them are false.
inline VectorXd unknown_values(Index count) {
  return VectorXd::Constant(count, std::numeric_limits<double>::quiet_NaN());
}

/// Largest number of nodes of a facet (quad9).
inline constexpr int max_facet_nodes = 9;
/// Largest number of nodes of a pair of facets.
inline constexpr int max_pair_nodes = 2 * max_facet_nodes;
/// Largest number of displacements of a pair of facets.
inline constexpr int max_pair_displacements = 3 * max_pair_nodes;

/// One value per node of a facet, shape (n).
using FacetVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, max_facet_nodes, 1>;
/// Parametric derivatives per node of a facet, shape (n, 2).
using FacetGradient = Eigen::Matrix<double, Eigen::Dynamic, 2, 0, max_facet_nodes, 2>;
/// Second parametric derivatives per node of a facet: columns 11, 22, 12, shape (n, 3).
using FacetHessian = Eigen::Matrix<double, Eigen::Dynamic, 3, 0, max_facet_nodes, 3>;
/// Nodal coordinates of a facet, one column per node, shape (3, n).
using FacetCoordinates = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, max_facet_nodes>;
/// One value per node of a pair of facets, primary nodes first, shape (n1 + n2).
using PairVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, max_pair_nodes, 1>;
/// The positions of a pair's nodes in a larger patch.
using PairPlaces = Eigen::Matrix<Index, Eigen::Dynamic, 1, 0, max_pair_nodes, 1>;
/// Variation of a quantity with R components with respect to the nodal positions of a pair, shape (R, 3 (n1 + n2)).
template <int R>
using PairVariation = Eigen::Matrix<double, R, Eigen::Dynamic, (R == 1 ? Eigen::RowMajor : 0), R,
                                    max_pair_displacements>;

}  // namespace mixture_contact
