/// Iterations of bonds that soften reach a solution, wherever the softening leads.
#include "contact/tie/bond_iterations.h"
#include "contact/tie/damage.h"

#include "tied_scene.h"

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace test;

namespace {

const Cohesive law{{{0.01, 0.01}, 2}, {0.002, 0.002}};
constexpr double onset = 0.005;  // strength over the penalty of the scene
constexpr double failure = 0.4;  // 2 energy/strength
constexpr double softening = 0.01 / (failure - onset);
constexpr double tolerance = 1e-10;  // of tractions
constexpr int most_iterations = 60;

/// The stiffness that iterations use for a bond with this opening and traction.
double stiffness(double opening, double traction, const Softening& used) {
  if (opening <= onset) return 2;
  if (opening >= failure) return 0;
  const double start = used.without == Constant::damage ? traction / opening : 0;
  return start - used.part * (start + softening);
}

/// Bonds that springs draw apart, all by the same opening.
struct Drawn {
  TiedScene tied{FacetType::quad4, FacetType::quad4, 0, Enforcement::penalty, {1, 1}, law};
  Eigen::RowVectorXd start = tied.scene.fields[Side::secondary].position.row(2);
  double spring = 0;
  double drawn = 0;  ///< of the other ends of the springs

  double traction(double opening) {
    tied.scene.fields[Side::secondary].position.row(2) = start.array() + opening;
    return tied.tie->loads(tied.scene.fields).traction(2, 0);
  }

  /// The opening at which iterations end; NaN if they do not.
  double solution() {
    BondIterations iterations;
    double opening = 0;
    for (int n = 0; n < most_iterations; ++n) {
      const double borne = traction(opening);
      const double missing = spring * (drawn - opening) - borne;
      if (std::abs(missing) < tolerance) return opening;
      iterations.begin(*tied.tie, tied.scene.fields);
      opening += missing / (spring + stiffness(opening, borne, iterations.softening()));
    }
    return std::nan("");
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(iterations_reach_the_solution_of_springs_that_are_stiffer_than_bonds_soften) {
  for (const double stiffness : {4.0, 1.2, 1.001}) {
    Drawn scene;
    scene.spring = stiffness * softening;
    const double opening = 0.5 * (onset + failure);
    scene.drawn = opening + 0.005 / scene.spring;
    BOOST_TEST(scene.solution() == opening, boost::test_tools::tolerance(1e-3));
  }
}

BOOST_AUTO_TEST_CASE(iterations_break_bonds_that_soften_more_than_springs_are_stiff) {
  for (const double stiffness : {0.999, 0.8, 0.1}) {
    Drawn scene;
    scene.spring = stiffness * softening;
    // Beyond the largest load that a solution has: bonds that begin to soften bear less than the springs draw.
    scene.drawn = onset + 1.01 * 0.01 / scene.spring;
    BOOST_TEST(scene.solution() == scene.drawn, boost::test_tools::tolerance(1e-9));
  }
}

namespace {

/// Bonds on the left and on the right of a body that springs draw apart, and that other springs keep from turning.
struct Turning {
  TiedScene tied{FacetType::quad4, FacetType::quad4, 0, Enforcement::penalty, {1, 1}, law};
  Matrix3Xd start = tied.scene.fields[Side::secondary].position;
  double middle = start.row(0).mean();

  /// The tractions of the bonds on the left and on the right.
  Eigen::Vector2d tractions(const Eigen::Vector2d& openings) {
    Matrix3Xd& place = tied.scene.fields[Side::secondary].position;
    // A nodal average has two thirds of the opening at the node itself and one third of that on the other side.
    for (Index n = 0; n < start.cols(); ++n) {
      const Index side = start(0, n) > middle ? 1 : 0;
      place(2, n) = start(2, n) + 2 * openings[side] - openings[1 - side];
    }
    const TieLoads loads = tied.tie->loads(tied.scene.fields);
    Eigen::Vector2d found;
    for (Index n = 0; n < tied.tie->nodes().count(); ++n) {
      const int node = tied.tie->nodes()[n].node;
      found[tied.scene.fields[Side::primary].position(0, node) > middle ? 1 : 0] = loads.traction(2, n);
    }
    return found;
  }

  /// The openings at which iterations end.
  Eigen::Vector2d solution(const Eigen::Matrix2d& springs, const Eigen::Vector2d& drawn) {
    BondIterations iterations;
    Eigen::Vector2d openings = Eigen::Vector2d::Zero();
    for (int n = 0; n < most_iterations; ++n) {
      const Eigen::Vector2d borne = tractions(openings);
      const Eigen::Vector2d missing = springs * (drawn - openings) - borne;
      if (missing.cwiseAbs().maxCoeff() < tolerance) break;
      iterations.begin(*tied.tie, tied.scene.fields);
      Eigen::Matrix2d both = springs;
      for (const Index i : {0, 1}) both(i, i) += stiffness(openings[i], borne[i], iterations.softening());
      openings += both.inverse() * missing;
    }
    return openings;
  }
};

}  // namespace

// 336 solutions that a turn of the body makes unstable, in models that deviate from symmetry by one percent.
BOOST_AUTO_TEST_CASE(iterations_leave_solutions_that_are_unstable_for_a_turn) {
  Eigen::Matrix2d mean, turn;
  mean << 0.5, 0.5, 0.5, 0.5;
  turn << 0.5, -0.5, -0.5, 0.5;
  Turning scene;
  for (int n = 0; n < 12; ++n) {
    const double against_turns = 0.1 + n * 0.87 / 11;
    for (const double against_mean : {1.5, 2.5, 4.0, 8.0}) {
      const Eigen::Matrix2d springs = softening * (against_mean * mean + against_turns * turn);
      for (int i = 1; i <= 7; ++i) {
        const double opening = 0.05 * i;
        const double drawn = opening + (failure - opening) / against_mean;
        const Eigen::Vector2d found = scene.solution(springs, {drawn * 1.01, drawn * 0.99});
        const bool one_bond_unloads_or_breaks = found.minCoeff() < onset || found.maxCoeff() > failure;
        BOOST_TEST(one_bond_unloads_or_breaks);
      }
    }
  }
}
