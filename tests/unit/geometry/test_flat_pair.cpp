/// Tests of flat pairs with moments: they equal sums over points, and their derivatives equal differences.
#include "contact/geometry/flat_pair.h"

#include "random_contact.h"

#include <boost/test/unit_test.hpp>

using namespace test;

namespace {

constexpr int samples = 10;
constexpr Index field = 0;

/// Two triangles with points between them, loads at the primary nodes, and one field.
struct FlatContact {
  explicit FlatContact(std::mt19937& random) : contact(FacetType::tri3, FacetType::tri3, 1, random) {
    constexpr int count = 4;
    for (int q = 0; q < count; ++q) {
      places.push_back(contact.xi + 0.2 * (random_inside(FacetType::tri3, random) - Vector2d(1, 1) / 3));
      weights.push_back(0.1 + 0.1 * q);
    }
    traction = random_vector(1, random);
    flux = random_vector(1, random);
  }

  PointKinematics point(std::size_t number, const VectorXd& unknowns) const {
    RandomContact there = contact;
    there.xi = places[number];
    return there.kinematics(unknowns);
  }
  /// The loads at a point, interpolated from constant loads at the primary nodes.
  PointLoads loads(std::size_t number) const {
    const Vector3d psi = area_coordinates(places[number]);
    PointLoads here;
    here.traction = psi.dot(traction);
    here.flux.resize(1);
    here.flux[field] = psi.dot(flux);
    here.flux_slope.setZero(1, 2);
    here.weight = weights[number];
    here.time_increment = 1;
    return here;
  }
  template <class Use>
  void for_each_point(const VectorXd& unknowns, const Use& use) const {
    for (std::size_t q = 0; q < places.size(); ++q) use(q, point(q, unknowns));
  }

  FlatPair flat(const VectorXd& unknowns) const {
    FlatMoments moments;
    for (std::size_t q = 0; q < places.size(); ++q) {
      RandomContact there = contact;
      there.xi = places[q];
      moments.add(weights[q], places[q], there.projection(unknowns).eta);
    }
    return flat_pair(moments, contact.coordinates(unknowns, true), contact.coordinates(unknowns, false));
  }
  FlatPair flat() const { return flat(contact.unknowns); }
  FlatVariations variations() const {
    const VectorXd& q = contact.unknowns;
    return flat_variations(flat(), contact.coordinates(q, true), contact.coordinates(q, false));
  }
  FlatNodes values() const { return contact.fields(contact.unknowns).col(field); }

  /// The entries of the unknowns that are displacements.
  std::vector<Index> displacements() const {
    std::vector<Index> result;
    for (Index node = 0; node < contact.layout.nodes(); ++node) {
      for (Index i = 0; i < 3; ++i) result.push_back(contact.layout.displacement(node, i));
    }
    return result;
  }
  std::vector<Index> scalars() const {
    std::vector<Index> result;
    for (Index node = 0; node < contact.layout.nodes(); ++node) result.push_back(contact.layout.scalar(node, field));
    return result;
  }
  /// Differences with respect to displacements only, with a new projection of each point.
  MatrixXd differences_of(const std::function<VectorXd(const VectorXd&)>& function) const {
    const MatrixXd all = differences(function, contact.unknowns);
    return all(Eigen::all, displacements());
  }

  RandomContact contact;
  std::vector<Vector2d> places;
  std::vector<double> weights;
  Vector3d traction;
  Vector3d flux;
};

template <class Check>
void for_random_pairs(unsigned seed, const Check& check) {
  std::mt19937 random(seed);
  for (int sample = 0; sample < samples; ++sample) check(FlatContact(random));
}

/// The residual summed over all points, in the order of the unknowns.
VectorXd residual_of_points(const FlatContact& pair, const VectorXd& unknowns) {
  VectorXd sum = VectorXd::Zero(unknowns.size());
  pair.for_each_point(unknowns, [&](std::size_t q, const PointKinematics& point) {
    add_residual(point, pair.loads(q), pair.contact.layout, sum);
  });
  return sum;
}

/// Averages of the gap, or of a field's jump, for each primary node.
Vector3d averages(const FlatContact& pair, const VectorXd& unknowns, bool of_gap) {
  Vector3d sums = Vector3d::Zero();
  Vector3d areas = Vector3d::Zero();
  pair.for_each_point(unknowns, [&](std::size_t q, const PointKinematics& point) {
    const Vector3d share = pair.weights[q] * point.area * area_coordinates(pair.places[q]);
    sums += (of_gap ? point.gap : point.jump_weights().dot(pair.values())) * share;
    areas += share;
  });
  return sums.cwiseQuotient(areas);
}

void check_close(const MatrixXd& value, const MatrixXd& reference, double tolerance) {
  BOOST_TEST(reference.norm() > 0);
  BOOST_TEST(relative_error(value, reference) <= tolerance);
}

}  // namespace

