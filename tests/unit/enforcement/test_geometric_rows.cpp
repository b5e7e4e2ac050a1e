/// The geometric part of the tangent by nodes: what pairs of facets have, but for weak couplings.
#include "enforcement/geometric_rows.h"

#include "surfaces.h"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <limits>

using namespace test;

namespace {

/// Overlapping surfaces and what their pairs of facets have, with the loads that overlap and jumps make.
struct Overlap {
  explicit Overlap(const Effects& effects, FacetType type = FacetType::tri3)
      : scene(facing_grids(type, FacetType::tri3, 0.2, 3, 2), effects) {
    std::mt19937 random(1);
    scene.disturb(0.03, random);
    contact = scene.contact();
    const MortarSpace& space = contact->pass(0).space();
    const NodalLoads loads = contact->pass(0).nodal_loads(fields());
    pairs = GeometricParts(facing().pairs().count());
    for (Index pair = 0; pair < pairs.count(); ++pair) {
      const FacetPair& facets = facing().pairs()[pair];
      if (facing().has_node_among(facets, loads.in_contact))
        pairs[pair] = geometric_tangent(space, facets, varying_points(space, facets, loads, fields(), 1));
    }
  }

  FacingFields fields() const { return seen_from(Side::primary, scene.fields); }
  const FacingPairs& facing() const { return contact->pass(0).space().facing(); }
  NodeRows rows(double weak) const { return traction_rows(facing(), pairs, positions(fields()), weak); }

  MatrixXd zero() const {
    const Index size = GlobalLayout(scene).size();
    return MatrixXd::Zero(size, size);
  }
  void add(const TangentBlock& block, MatrixXd& sum) const {
    const GlobalLayout layout(scene);
    sum(layout.entries({Side::primary, block.rows}), layout.entries({Side::primary, block.columns})) += block.values;
  }
  MatrixXd sum(const NodeRows& rows) const {
    MatrixXd sum = zero();
    for (const TangentBlock& row : rows) add(row, sum);
    return sum;
  }
  MatrixXd sum_of_pairs() const {
    MatrixXd sum = zero();
    for (const auto& pair : pairs) {
      if (pair) add(pair->traction, sum);
    }
    return sum;
  }
  /// The stiffest body around any node [N/mm].
  double stiffest() const {
    double most = 0;
    for (const Side side : both_sides) {
      const SurfaceMesh& mesh = scene.mesh[side];
      for (Index f = 0; f < mesh.facets.count(); ++f)
        most = std::max(most, mesh.stiffness[f] * areas_of_nodes(mesh.facets[f], scene.fields[side].position).sum());
    }
    return most;
  }
  /// Makes the bodies behind the surfaces so many times as stiff as they are in the scene.
  void stiffen(double primary, double secondary) {
    const SurfaceMesh& one = scene.mesh[Side::primary];
    const SurfaceMesh& two = scene.mesh[Side::secondary];
    contact->update_properties({{primary * one.stiffness, secondary * two.stiffness}},
                               {{one.conductance, two.conductance}});
  }

  Scene scene;
  std::unique_ptr<ContactInterface> contact;
  GeometricParts pairs;
};

/// Rounding of sums of a few dozen terms that cancel, against the largest of them.
double rounding_of(const MatrixXd& values) {
  return 100 * std::numeric_limits<double>::epsilon() * values.cwiseAbs().maxCoeff();
}

/// Larger than any coupling.
constexpr double everything = 1e9;

/// The displacement of one surface as a whole along an axis.
VectorXd moved(const Scene& scene, Side side, Index axis) {
  const GlobalLayout layout(scene);
  VectorXd displacement = VectorXd::Zero(layout.size());
  for (int node = 0; node < scene.mesh[side].nodes; ++node) displacement[layout.entry(side, node, axis)] = 1;
  return displacement;
}

Index couplings(const NodeRows& rows) {
  Index sum = 0;
  for (const TangentBlock& row : rows) sum += row.columns.layout().nodes();
  return sum;
}

}  // namespace

BOOST_AUTO_TEST_CASE(rows_with_all_couplings_are_the_sum_of_pairs) {
  for (const FacetType type : {FacetType::tri3, FacetType::quad4, FacetType::tri6}) {
    const Overlap overlap(effects_of(false, 0), type);
    const MatrixXd pairs = overlap.sum_of_pairs();
    BOOST_TEST(pairs.norm() > 0);
    BOOST_TEST((overlap.sum(overlap.rows(0)) - pairs).cwiseAbs().maxCoeff() <= rounding_of(pairs));
  }
}

