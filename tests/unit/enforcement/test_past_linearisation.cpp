/// Tests which parts of a linearisation are reused: those around nodes where nothing has changed, and no others.
#include "enforcement/both_parts.h"
#include "surfaces.h"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>

using namespace test;

namespace {

/// Relative change up to which a linearisation is reused.
constexpr double same = 1e-3;

/// A linearisation with its geometric part.
struct Both {
  LinearisationPoint point;
  GeometricPart geometric;

  PastLinearisation past() const { return {point, geometric}; }
};

/// Overlapping grids, and linearisations of their contact.
struct Overlap {
  explicit Overlap(const Effects& effects = effects_of(false, 0)) : scene(grids(), effects) {
    std::mt19937 random(2);
    scene.disturb(disturbance, random);
    project();
  }

  static PerSide<Grid> grids() { return facing_grids(FacetType::tri3, FacetType::tri3, 0.1, cells, 2 * cells); }
  void project() { contact = scene.contact(); }
  const MortarSpace& space() const { return contact->pass(0).space(); }
  FacingFields fields() const { return seen_from(Side::primary, scene.fields); }

  /// A point with the loads of overlaps and jumps, and all nodes in contact.
  LinearisationPoint point() const {
    LinearisationPoint point;
    point.loads = contact->pass(0).nodal_loads(fields());
    point.primary = fields().primary;
    point.secondary = fields().secondary;
    point.set_geometric(point.loads);
    return point;
  }
  Both linearise(LinearisationPoint point, std::optional<PastLinearisation> past = std::nullopt) const {
    GeometricPart geometric = linearise_both_parts(point, space(), fields(), std::move(past), same);
    return {std::move(point), std::move(geometric)};
  }
  NodeFlags changed(const Both& past, const LinearisationPoint& next) const {
    return changed_nodes(past.past(), LinearisationSource(next, space()), space(), same);
  }

  static constexpr int cells = 4;
  static constexpr double disturbance = 0.01;
  Scene scene;
  std::unique_ptr<ContactInterface> contact;
};

Index count(const NodeFlags& nodes) { return std::count(nodes.begin(), nodes.end(), true); }

/// A node in the middle of the primary surface.
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
  return are_equal(with_values(one->traction), with_values(other->traction)) &&
         std::equal(
             one->fluxes.begin(), one->fluxes.end(), other->fluxes.begin(), other->fluxes.end(),
             [](const FluxTangent& a, const FluxTangent& b) { return are_equal(with_values(a), with_values(b)); });
}

/// True if all entries of two linearisations are equal to the bit.
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

/// The largest difference of two linearisations, relative to the largest entry of the first one.
double largest_difference(const Both& one, const Both& other) {
  double largest = 0;
  for (Index node = 0; node < one.point.nodes.count(); ++node) {
    const VectorXd& first = one.point.nodes[node].gap_variation;
    largest = std::max(
        largest, (other.point.nodes[node].gap_variation - first).cwiseAbs().maxCoeff() / first.cwiseAbs().maxCoeff());
  }
  return largest;
}

/// Motions just below and just above the fraction `same` of the shortest edge: that of the finer, secondary grid, minus
/// or plus the effect of the disturbance.
constexpr double edge = 1.0 / (2 * Overlap::cells);
constexpr double of_both_ends = 2 * 1.8 * Overlap::disturbance;  // sqrt(3) for three components
constexpr double little = 0.99 * same * (edge - of_both_ends);
constexpr double much = 1.01 * same * (edge + of_both_ends);

/// A contact with penalties for traction, solvent and one solute.
std::unique_ptr<ContactInterface> with_penalties(double traction, double solvent) {
  Scene scene(facing_grids(FacetType::tri3, FacetType::tri3, 0.1), effects_of(true, 1));
  scene.settings = explicit_settings(traction, solvent, 1);
  return scene.contact();
}

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
  after.geometric_traction[inner] += 1.01 * same * largest;
  const Both past = overlap.linearise(before);
  BOOST_TEST(count(overlap.changed(past, after)) == 1);
  BOOST_TEST(are_equal(overlap.linearise(after, past.past()), overlap.linearise(after)));
  after.geometric_traction[inner] = before.geometric_traction[inner] + 0.99 * same * largest;
  BOOST_TEST(count(overlap.changed(past, after)) == 0);
}

