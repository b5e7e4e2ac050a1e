/// Random pairs of facets in contact, and central differences with derived steps, for the unit tests.
#pragma once

#include "contact/conditions/normal.h"
#include "contact/geometry/projection.h"
#include "contact/mortar/point_integral.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

namespace test {

using namespace mixture_contact;

inline constexpr std::array all_facets{FacetType::tri3,  FacetType::tri6,  FacetType::tri7,
                                       FacetType::quad4, FacetType::quad8, FacetType::quad9};

#ifdef MIXCONTACT_SANITIZED
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

/// Pairs of facet types: each primary type of `ones` with each secondary type of `twos`.
///
/// A sanitized build has fewer pairs, because a sanitizer tests memory and not values. Memory that belongs to one side
/// depends on the type of that side only, and shared memory is largest for the last pair. The build has each type once
/// on each side, with triangles and quadrilaterals mixed, and the last pair.
template <std::size_t N, std::size_t M>
std::vector<std::pair<FacetType, FacetType>> facet_pairs(const std::array<FacetType, N>& ones,
                                                         const std::array<FacetType, M>& twos) {
  std::vector<std::pair<FacetType, FacetType>> result;
  if (sanitized) {
    for (std::size_t i = 0; i < std::max(N, M); ++i) result.emplace_back(ones[i % N], twos[(i + 1) % M]);
    result.emplace_back(ones.back(), twos.back());
    return result;
  }
  for (const FacetType one : ones) {
    for (const FacetType two : twos) result.emplace_back(one, two);
  }
  return result;
}

inline std::vector<std::pair<FacetType, FacetType>> facet_pairs() { return facet_pairs(all_facets, all_facets); }

/// Step of a central difference of a function of size 1 that varies over a length of 1. The truncation error step^2 and
/// the rounding error epsilon/step are equal at step = epsilon^(1/3), where the error is about epsilon^(2/3) = 4e-11.
inline const double difference_step = std::cbrt(std::numeric_limits<double>::epsilon());

/// Central-difference derivative of a vector function, shape (rows, x.size()).
inline MatrixXd differences(const std::function<VectorXd(const VectorXd&)>& function, const VectorXd& x,
                            double step = difference_step) {
  MatrixXd derivative(function(x).size(), x.size());
  for (Index i = 0; i < x.size(); ++i) {
    VectorXd up = x;
    VectorXd down = x;
    up[i] += step;
    down[i] -= step;
    derivative.col(i) = (function(up) - function(down)) / (up[i] - down[i]);
  }
  return derivative;
}

/// Central-difference derivative without the truncation error of second order (Richardson extrapolation). For functions
/// that vary over lengths l well below 1, the error is (step/l)^4.
inline MatrixXd fine_differences(const std::function<VectorXd(const VectorXd&)>& function, const VectorXd& x) {
  return (4 * differences(function, x, 0.5 * difference_step) - differences(function, x)) / 3;
}

/// Bound on the relative error of a central difference. Third derivatives are up to 1e3 times the first (facets
/// of size 1 with slopes and curvatures up to 1, whose powers multiply). The error is then 1e3 step^2/6 + epsilon/step
/// = 6e-9; the bound is 1e-7.
inline constexpr double difference_tolerance = 1e-7;

/// Rounding error of a sum of a few dozen terms of size 1, each the result of about a dozen operations.
inline constexpr double rounding = 500 * std::numeric_limits<double>::epsilon();

inline double relative_error(const MatrixXd& value, const MatrixXd& reference) {
  return (value - reference).norm() / reference.norm();
}

/// A random point inside a facet, in parametric coordinates.
inline Vector2d random_inside(FacetType type, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const Vector2d square(unit(random), unit(random));
  if (!is_triangle(type)) return square;
  const Vector2d folded = 0.5 * (square + Vector2d::Ones());
  return folded.sum() > 1 ? Vector2d(Vector2d::Ones() - folded) : folded;
}

inline Vector3d random_vector(double size, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  return size * Vector3d(unit(random), unit(random), unit(random));
}

inline VectorXd random_values(Index size, double low, double high, std::mt19937& random) {
  std::uniform_real_distribution<double> value(low, high);
  return VectorXd::NullaryExpr(size, [&] { return value(random); });
}

/// A facet in the plane z = 0 that faces upwards, of size 1 to 2. Each node is displaced at random by up to `noise`.
inline FacetCoordinates random_facet(FacetType type, double noise, std::mt19937& random) {
  FacetCoordinates x(3, node_count(type));
  for (int a = 0; a < node_count(type); ++a) {
    x.col(a) << parametric_node(type, a), 0;
    x.col(a) += random_vector(noise, random);
  }
  return x;
}

/// A pair of facets, one above the other, with random slope, warp and overlap, and random fields.
struct RandomContact {
  FacetType primary;
  FacetType secondary;
  LocalLayout layout;
  VectorXd unknowns;  ///< positions and fields in the order of the layout
  Vector2d xi;
  double weight = 0.7;
  double dt = 0.3;
  double traction = -0.4;
  VectorXd flux;