BOOST_AUTO_TEST_CASE(rows_of_a_flux_are_the_sum_of_pairs) {
  const Overlap overlap(effects_of(true, 1));
  for (int field = 0; field < 2; ++field) {
    MatrixXd pairs = overlap.zero();
    for (const auto& pair : overlap.pairs) {
      if (pair) overlap.add(mixture_contact::at(pair->fluxes, field), pairs);
    }
    BOOST_TEST(pairs.norm() > 0);
    const MatrixXd rows = overlap.sum(flux_rows(overlap.facing(), overlap.pairs, positions(overlap.fields()), field));
    BOOST_TEST((rows - pairs).cwiseAbs().maxCoeff() <= rounding_of(pairs));
  }
}

BOOST_AUTO_TEST_CASE(a_field_that_no_pair_exchanges_has_no_rows) {
  const Overlap overlap(effects_of(false, 0));
  BOOST_TEST(flux_rows(overlap.facing(), overlap.pairs, positions(overlap.fields()), 0).empty());
}

BOOST_AUTO_TEST_CASE(bodies_displaced_as_a_whole_have_the_same_forces_without_weak_couplings) {
  const Overlap overlap(effects_of(false, 0));
  const MatrixXd all = overlap.sum(overlap.rows(0));
  const MatrixXd strong = overlap.sum(overlap.rows(everything));
  BOOST_TEST((strong - all).norm() > 0);
  for (const Side side : both_sides) {
    for (Index axis = 0; axis < 3; ++axis) {
      const VectorXd displacement = moved(overlap.scene, side, axis);
      BOOST_TEST((strong * displacement - all * displacement).cwiseAbs().maxCoeff() <= rounding_of(all));
    }
  }
}

BOOST_AUTO_TEST_CASE(what_is_coupled_is_so_both_ways_and_what_is_not_is_weak) {
  const Overlap overlap(effects_of(false, 0));
  const GlobalLayout layout(overlap.scene);
  const MatrixXd all = overlap.sum(overlap.rows(0));
  const double weak = 0.1 * all.cwiseAbs().maxCoeff() / overlap.stiffest();
  MatrixXd coupled = overlap.zero();
  for (TangentBlock row : overlap.rows(weak)) {
    row.values.setOnes();
    overlap.add(row, coupled);
  }
  BOOST_TEST((coupled == coupled.transpose()));
  const MatrixXd left_out = (coupled.array() == 0).select(all, 0);
  BOOST_TEST(left_out.norm() > 0);
  BOOST_TEST(left_out.cwiseAbs().maxCoeff() <= weak * overlap.stiffest());
  BOOST_TEST(couplings(overlap.rows(0)) > couplings(overlap.rows(weak)));
}

BOOST_AUTO_TEST_CASE(every_node_keeps_its_strongest_coupling_with_the_other_surface) {
  const Overlap overlap(effects_of(false, 0));
  for (const TangentBlock& row : overlap.rows(everything)) {
    BOOST_TEST(!row.columns.primary.empty());
    BOOST_TEST(!row.columns.secondary.empty());
  }
}

BOOST_AUTO_TEST_CASE(rigid_bodies_keep_all_couplings) {
  Overlap overlap(effects_of(false, 0));
  const Index all = couplings(overlap.rows(0));
  BOOST_TEST(couplings(overlap.rows(everything)) < all);
  overlap.stiffen(1, std::numeric_limits<double>::infinity());
  BOOST_TEST(couplings(overlap.rows(everything)) == all);
}

BOOST_AUTO_TEST_CASE(couplings_are_weak_beside_the_softer_body) {
  Overlap overlap(effects_of(false, 0));
  const double weak = 0.1 * overlap.sum(overlap.rows(0)).cwiseAbs().maxCoeff() / overlap.stiffest();
  overlap.stiffen(1, 1e3);
  const Index found = couplings(overlap.rows(weak));
  overlap.stiffen(1, 1e6);
  BOOST_TEST(couplings(overlap.rows(weak)) == found);
  overlap.stiffen(1e3, 1e6);
  BOOST_TEST(couplings(overlap.rows(weak)) < found);
}