BOOST_AUTO_TEST_CASE(a_linearisation_serves_while_the_surfaces_have_moved_by_next_to_nothing) {
  for (const Side side : both_sides) {
    Overlap overlap;
    const Both past = overlap.linearise(overlap.point());
    overlap.scene.fields[side].position(2, 0) += little;
    overlap.project();
    BOOST_TEST(count(overlap.changed(past, overlap.point())) == 0);
    const Both served = overlap.linearise(overlap.point(), past.past());
    const Both anew = overlap.linearise(overlap.point());
    BOOST_TEST(!are_equal(served, anew));
    // The weights of nodes in a gap, on average 1/3, change by the motion over a facet's height edge/sqrt(2), once
    // because the point moves and once because the normal rotates: 2 sqrt(2) 3 = 8.5, and the facets are disturbed.
    BOOST_TEST(largest_difference(anew, served) < 10 * same);
    overlap.scene.fields[side].position(2, 0) += much - little;
    overlap.project();
    const LinearisationPoint far = overlap.point();
    BOOST_TEST(count(overlap.changed(past, far)) == far.loads.in_contact.count());
    BOOST_TEST(are_equal(overlap.linearise(far, past.past()), overlap.linearise(far)));
  }
}

BOOST_AUTO_TEST_CASE(motions_of_both_surfaces_add_up) {
  Overlap overlap;
  const Both past = overlap.linearise(overlap.point());
  for (const Side side : both_sides) overlap.scene.fields[side].position(2, 0) += 0.5 * much;
  overlap.project();
  BOOST_TEST(count(overlap.changed(past, overlap.point())) > 0);
}

BOOST_AUTO_TEST_CASE(many_small_motions_add_up) {
  Overlap overlap;
  Both last = overlap.linearise(overlap.point());
  const auto move_and_count = [&] {
    overlap.scene.fields[Side::secondary].position(2, 0) += 0.5 * much;
    overlap.project();
    const Index changed = count(overlap.changed(last, overlap.point()));
    last = overlap.linearise(overlap.point(), last.past());
    return changed;
  };
  BOOST_TEST(move_and_count() == 0);
  BOOST_TEST(move_and_count() > 0);
}

BOOST_AUTO_TEST_CASE(loads_are_compared_with_those_that_a_part_was_made_with) {
  const Overlap overlap;
  LinearisationPoint point = overlap.point();
  const double largest = point.geometric_traction.cwiseAbs().maxCoeff();
  Both last = overlap.linearise(point);
  for (int step = 0; step < 2; ++step) {
    point.geometric_traction[inner] += 0.6 * same * largest;
    BOOST_TEST(count(overlap.changed(last, point)) == step);
    last = overlap.linearise(point, last.past());
  }
  BOOST_TEST(are_equal(last, overlap.linearise(point)));
}

BOOST_AUTO_TEST_CASE(a_flux_alone_has_another_geometric_part) {
  const Overlap overlap(effects_of(true, 1));
  const LinearisationPoint before = overlap.point();
  LinearisationPoint after = before;
  after.geometric_flux(1, inner) += 2 * same * before.geometric_flux.row(1).cwiseAbs().maxCoeff();
  const Both past = overlap.linearise(before);
  BOOST_TEST(count(overlap.changed(past, after)) == 1);
  BOOST_TEST(are_equal(overlap.linearise(after, past.past()), overlap.linearise(after)));
}

BOOST_AUTO_TEST_CASE(nodes_of_a_facet_with_other_weights_are_linearised_anew) {
  const Overlap overlap;
  const LinearisationPoint point = overlap.point();
  PastLinearisation past = overlap.linearise(point).past();
  const IndexedVector<Facet>& facets = overlap.space().facing().primary().facets;
  past.geometric.source.carriers = LoadCarriers(facets.count(), FacetVector::Ones(3));
  past.geometric.source.carriers.front()[0] = 0;
  LinearisationSource now = past.geometric.source;
  now.carriers.front()[0] = 1;
  const NodeFlags changed = changed_nodes(past, now, overlap.space(), same);
  BOOST_TEST(count(changed) == 3);
  for (const int node : facets.front()) BOOST_TEST(changed[node]);
}