BOOST_AUTO_TEST_CASE(moments_tell_what_points_sum_up_to) {
  for_random_pairs(1, [](const FlatContact& pair) {
    const FlatPair flat = pair.flat();
    Vector3d weight = Vector3d::Zero();
    Vector3d gap = Vector3d::Zero();
    Vector3d jump = Vector3d::Zero();
    MatrixXd jump_weights = MatrixXd::Zero(6, 3);
    pair.for_each_point(pair.contact.unknowns, [&](std::size_t q, const PointKinematics& point) {
      const Vector3d share = pair.weights[q] * area_coordinates(pair.places[q]);
      const PairVector h = point.jump_weights();
      weight += share;
      gap += point.gap * share;
      jump += h.dot(pair.values()) * share;
      jump_weights += h * share.transpose();
      check_close(flat.area_vector, point.area_vector, rounding);
      check_close(flat.normal, point.normal, rounding);
    });
    check_close(flat.weight(), weight, rounding);
    check_close(flat.gap, gap, rounding);
    check_close(flat.jump(pair.values()), jump, rounding);
    for (Index c = 0; c < 3; ++c) check_close(flat.jump_weights(c), jump_weights.col(c), rounding);
  });
}

BOOST_AUTO_TEST_CASE(forces_and_flows_are_those_of_the_points) {
  for_random_pairs(2, [](const FlatContact& pair) {
    const VectorXd points = residual_of_points(pair, pair.contact.unknowns);
    check_close(traction_residual(pair.flat(), pair.traction), points(pair.displacements()), rounding);
    check_close(flux_residual(pair.flat(), pair.flux), points(pair.scalars()), rounding);
  });
}

BOOST_AUTO_TEST_CASE(works_of_the_nodes_add_up_to_the_forces) {
  for_random_pairs(3, [](const FlatContact& pair) {
    FlatVariation sum = FlatVariation::Zero();
    for (Index c = 0; c < 3; ++c) sum += pair.traction[c] * traction_work(pair.flat(), c);
    check_close(sum, traction_residual(pair.flat(), pair.traction), rounding);
  });
}

BOOST_AUTO_TEST_CASE(tangents_are_those_of_the_points) {
  for_random_pairs(4, [](const FlatContact& pair) {
    MatrixXd traction = MatrixXd::Zero(18, 18);
    MatrixXd flux = MatrixXd::Zero(6, 24);
    const LocalLayout layout(3, 3, 1);
    pair.for_each_point(pair.contact.unknowns, [&](std::size_t q, const PointKinematics& point) {
      const KinematicVariations vary = kinematic_variations(point);
      add_traction_tangent(point, vary, normal_force(point, vary, pair.loads(q)), traction);
      add_flux_tangent(point, vary, pair.loads(q), field, layout, flux);
    });
    const MatrixXd by_displacements = flux(Eigen::all, pair.displacements());
    check_close(traction_tangent(flat_forces(pair.flat(), pair.variations(), pair.traction)), traction, rounding);
    check_close(flux_tangent(flat_flows(pair.flat(), pair.variations(), pair.flux)), by_displacements, rounding);
  });
}

BOOST_AUTO_TEST_CASE(tangents_match_differences) {
  for_random_pairs(5, [](const FlatContact& pair) {
    const MatrixXd all = pair.differences_of([&](const VectorXd& q) { return residual_of_points(pair, q); });
    const MatrixXd forces = all(pair.displacements(), Eigen::all);
    const MatrixXd flows = all(pair.scalars(), Eigen::all);
    check_close(traction_tangent(flat_forces(pair.flat(), pair.variations(), pair.traction)), forces,
                difference_tolerance);
    check_close(flux_tangent(flat_flows(pair.flat(), pair.variations(), pair.flux)), flows, difference_tolerance);
  });
}

BOOST_AUTO_TEST_CASE(variations_of_averages_match_differences) {
  for_random_pairs(6, [](const FlatContact& pair) {
    const FlatPair flat = pair.flat();
    const Vector3d areas = flat.area * flat.weight();
    const VectorXd& x = pair.contact.unknowns;
    for (const bool of_gap : {true, false}) {
      const Vector3d mean = averages(pair, x, of_gap);
      const MatrixXd all = pair.differences_of([&](const VectorXd& q) { return averages(pair, q, of_gap); });
      for (Index c = 0; c < 3; ++c) {
        const FlatVariation exact = of_gap ? mean_gap_variation(flat, pair.variations(), c, mean[c], areas[c])
                                           : mean_jump_variation(flat, pair.variations(), c, pair.values(), mean[c],
                                                                 areas[c]);
        check_close(exact.transpose(), all.row(c), difference_tolerance);
      }
    }
  });
}

BOOST_AUTO_TEST_CASE(nodes_that_give_their_functions_away_have_no_part) {
  for_random_pairs(7, [](const FlatContact& pair) {
    const FlatMoments moments = pair.flat().moments;
    Eigen::Matrix3d heirs;
    heirs << 1, 0, 0.5, 0, 1, 0.5, 0, 0, 0;  // the last node gives its function to the others
    const FlatMoments given = moments.redistributed(heirs);
    BOOST_TEST(given.primary.row(2).norm() == 0.0);
    BOOST_TEST(given.secondary.row(2).norm() == 0.0);
    check_close(given.primary.row(0), moments.primary.row(0) + 0.5 * moments.primary.row(2), rounding);
    check_close(given.secondary.colwise().sum(), moments.secondary.colwise().sum(), rounding);
  });
}
