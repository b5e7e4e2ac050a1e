/// Tests of the geometric part of the tangent by nodes: it equals the sum of the pairs except for weak couplings.
#include "enforcement/geometric_rows.h"

#include "surfaces.h"

#include <boost/test/unit_test.hpp>

#include <limits>

using namespace test;

namespace {

/// Overlapping surfaces and the geometric tangents of their pairs, with the loads of overlaps and jumps.
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
        pairs[pair] = geometric_tangent(space, facets, varying_pair(space, facets, loads, fields(), 1));
    }
  }

  FacingFields fields() const { return seen_from(Side::primary, scene.fields); }
  const FacingPairs& facing() const { return contact->pass(0).space().facing(); }
  PerSide<Index> nodes() const { return {{scene.mesh[Side::primary].nodes, scene.mesh[Side::secondary].nodes}}; }
  NodeRows rows(double weak) const { return traction_rows(pairs, nodes(), weak); }

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
      if (pair) add(with_values(pair->traction), sum);
    }
    return sum;
  }
  Scene scene;
  std::unique_ptr<ContactInterface> contact;
  GeometricParts pairs;
};

/// Rounding error of sums of a few dozen terms that cancel, relative to the largest term.
double rounding_of(const MatrixXd& values) {
  return 100 * std::numeric_limits<double>::epsilon() * values.cwiseAbs().maxCoeff();
}

/// A limit of weak couplings that includes all couplings.
constexpr double everything = 1;

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
  for (const FacetType type : {FacetType::tri3, FacetType::quad4}) {
    const Overlap overlap(effects_of(true, 1), type);
    for (int field = 0; field < 2; ++field) {
      MatrixXd pairs = overlap.zero();
      for (const auto& pair : overlap.pairs) {
        if (pair) overlap.add(with_values(mixture_contact::at(pair->fluxes, field)), pairs);
      }
      BOOST_TEST(pairs.norm() > 0);
      const MatrixXd rows = overlap.sum(flux_rows(overlap.pairs, overlap.nodes(), field, 0));
      BOOST_TEST((rows - pairs).cwiseAbs().maxCoeff() <= rounding_of(pairs));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_field_that_no_pair_exchanges_has_no_rows) {
  const Overlap overlap(effects_of(false, 0));
  BOOST_TEST(flux_rows(overlap.pairs, overlap.nodes(), 0).empty());
}

BOOST_AUTO_TEST_CASE(what_is_left_out_is_weak_and_the_rest_stays) {
  const Overlap overlap(effects_of(false, 0));
  const MatrixXd all = overlap.sum(overlap.rows(0));
  const double weak = 0.1;
  const MatrixXd strong = overlap.sum(overlap.rows(weak));
  const MatrixXd left_out = (strong.array() == 0).select(all, 0);
  BOOST_TEST(left_out.norm() > 0);
  for (Index node = 0; 3 * node < all.rows(); ++node) {
    const auto rows = all.middleRows<3>(3 * node);
    BOOST_TEST(left_out.middleRows<3>(3 * node).cwiseAbs().maxCoeff() <= weak * rows.cwiseAbs().maxCoeff());
  }
  BOOST_TEST((strong + left_out == all));
  BOOST_TEST(couplings(overlap.rows(0)) > couplings(overlap.rows(weak)));
}

BOOST_AUTO_TEST_CASE(nodes_of_one_surface_keep_all_couplings) {
  const Overlap overlap(effects_of(false, 0));
  Index on_one_surface = 0;
  for (const TangentBlock& row : overlap.rows(0))
    on_one_surface += row.rows.primary.empty() ? row.columns.secondary.count() : row.columns.primary.count();
  BOOST_TEST(couplings(overlap.rows(everything)) == on_one_surface);
}

BOOST_AUTO_TEST_CASE(a_flat_facet_carries_the_same_load_however_it_is_cut) {
  // The forces at the nodes do not depend on the opposite nodes, because the quadrature on the pieces is exact for
  // triangles.
  const Overlap overlap(effects_of(false, 0), FacetType::tri3);
  const MatrixXd all = overlap.sum(overlap.rows(0));
  Index inner = 0;
  for (const TangentBlock& row : overlap.rows(weak_coupling)) {
    if (!row.rows.secondary.empty() || !row.columns.secondary.empty()) continue;
    ++inner;
  }
  BOOST_TEST(inner > 0);
  BOOST_TEST((overlap.sum(overlap.rows(weak_coupling)) - all).cwiseAbs().maxCoeff() <= rounding_of(all));
}
