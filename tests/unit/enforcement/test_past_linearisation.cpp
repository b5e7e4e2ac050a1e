/// What a linearisation takes over from the last one: around nodes where nothing has changed, and nowhere else.
#include "enforcement/both_parts.h"
#include "surfaces.h"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>

using namespace test;

namespace {

/// A linearisation with its geometric part.
struct Both {
  LinearisationPoint point;
  GeometricPart geometric;

  PastLinearisation past() const { return {point, geometric}; }
};

/// Overlapping grids, and linearisations at points of them.
struct Overlap {
  explicit Overlap(const Effects& effects = effects_of(false, 0)) : scene(grids(), effects) {
    std::mt19937 random(2);
    scene.disturb(0.01, random);
    project();
  }

  static PerSide<Grid> grids() { return facing_grids(FacetType::tri3, FacetType::tri3, 0.1, cells, cells + 1); }
  void project() { contact = scene.contact(); }
  const MortarSpace& space() const { return contact->pass(0).space(); }
  FacingFields fields() const { return seen_from(Side::primary, scene.fields); }

  /// With the loads that overlap and jumps make, and all nodes in contact.
  LinearisationPoint point() const {
    LinearisationPoint point;
    point.loads = contact->pass(0).nodal_loads(fields());
    point.primary = fields().primary;
    point.secondary = fields().secondary;
    point.geometric_traction = point.loads.traction;
    point.geometric_flux = point.loads.flux;
    return point;
  }
  Both linearise(LinearisationPoint point, std::optional<PastLinearisation> past = std::nullopt) const {
    GeometricPart geometric = linearise_both_parts(point, space(), fields(), std::move(past));
    return {std::move(point), std::move(geometric)};
  }
  NodeFlags changed(const Both& past, const LinearisationPoint& next) const {
    return changed_nodes(past.past(), next, LinearisationSource(next, space()), space().facing().primary().facets);
  }

  static constexpr int cells = 4;
  Scene scene;
  std::unique_ptr<ContactInterface> contact;
};

Index count(const NodeFlags& nodes) { return std::count(nodes.begin(), nodes.end(), true); }

/// A node amid the primary surface.
constexpr Index inner = (Overlap::cells + 1) * (Overlap::cells / 2) + Overlap::cells / 2;

bool are_equal(const TangentBlock& one, const TangentBlock& other) {
  return one.rows.primary == other.rows.primary && one.rows.secondary == other.rows.secondary &&
         one.columns.primary == other.columns.primary && one.columns.secondary == other.columns.secondary &&
         one.values == other.values;
}

bool are_equal(const NodeRows& one, const NodeRows& other) {
  return std::equal(one.begin(), one.end(), other.begin(), other.end(),
                    [](const TangentBlock& a, const TangentBlock& b) { return are_equal(a, b); });
}

bool are_equal(const std::optional<GeometricTangent>& one, const std::optional<GeometricTangent>& other) {
  if (!one || !other) return one.has_value() == other.has_value();
  return are_equal(one->traction, other->traction) && are_equal(NodeRows(one->fluxes), NodeRows(other->fluxes));
}

/// Whether all entries of two linearisations are equal to the digit.
bool are_equal(const Both& one, const Both& other) {
  bool all = one.geometric.pairs.size() == other.geometric.pairs.size() &&
             are_equal(one.geometric.tractions, other.geometric.tractions);
  for (Index pair = 0; all && pair < one.geometric.pairs.count(); ++pair)
    all = are_equal(one.geometric.pairs[pair], other.geometric.pairs[pair]);
  for (Index field = 0; all && field < one.geometric.fluxes.count(); ++field)
    all = are_equal(one.geometric.fluxes[field], other.geometric.fluxes[field]);
  for (Index node = 0; all && node < one.point.nodes.count(); ++node) {
    const NodeLinearisation& first = one.point.nodes[node];
    const NodeLinearisation& second = other.point.nodes[node];
    all = first.patch.primary == second.patch.primary && first.gap_variation == second.gap_variation &&
          first.traction_work == second.traction_work && first.jumps.size() == second.jumps.size();
    for (Index k = 0; all && k < first.jumps.count(); ++k)
      all = first.jumps[k].weights == second.jumps[k].weights &&
            first.jumps[k].projection_variation == second.jumps[k].projection_variation;
  }
  return all;
}

/// What differs between two linearisations, as a part of the first one's largest entry.
double largest_difference(const Both& one, const Both& other) {
  double largest = 0;
  for (Index node = 0; node < one.point.nodes.count(); ++node) {
    const VectorXd& first = one.point.nodes[node].gap_variation;
    largest = std::max(
        largest, (other.point.nodes[node].gap_variation - first).cwiseAbs().maxCoeff() / first.cwiseAbs().maxCoeff());
  }
  return largest;
}

/// Size of a facet, as tributary areas tell it.
double facet_size(const LinearisationPoint& point) { return std::sqrt(point.loads.area.minCoeff()); }

}  // namespace

