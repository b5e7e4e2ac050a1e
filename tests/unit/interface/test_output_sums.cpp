/// Tests of sums for output: moments of flat pairs give the same sums as points.
#include "contact/interface/output_sums.h"

#include "contact/interface/output.h"

#include "surfaces.h"

#include <boost/test/unit_test.hpp>

using namespace test;

namespace {

/// A flat scene that exchanges the solvent and a solute, with random loads at all primary nodes.
struct LoadedScene : Scene {
  LoadedScene()
      : Scene(flat_scene(effects_of(true, 1))), space(mesh[Side::primary], mesh[Side::secondary], effects, settings) {
    space.change_facing().search({fields[Side::primary].position, fields[Side::secondary].position}, 1);
    std::mt19937 random(5);
    loads.in_contact = NodeFlags(space.nodes(), true);
    loads.traction = random_values(space.nodes(), -2, -1, random);
    loads.flux.resize(effects.scalar_fields(), space.nodes());
    for (Index k = 0; k < loads.flux.rows(); ++k) loads.flux.row(k) = random_values(space.nodes(), -1, 1, random);
  }

  FacingFields facing() const { return seen_from(Side::primary, fields); }

  /// The sums over all points.
  OutputSums sums_of_points() const {
    OutputSums sums;
    sums.set_zero(rows.count(), space.nodes(), mesh[Side::secondary].nodes);
    for (const FacetPair& pair : space.facing().pairs()) {
      for (const IntegrationPoint& place : space.facing().points(pair)) add(pair, place, sums);
    }
    return sums;
  }

  MortarSpace space;
  NodalLoads loads;
  OutputRows rows{effects.scalar_fields()};

 private:
  void add(const FacetPair& pair, const IntegrationPoint& place, OutputSums& sums) const {
    const Facet& one = space.facing().primary_facet(pair);
    const Facet& two = space.facing().secondary_facet(pair);
    const PointKinematics point = point_kinematics(
        shape_functions(one.type, place.xi), facet_coordinates(one, facing().primary.position),
        shape_functions(two.type, place.eta), facet_coordinates(two, facing().secondary.position));
    const FacetVector psi = space.shape(pair.primary, place.sub_facet, place.xi).value;
    const double traction = psi.dot(facet_values(one, loads.traction));
    VectorXd values = VectorXd::Zero(rows.count());
    values.head<3>() << 1, point.gap, -traction;  // area, gap, pressure
    for (int k = 0; k < effects.scalar_fields(); ++k) {
      values[rows.flux() + k] = psi.dot(facet_values(one, loads.flux.row(k).transpose()));
      values[rows.jump() + k] = point.jump_weights().dot(space.facing().values(pair, k, facing()));
    }
    const double area = place.weight * point.area;
    for (Index a = 0; a < one.count(); ++a) sums.integrated.col(one.node(a)) += area * point.primary_shape[a] * values;
    for (Index a = 0; a < two.count(); ++a) sums.facing.col(two.node(a)) += area * point.secondary_shape[a] * values;
    sums.force += place.weight * traction * point.area_vector;
  }
};

/// Checks that rows are equal up to the rounding of their largest entry.
template <class Values>
void check_equal(const Values& sums, const Values& expected) {
  for (Index row = 0; row < expected.rows(); ++row)
    BOOST_TEST((sums.row(row) - expected.row(row)).cwiseAbs().maxCoeff() <=
               rounding * expected.row(row).cwiseAbs().maxCoeff());
}

}  // namespace

BOOST_AUTO_TEST_CASE(flat_pairs_put_out_what_their_points_would) {
  for (const bool redistributes : {false, true}) {
    LoadedScene scene;
    if (redistributes) {
      FacetGapSums covered = FacetGapSums::Zero(2, 3);
      covered.row(0) << 1, 1, 0.1;  // the covered part is too small for the last node to carry load
      scene.space.boundary_weights().decide(0, covered, FacetVector::Ones(3));
    }
    BOOST_TEST(scene.space.boundary_weights().heirs(0, FacetType::tri3).has_value() == redistributes);
    for (const FacetPair& pair : scene.space.facing().pairs()) BOOST_TEST(scene.space.facing().flat(pair) != nullptr);

    const FacingFields fields = scene.facing();
    const OutputSums sums = sums_of(scene.space, scene.loads, scene.rows, fields);
    const OutputSums expected = scene.sums_of_points();
    check_equal(sums.integrated, expected.integrated);
    check_equal(sums.facing, expected.facing);
    BOOST_TEST((sums.force - expected.force).norm() <= rounding * expected.force.norm());
  }
}

BOOST_AUTO_TEST_CASE(without_output_the_coefficients_of_friction_are_zero) {
  const NodalOutput none;
  BOOST_TEST(none.effective_friction(3) == 0);
  BOOST_TEST(none.fluid_load_support(3) == 0);
}