BOOST_AUTO_TEST_CASE(what_corrections_have_made_of_a_status_is_not_taken_over) {
  const Overlap overlap;
  const LinearisationPoint closed = overlap.point();
  LinearisationPoint open = closed;
  open.loads.in_contact[inner] = open.loads.flux_coupled[inner] = false;
  open.geometric_traction[inner] = 0;
  const Both without = overlap.linearise(open);
  const auto corrected = [&](const LinearisationPoint& made_at, bool is_closed) {
    PastLinearisation past = overlap.linearise(made_at).past();
    past.point.loads.in_contact[inner] = past.point.loads.flux_coupled[inner] = is_closed;
    past.point.nodes[inner] = overlap.linearise(closed).point.nodes[inner];  // of a node that was released or added
    return past;
  };
  BOOST_TEST(are_equal(overlap.linearise(open, corrected(closed, false)), without));
  BOOST_TEST(are_equal(overlap.linearise(open, corrected(open, false)), without));
  BOOST_TEST(without.point.nodes[inner].empty());
  PastLinearisation added = corrected(open, true);
  added.point.nodes[inner].gap_variation.setConstant(3);
  BOOST_TEST(are_equal(overlap.linearise(closed, std::move(added)), overlap.linearise(closed)));
}

BOOST_AUTO_TEST_CASE(stiff_penalties_have_less_taken_over) {
  BOOST_TEST(same_to_linearisation(with_penalties(1e5, 1e5)->pass(0).laws()) == 1e-3,
             boost::test_tools::tolerance(1e-12));
  // The change is limited such that eps delta^2/k is a tenth.
  BOOST_TEST(same_to_linearisation(with_penalties(1e7, 1)->pass(0).laws()) == 1e-4,
             boost::test_tools::tolerance(1e-12));
  BOOST_TEST(same_to_linearisation(with_penalties(1, 1e9)->pass(0).laws()) == 1e-5,
             boost::test_tools::tolerance(1e-12));
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

BOOST_AUTO_TEST_CASE(points_on_other_sub_facets_have_all_linearised_anew) {
  const Overlap overlap;
  const LinearisationPoint point = overlap.point();
  Both past = overlap.linearise(point);
  ++past.geometric.source.sub_facets.front();
  BOOST_TEST(count(overlap.changed(past, point)) == point.loads.in_contact.count());
}

BOOST_AUTO_TEST_CASE(what_is_no_number_is_another_state) {
  const Overlap overlap;
  const LinearisationPoint point = overlap.point();
  const Both past = overlap.linearise(point);
  LinearisationPoint broken = point;
  broken.secondary.position(0, 0) = std::numeric_limits<double>::quiet_NaN();
  BOOST_TEST(count(overlap.changed(past, broken)) == point.loads.in_contact.count());
}

/// The tangent of an iteration that begins near the previous one. `between`: actions between both iterations.
template <class Between>
MatrixXd tangent_after(const Between& between, const Effects& effects = effects_of(false, 0)) {
  Overlap overlap(effects);
  overlap.contact->begin_iteration(overlap.scene.fields);
  overlap.scene.fields[Side::secondary].position(2, 0) += little;
  overlap.contact->project(overlap.scene.position());
  between(*overlap.contact);
  overlap.contact->begin_iteration(overlap.scene.fields);
  return assembled_tangent(*overlap.contact, GlobalLayout(overlap.scene), overlap.scene.fields, 1);
}

BOOST_AUTO_TEST_CASE(iterations_take_over_from_those_that_have_ended_alone) {
  const MatrixXd within = tangent_after([](ContactInterface&) {});
  BOOST_TEST((tangent_after([](ContactInterface& contact) { forget_past(contact); }) == within));
  const MatrixXd after_end = tangent_after([](ContactInterface& contact) { contact.end_iterations(); });
  const MatrixXd anew = tangent_after([](ContactInterface& contact) {
    contact.end_iterations();
    forget_past(contact);
  });
  BOOST_TEST((after_end != anew));
}

BOOST_AUTO_TEST_CASE(with_friction_all_are_linearised_anew) {
  Effects effects = effects_of(false, 0);
  effects.friction_kind = FrictionKind::on_traction;
  const auto tangent = [&](bool forgets) {
    const auto end = [&](ContactInterface& contact) {
      contact.end_iterations();
      if (forgets) forget_past(contact);
    };
    return tangent_after(end, effects);
  };
  BOOST_TEST((tangent(false) == tangent(true)));
}

BOOST_AUTO_TEST_CASE(a_state_that_is_restored_leaves_nothing_to_be_taken_over) {
  const MatrixXd anew = tangent_after([](ContactInterface& contact) {
    contact.end_iterations();
    forget_past(contact);
  });
  BOOST_TEST((tangent_after([](ContactInterface& contact) { contact.restore(contact.state()); }) == anew));
}