BOOST_AUTO_TEST_CASE(where_nothing_has_changed_everything_is_taken_over) {
  for (const Effects& effects : {effects_of(false, 0), effects_of(true, 1)}) {
    const Overlap overlap(effects);
    const LinearisationPoint point = overlap.point();
    BOOST_TEST(count(point.loads.in_contact) == point.loads.in_contact.count());
    const Both anew = overlap.linearise(point);
    BOOST_TEST(count(overlap.changed(anew, point)) == 0);
    BOOST_TEST(are_equal(overlap.linearise(point, anew.past()), anew));
  }
}

BOOST_AUTO_TEST_CASE(entries_that_are_taken_over_are_not_made_again) {
  const Overlap overlap;
  const LinearisationPoint point = overlap.point();
  PastLinearisation past = overlap.linearise(point).past();
  for (NodeLinearisation& node : past.point.nodes) node.gap_variation.setConstant(3);
  past.geometric.tractions.front().values.setConstant(4);
  const Both next = overlap.linearise(point, std::move(past));
  for (const NodeLinearisation& node : next.point.nodes) BOOST_TEST(node.gap_variation.isConstant(3, 0));
  BOOST_TEST(next.geometric.tractions.front().values.isConstant(4, 0));
}

BOOST_AUTO_TEST_CASE(a_node_that_opens_or_closes_is_linearised_as_if_anew) {
  for (const Effects& effects : {effects_of(false, 0), effects_of(true, 1)}) {
    const Overlap overlap(effects);
    const LinearisationPoint closed = overlap.point();
    LinearisationPoint open = closed;
    open.loads.in_contact[inner] = open.loads.flux_coupled[inner] = false;
    open.geometric_traction[inner] = 0;
    open.geometric_flux.col(inner).setZero();
    const Both with = overlap.linearise(closed);
    const Both without = overlap.linearise(open);
    BOOST_TEST(!are_equal(with, without));
    BOOST_TEST(count(overlap.changed(with, open)) == 1);
    BOOST_TEST(are_equal(overlap.linearise(open, with.past()), without));
    BOOST_TEST(are_equal(overlap.linearise(closed, without.past()), with));
  }
}

BOOST_AUTO_TEST_CASE(where_all_around_a_pair_have_opened_it_has_no_part) {
  const Overlap overlap;
  const LinearisationPoint closed = overlap.point();
  LinearisationPoint open = closed;
  open.loads.in_contact.fill(open.loads.in_contact.count(), false);
  open.loads.in_contact[inner] = true;
  open.geometric_traction = VectorXd::Zero(open.geometric_traction.size());
  open.geometric_traction[inner] = closed.geometric_traction[inner];
  const Both with = overlap.linearise(closed);
  BOOST_TEST(are_equal(overlap.linearise(open, with.past()), overlap.linearise(open)));
}

