#include "contact/mortar/point_integral.h"

#include "random_contact.h"

#include <boost/test/unit_test.hpp>

#include <string>

using namespace test;

namespace {

constexpr int fields = 3;  // a solvent and two solutes; the point integral treats them alike
constexpr double balance_tolerance = 1e-12;

/// Calls `check` for random contacts of every pair of facet types.
template <class Check>
void for_every_pair(unsigned seed, int samples, const Check& check) {
  std::mt19937 random(seed);
  for (const auto& [one, two] : facet_pairs()) {
    for (int sample = 0; sample < samples; ++sample) check(RandomContact(one, two, fields, random));
  }
}

/// Entries of one kind of unknown (-1: displacements; k: field k) on one side.
std::vector<Index> entries(const LocalLayout& layout, bool primary, int kind) {
  std::vector<Index> result;
  const Index begin = primary ? 0 : layout.primary_nodes();
  const Index end = primary ? layout.primary_nodes() : layout.nodes();
  for (Index node = begin; node < end; ++node) {
    if (kind >= 0) result.push_back(layout.scalar(node, kind));
    for (Index i = 0; kind < 0 && i < 3; ++i) result.push_back(layout.displacement(node, i));
  }
  return result;
}

/// A vector whose product with a residual is the sum over all nodes of displacement component i (kind -1 - i) or of
/// field k (kind k).
VectorXd sum_of(const LocalLayout& layout, int kind) {
  VectorXd pick = VectorXd::Zero(layout.size());
  for (Index node = 0; node < layout.nodes(); ++node) {
    pick[kind < 0 ? layout.displacement(node, -1 - kind) : layout.scalar(node, kind)] = 1;
  }
  return pick;
}

Vector3d moment_sum(const LocalLayout& layout, const VectorXd& residual, const VectorXd& position) {
  Vector3d sum(0, 0, 0);
  for (Index node = 0; node < layout.nodes(); ++node) {
    const Vector3d x = position.segment<3>(layout.displacement(node, 0));
    sum += x.cross(residual.segment<3>(layout.displacement(node, 0)));
  }
  return sum;
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_tangent_block_matches_differences_for_every_pair_of_facets) {
  std::map<std::string, double> worst;
  for_every_pair(1, 10, [&](const RandomContact& contact) {
    const MatrixXd exact = contact.tangent(contact.unknowns);
    const MatrixXd approximate = differences([&](const VectorXd& q) { return contact.residual(q); }, contact.unknowns);
    for (int row = -1; row < fields; ++row) {
      for (int column = -1; column < fields; ++column) {
        for (const auto& [row_side, column_side] :
             {std::pair{true, true}, {true, false}, {false, true}, {false, false}}) {
          const std::vector<Index> rows = entries(contact.layout, row_side, row);
          const std::vector<Index> columns = entries(contact.layout, column_side, column);
          const MatrixXd block = exact(rows, columns);
          const MatrixXd difference = approximate(rows, columns);
          // Loads are given and do not depend on fields. The point is fixed on the primary surface, whose forces and
          // flows therefore do not depend on the secondary surface.
          if (column >= 0 || (row_side && !column_side)) {
            BOOST_TEST(block.norm() == 0.0);
            BOOST_TEST(difference.norm() == 0.0);
            continue;
          }
          const double error = relative_error(difference, block);
          BOOST_TEST(error <= difference_tolerance);
          double& largest = worst[row < 0 ? "uu" : "field, u"];
          largest = std::max(largest, error);
        }
      }
    }
  });
  for (const auto& [block, error] : worst)
    BOOST_TEST_MESSAGE("tangent " << block << ": largest relative difference " << error);
}

BOOST_AUTO_TEST_CASE(forces_and_flows_of_the_two_sides_cancel) {
  double worst = 0;
  for_every_pair(2, 20, [&](const RandomContact& contact) {
    const VectorXd residual = contact.residual(contact.unknowns);
    for (int kind = -3; kind < fields; ++kind) {
      const VectorXd pick = sum_of(contact.layout, kind);
      const double imbalance = std::abs(pick.dot(residual)) / pick.dot(residual.cwiseAbs());
      worst = std::max(worst, imbalance);
      BOOST_TEST(imbalance <= balance_tolerance);
    }
  });
  BOOST_TEST_MESSAGE("balance of one pair of facets: largest relative imbalance " << worst);
}

BOOST_AUTO_TEST_CASE(moments_of_the_two_sides_cancel_at_any_gap) {
  // The traction acts along the line from x1 to its projection x2, and the moments of both sides cancel.
  for_every_pair(3, 20, [](const RandomContact& contact) {
    const VectorXd residual = contact.residual(contact.unknowns);
    const Vector3d moment = moment_sum(contact.layout, residual, contact.unknowns);
    BOOST_TEST(moment.norm() <= balance_tolerance * residual.norm());
  });
}

BOOST_AUTO_TEST_CASE(the_tangent_keeps_the_balance_and_ignores_translations) {
  for_every_pair(4, 5, [](const RandomContact& contact) {
    const MatrixXd tangent = contact.tangent(contact.unknowns);
    for (int kind = -3; kind < fields; ++kind) {
      const VectorXd pick = sum_of(contact.layout, kind);
      BOOST_TEST((pick.transpose() * tangent).norm() <= balance_tolerance * tangent.norm());
      BOOST_TEST((tangent * pick).norm() <= balance_tolerance * tangent.norm());
    }
  });
}

BOOST_AUTO_TEST_CASE(loads_are_spread_with_the_shape_functions) {
  for_every_pair(5, 2, [](const RandomContact& contact) {
    const PointKinematics point = contact.kinematics(contact.unknowns);
    const PointLoads loads = contact.loads();
    const VectorXd residual = contact.residual(point, loads);
    for (Index node = 0; node < contact.layout.nodes(); ++node) {
      const double share = loads.weight * point.jump_weights()[node];
      const Vector3d force = share * loads.traction * point.area_vector;
      BOOST_TEST((residual.segment<3>(contact.layout.displacement(node, 0)) - force).norm() <= rounding);
      for (Index k = 0; k < fields; ++k) {
        const double flow = share * loads.time_increment * loads.flux[k] * point.area;
        BOOST_TEST(std::abs(residual[contact.layout.scalar(node, k)] - flow) <= rounding);
      }
    }
  });
}

BOOST_AUTO_TEST_CASE(a_field_without_a_flux_has_no_residual_and_no_tangent) {
  for_every_pair(7, 1, [](const RandomContact& contact) {
    const PointKinematics point = contact.kinematics(contact.unknowns);
    PointLoads loads = contact.loads();
    loads.flux[1] = 0;
    const VectorXd residual = contact.residual(point, loads);
    const MatrixXd tangent = contact.tangent(point, loads);
    for (const bool side : {true, false}) {
      const std::vector<Index> rows = entries(contact.layout, side, 1);
      BOOST_TEST(VectorXd(residual(rows)).norm() == 0.0);
      BOOST_TEST(MatrixXd(tangent(rows, Eigen::all)).norm() == 0.0);
      BOOST_TEST(MatrixXd(tangent(Eigen::all, rows)).norm() == 0.0);
    }
  });
}

BOOST_AUTO_TEST_CASE(any_number_of_fields_has_an_exact_tangent) {
  std::mt19937 random(8);
  for (const Index count : {0, 1, 2, 20}) {
    const RandomContact contact(FacetType::quad8, FacetType::tri6, count, random);
    const MatrixXd approximate = differences([&](const VectorXd& q) { return contact.residual(q); }, contact.unknowns);
    BOOST_TEST(relative_error(approximate, contact.tangent(contact.unknowns)) <= difference_tolerance);
  }
}