  RandomContact(FacetType one, FacetType two, Index fields, std::mt19937& random)
      : primary(one), secondary(two), layout(node_count(one), node_count(two), fields) {
    std::uniform_real_distribution<double> unit(-1, 1);
    const auto noise = [&](double size) { return size * unit(random); };
    unknowns.resize(layout.size());
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(noise(0.5), Vector3d(noise(1), noise(1), 1).normalized())
                                     .toRotationMatrix();
    for (Index node = 0; node < layout.nodes(); ++node) {
      const bool first = node < layout.primary_nodes();
      const Vector2d s = parametric_node(first ? one : two,
                                         static_cast<int>(first ? node : node - layout.primary_nodes()));
      const Vector2d centred = s - parametric_centre(first ? one : two);
      const double size = first ? 1.0 : 1.6;
      Vector3d x(size * centred[0], size * (first ? 1 : -1) * centred[1], first ? 0.0 : -0.1);
      x += Vector3d(noise(0.08), noise(0.08), noise(0.08));
      unknowns.segment<3>(layout.displacement(node, 0)) = turn * x;
      for (Index k = 0; k < fields; ++k) unknowns[layout.scalar(node, k)] = noise(1);
    }
    xi = parametric_centre(one) + Vector2d(noise(0.2), noise(0.2));
    flux = VectorXd::NullaryExpr(fields, [&] { return noise(1); });
  }

  FacetCoordinates coordinates(const VectorXd& q, bool first) const {
    const Index begin = first ? 0 : layout.primary_nodes();
    const Index count = first ? layout.primary_nodes() : layout.nodes() - layout.primary_nodes();
    FacetCoordinates x(3, count);
    for (Index a = 0; a < count; ++a) x.col(a) = q.segment<3>(layout.displacement(begin + a, 0));
    return x;
  }

  PairFields fields(const VectorXd& q) const {
    PairFields values(layout.nodes(), layout.scalar_fields());
    for (Index node = 0; node < layout.nodes(); ++node) {
      for (Index k = 0; k < layout.scalar_fields(); ++k) values(node, k) = q[layout.scalar(node, k)];
    }
    return values;
  }

  /// The intersection of the primary normal at xi with the secondary facet.
  RayHit projection(const VectorXd& q) const {
    const FacetCoordinates x1 = coordinates(q, true);
    const ShapeFunctions shape = shape_functions(primary, xi);
    const Eigen::Matrix<double, 3, 2> tangents = x1 * shape.gradient;
    const Vector3d normal = tangents.col(0).cross(tangents.col(1)).normalized();
    const auto hit = intersect(secondary, coordinates(q, false), x1 * shape.value, normal, 0.5);
    if (!hit) throw std::runtime_error("the random facets do not face each other");
    return *hit;
  }

  PointKinematics kinematics(const VectorXd& q) const {
    return point_kinematics(shape_functions(primary, xi), coordinates(q, true),
                            shape_functions(secondary, projection(q).eta), coordinates(q, false));
  }

  PointLoads loads() const {
    PointLoads result;
    result.traction = traction;
    result.flux = flux;
    result.weight = weight;
    result.time_increment = dt;
    return result;
  }

  VectorXd residual(const VectorXd& q) const { return residual(kinematics(q), loads()); }

  VectorXd residual(const PointKinematics& point, const PointLoads& loads) const {
    VectorXd sum = VectorXd::Zero(layout.size());
    add_residual(point, loads, layout, sum);
    return sum;
  }

  MatrixXd tangent(const VectorXd& q) const { return tangent(kinematics(q), loads()); }

  /// The complete tangent, assembled from the blocks of all effects.
  MatrixXd tangent(const PointKinematics& point, const PointLoads& loads) const {
    const KinematicVariations vary = kinematic_variations(point);
    const LocalLayout solid(layout.primary_nodes(), layout.nodes() - layout.primary_nodes(), 0);
    const LocalLayout one_field(layout.primary_nodes(), layout.nodes() - layout.primary_nodes(), 1);
    const std::vector<Index> displacements = entries(solid, -1);
    MatrixXd all = MatrixXd::Zero(layout.size(), layout.size());
    MatrixXd forces = MatrixXd::Zero(solid.size(), solid.size());
    add_traction_tangent(point, vary, normal_force(point, vary, loads), forces);
    all(displacements, displacements) = forces;
    for (Index k = 0; k < layout.scalar_fields(); ++k) {
      std::vector<Index> rows;
      for (Index node = 0; node < layout.nodes(); ++node) rows.push_back(layout.scalar(node, k));
      MatrixXd flows = MatrixXd::Zero(layout.nodes(), one_field.size());
      add_flux_tangent(point, vary, loads, k, one_field, flows);
      all(rows, entries(one_field, k)) = flows;
    }
    return all;
  }

  /// Positions of the entries of a part of the layout in the complete layout: displacements, and field k unless k is
  /// negative.
  std::vector<Index> entries(const LocalLayout& part, Index k) const {
    std::vector<Index> result(static_cast<std::size_t>(part.size()));
    for (Index node = 0; node < layout.nodes(); ++node) {
      for (Index i = 0; i < 3; ++i) {
        result[static_cast<std::size_t>(part.displacement(node, i))] = layout.displacement(node, i);
      }
      if (k >= 0) result[static_cast<std::size_t>(part.scalar(node, 0))] = layout.scalar(node, k);
    }
    return result;
  }
};

}  // namespace test