BOOST_AUTO_TEST_CASE(a_node_with_another_load_has_another_geometric_part) {
  const Overlap overlap;
  const LinearisationPoint before = overlap.point();
  LinearisationPoint after = before;
  const double largest = before.geometric_traction.cwiseAbs().maxCoeff();
  after.geometric_traction[inner] += 1.01 * same_to_linearisation * largest;
  const Both past = overlap.linearise(before);
  BOOST_TEST(count(overlap.changed(past, after)) == 1);
  BOOST_TEST(are_equal(overlap.linearise(after, past.past()), overlap.linearise(after)));
  after.geometric_traction[inner] = before.geometric_traction[inner] + 0.99 * same_to_linearisation * largest;
  BOOST_TEST(count(overlap.changed(past, after)) == 0);
}

BOOST_AUTO_TEST_CASE(a_linearisation_serves_while_the_surfaces_have_moved_by_next_to_nothing) {
  Overlap overlap;
  const Both past = overlap.linearise(overlap.point());
  const double little = same_to_linearisation * facet_size(past.point);
  overlap.scene.fields[Side::secondary].position(2, 0) += 0.9 * little;
  overlap.project();
  BOOST_TEST(count(overlap.changed(past, overlap.point())) == 0);
  const Both served = overlap.linearise(overlap.point(), past.past());
  const Both anew = overlap.linearise(overlap.point());
  BOOST_TEST(!are_equal(served, anew));
  // A gap varies with positions as its normal turns and its point wanders: by a few times what they moved by, as a part
  // of a facet's size.
  BOOST_TEST(largest_difference(anew, served) < 10 * same_to_linearisation);
  overlap.scene.fields[Side::secondary].position(2, 0) += 9 * little;
  overlap.project();
  const LinearisationPoint far = overlap.point();
  BOOST_TEST(count(overlap.changed(past, far)) == far.loads.in_contact.count());
  BOOST_TEST(are_equal(overlap.linearise(far, past.past()), overlap.linearise(far)));
}

BOOST_AUTO_TEST_CASE(many_small_motions_add_up) {
  Overlap overlap;
  Both last = overlap.linearise(overlap.point());
  const double little = same_to_linearisation * facet_size(last.point);
  const auto move_and_count = [&] {
    overlap.scene.fields[Side::secondary].position(2, 0) += 0.6 * little;
    overlap.project();
    const Index changed = count(overlap.changed(last, overlap.point()));
    last = overlap.linearise(overlap.point(), last.past());
    return changed;
  };
  BOOST_TEST(move_and_count() == 0);
  BOOST_TEST(move_and_count() > 0);
}

BOOST_AUTO_TEST_CASE(another_field_or_other_points_have_all_linearised_anew) {
  Overlap overlap(effects_of(true, 1));
  const Both past = overlap.linearise(overlap.point());
  const Index all = overlap.point().loads.in_contact.count();
  const double value = overlap.scene.fields[Side::secondary].scalar(0, 1);
  overlap.scene.fields[Side::secondary].scalar(0, 1) = value + 0.01;
  overlap.project();
  BOOST_TEST(count(overlap.changed(past, overlap.point())) == all);
  overlap.scene.fields[Side::secondary].scalar(0, 1) = value;
  overlap.scene.settings.integration = Integration::gauss;
  overlap.project();
  BOOST_TEST(count(overlap.changed(past, overlap.point())) == all);
}

BOOST_AUTO_TEST_CASE(what_is_no_number_is_another_state) {
  const Overlap overlap;
  const LinearisationPoint point = overlap.point();
  const Both past = overlap.linearise(point);
  LinearisationPoint broken = point;
  broken.secondary.position(0, 0) = std::numeric_limits<double>::quiet_NaN();
  BOOST_TEST(count(overlap.changed(past, broken)) == point.loads.in_contact.count());
}
