#include "contact/conditions/openings.h"
#include "contact/interface/past_iterations.h"
#include "contact/interface/residual_ahead.h"

#include "surfaces.h"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using namespace test;

namespace {

/// Two facing unit squares whose distance a test changes between iterations.
struct Approach {
  Scene scene;
  std::unique_ptr<ContactInterface> contact;

  /// `radius`: of the search; 0: facets look by themselves.
  explicit Approach(double overlap, const Effects& effects = effects_of(true, 1), double radius = 0)
      : scene(facing_grids(FacetType::quad4, FacetType::quad4, overlap), effects,
              looking_as_far_as(radius, explicit_settings(4, 2, 8))),
        contact(scene.contact()) {
    contact->begin_iteration(scene.fields);
  }

  /// Ends the iteration at another distance and begins the next one there. `slope`: by which the overlap grows with x.
  void move_to(double overlap, double slope = 0) {
    SurfaceFields& secondary = scene.fields[Side::secondary];
    secondary.position.row(2) = -(overlap + slope * secondary.position.row(0).array());
    contact->project(scene.position());
    contact->begin_iteration(scene.fields);
  }

  /// Ends a step of `dt` at another distance.
  void step_to(double overlap, double dt, double slope = 0) {
    move_to(overlap, slope);
    contact->accept_step(scene.fields, dt);
    contact->end_iterations();
  }

  /// In contact where a step of `ahead` begins.
  std::ptrdiff_t closed_where_a_step_begins(double ahead) {
    contact->end_iterations();
    contact->begin_iteration(scene.fields, ahead);
    return closed();
  }

  /// In contact, flux-coupled or not.
  std::ptrdiff_t closed() const {
    const std::vector<bool> nodes = contact->pass(0).nodal_loads(seen_from(Side::primary, scene.fields)).in_contact;
    return std::count(nodes.begin(), nodes.end(), true);
  }

  std::ptrdiff_t flux_coupled() const {
    const std::vector<bool> nodes = contact->nodes_in_contact()[Side::primary];
    return std::count(nodes.begin(), nodes.end(), true);
  }
};

constexpr std::ptrdiff_t all = 9;   // nodes of two by two facets
constexpr double touching = 1e-12;  // below what counts as touching at the start of a step

}  // namespace

BOOST_AUTO_TEST_CASE(nodes_that_touch_at_the_start_are_in_contact_and_rounding_does_not_open_them) {
  Approach approach(-touching);
  BOOST_TEST(approach.flux_coupled() == all);
  approach.move_to(-1e-16);
  BOOST_TEST(approach.flux_coupled() == all);
}

BOOST_AUTO_TEST_CASE(nodes_enter_within_a_step_only_where_they_overlap) {
  Approach approach(-0.125);
  BOOST_TEST(approach.flux_coupled() == 0);
  // Here neither status is wrong. To enter would change fluxes and pressure; the next step finds them touching.
  for (const double overlap : {-touching, 0.0, 1e-16}) {
    approach.move_to(overlap);
    BOOST_TEST(approach.flux_coupled() == 0);
  }
  approach.move_to(1e-6);
  BOOST_TEST(approach.flux_coupled() == all);
}

BOOST_AUTO_TEST_CASE(nodes_leave_where_they_are_pulled) {
  Approach approach(0.125);
  approach.move_to(-0.125);
  BOOST_TEST(approach.flux_coupled() == 0);
}

BOOST_AUTO_TEST_CASE(nodes_that_keep_changing_carry_load_but_are_not_flux_coupled) {
  Approach approach(0.125);
  for (int change = 1; change <= ActiveSetOptions().most_status_changes; ++change) {
    approach.move_to(change % 2 == 1 ? -0.125 : 0.125);
    BOOST_TEST(approach.flux_coupled() == (change % 2 == 1 ? 0 : all));
  }
  approach.move_to(0.125);
  BOOST_TEST(approach.flux_coupled() == 0);
  BOOST_TEST(output(*approach.contact, approach.scene.fields).balance.area > 0);
}

BOOST_AUTO_TEST_CASE(nodes_that_change_together_too_often_change_one_at_a_time) {
  Approach approach(0.125);
  for (int change = 1; change <= ActiveSetOptions().most_joint_changes + 1; ++change) {
    BOOST_TEST(approach.closed() == (change % 2 == 1 ? all : 0));
    approach.move_to(change % 2 == 1 ? -0.125 : 0.125);
  }
  BOOST_TEST(approach.closed() == 0);
  for (int change = 1; change <= all; ++change) {
    approach.move_to(0.125);
    BOOST_TEST(approach.closed() == change);
  }
}

// ------------------------------------------------------------ nodes that are expected to close or open in a step

/// Around the nodes of x = 0, 1/2, 1 it adds a sixth, a half, five sixths of itself to the overlap.
constexpr double slope = 0.6;
const Effects elastic = effects_of(false, 0);

/// When a gap beside contact closes that has changed like this in a time of 1: its power 2/3 changes evenly.
double closes_after(double from, double to) { return 1 / (std::pow(from / to, 2.0 / 3.0) - 1); }

BOOST_AUTO_TEST_CASE(a_step_begins_with_the_nodes_closed_that_their_motion_closes_within_it) {
  Approach approach(-1, elastic);
  approach.step_to(-0.45, 1, slope);
  approach.step_to(-0.4, 0.5, slope);  // gaps of 0.3 and 0.1, and an overlap of 0.1
  const double first = 0.5 * closes_after(0.15, 0.1);
  const double second = 0.5 * closes_after(0.35, 0.3);
  BOOST_TEST(approach.closed_where_a_step_begins(0) == 3);
  BOOST_TEST(approach.closed_where_a_step_begins(0.99 * first) == 3);
  BOOST_TEST(approach.closed_where_a_step_begins(1.01 * first) == 6);
  BOOST_TEST(approach.closed_where_a_step_begins(0.99 * second) == 6);
  BOOST_TEST(approach.closed_where_a_step_begins(1.01 * second) == all);
  approach.move_to(-0.4, slope);  // they have not come that far: pulled, they open
  BOOST_TEST(approach.closed() == 3);
}

/// The gap at a distance from the middle of a Hertz contact with this radius, times the radius of the sphere: what is
/// left of the approach with the displacement outside (Johnson 1985, Contact Mechanics, equation 3.42a).
double hertz_gap(double distance, double radius) {
  const double square = distance * distance;
  const double outside = std::sqrt(square - radius * radius);
  return (radius * outside + (square - 2 * radius * radius) * std::acos(radius / distance)) / std::acos(-1.0);
}

BOOST_AUTO_TEST_CASE(a_hertz_contact_is_expected_to_grow_as_it_does) {
  Approach approach(0.25, elastic);
  NodalLaws& laws = approach.contact->pass(0).laws();
  NodalGaps gaps = approach.contact->pass(0).space().gaps();
  // Node 0 is in contact, the others lie at squares of distances that the contact is to reach or not. Its own square
  // grows with the approach: 8, 9, and then 10.
  const std::vector<double> squares{9.05, 9.5, 9.9, 9.99, 10.03, 10.1, 10.3, 10.7};
  const auto gaps_at = [&](double square_of_radius) {
    for (std::size_t i = 0; i < squares.size(); ++i)
      gaps.gap[static_cast<Index>(i) + 1] = hertz_gap(std::sqrt(squares[i]), std::sqrt(square_of_radius));
    return gaps;
  };
  take_openings(laws, gaps_at(8), 1);
  take_openings(laws, gaps_at(9), 1);
  const VectorXd expected = expected_openings(laws, gaps_at(9), 1);
  for (std::size_t i = 0; i < squares.size(); ++i)
    BOOST_TEST((expected[static_cast<Index>(i) + 1] < 0) == (squares[i] < 10));
}

BOOST_AUTO_TEST_CASE(where_nothing_is_in_contact_gaps_are_expected_to_close_evenly) {
  Approach approach(-0.6, elastic, 1);
  approach.step_to(-0.5, 1);
  approach.step_to(-0.4, 0.5);  // at 1/5 a second
  BOOST_TEST(approach.closed_where_a_step_begins(1.99) == 0);
  BOOST_TEST(approach.closed_where_a_step_begins(2.01) == all);
}

BOOST_AUTO_TEST_CASE(a_node_that_has_just_opened_is_not_expected_to_close) {
  Approach approach(0.25, elastic);
  approach.step_to(-0.3, 1, slope);  // an overlap at x = 1 alone
  approach.step_to(-0.28, 1, slope);
  BOOST_TEST(approach.closed_where_a_step_begins(0) == 6);
  approach.step_to(-0.31, 1, slope);  // the nodes of x = 1/2 open
  BOOST_TEST(approach.closed_where_a_step_begins(100) == 3);
}

BOOST_AUTO_TEST_CASE(where_fields_are_exchanged_none_closes_ahead) {
  Approach approach(-1);
  approach.step_to(-0.45, 1, slope);
  approach.step_to(-0.4, 0.5, slope);
  BOOST_TEST(approach.closed_where_a_step_begins(10) == 3);
}

BOOST_AUTO_TEST_CASE(where_both_sides_have_conditions_none_closes_ahead) {
  Approach approach(-1, elastic);
  approach.scene.settings.two_pass = true;
  approach.contact = approach.scene.contact();
  approach.step_to(-0.45, 1, slope);
  approach.step_to(-0.4, 0.5, slope);
  BOOST_TEST(approach.closed_where_a_step_begins(10) == 3);
}

BOOST_AUTO_TEST_CASE(where_no_motion_is_known_a_step_begins_with_what_is_closed) {
  Approach approach(-1, elastic);
  approach.step_to(-0.45, 1, slope);
  approach.step_to(-0.4, 1, slope);
  approach.contact->forget_steps();
  BOOST_TEST(approach.closed_where_a_step_begins(100) == 3);
}

BOOST_AUTO_TEST_CASE(where_another_loading_begins_the_last_motion_tells_nothing) {
  Approach approach(-1, elastic);
  approach.step_to(-0.45, 1, slope);
  approach.step_to(-0.4, 1, slope);
  forget_motion(*approach.contact);
  BOOST_TEST(approach.closed_where_a_step_begins(100) == 3);
  approach.step_to(-0.35, 1, slope);  // and is known again after a step
  BOOST_TEST(approach.closed_where_a_step_begins(100) == all);
}

BOOST_AUTO_TEST_CASE(
    a_step_begins_with_the_nodes_open_that_their_motion_opens_within_it_where_they_carry_next_to_nothing) {
  Approach approach(0.25, elastic);
  approach.step_to(-0.1 + 0.006, 1, slope);  // the nodes of x = 0: three of nine, with a hundredth of the load
  forget_motion(*approach.contact);
  approach.step_to(-0.1 + 0.004, 1, slope);
  BOOST_TEST(approach.closed_where_a_step_begins(1.9) == all);
  BOOST_TEST(approach.closed_where_a_step_begins(2.1) == all - 3);
  Approach whole(0.125, elastic);
  whole.step_to(0.0625, 1);
  BOOST_TEST(whole.closed_where_a_step_begins(10) == all);  // they carry all
}

BOOST_AUTO_TEST_CASE(after_an_augmentation_no_node_closes_or_opens_ahead) {
  Approach approach(-1, elastic);
  approach.step_to(-0.45, 1, slope);
  approach.step_to(-0.4, 0.5, slope);
  approach.contact->augment(approach.scene.fields);
  BOOST_TEST(approach.closed_where_a_step_begins(10) == 3);
  BOOST_TEST(approach.closed_where_a_step_begins(10) == all);
}

BOOST_AUTO_TEST_CASE(surfaces_that_may_pull_are_in_contact_whatever_their_motion) {
  Approach approach(-0.25, elastic);
  approach.scene.settings.gap.tension = true;
  approach.contact = approach.scene.contact();
  const std::ptrdiff_t at_rest = approach.closed_where_a_step_begins(0);
  approach.step_to(-0.125, 0.5);
  BOOST_TEST(approach.closed_where_a_step_begins(10) == at_rest);
}

BOOST_AUTO_TEST_CASE(a_penalty_that_grows_looks_like_no_motion) {
  Approach approach(0.25, elastic);
  NodalLaws& laws = approach.contact->pass(0).laws();
  NodalGaps gaps = approach.contact->pass(0).space().gaps();
  take_openings(laws, gaps, 1);
  laws.multipliers.traction_penalty_scale *= 2;
  gaps.gap /= 2;
  take_openings(laws, gaps, 1);
  const VectorXd overlap = openings(laws, gaps);
  BOOST_TEST((expected_openings(laws, gaps, 8) - overlap).cwiseAbs().maxCoeff() == 0);
  gaps.gap.setConstant(0.125);  // open: the opening is the gap
  take_openings(laws, gaps, 0.5);
  const VectorXd expected = expected_openings(laws, gaps, 1.5);
  BOOST_TEST((expected - VectorXd::Constant(all, 0.125) - 3 * (VectorXd::Constant(all, 0.125) - overlap)).norm() <
             1e-12);
  NodalGaps facing_nothing = gaps;
  facing_nothing.area.setZero();
  take_openings(laws, facing_nothing, 0.5);
  BOOST_TEST(laws.multipliers.opening[0] == std::numeric_limits<double>::infinity());
  take_openings(laws, gaps, 0.5);  // where a node has just come to face something no motion is known
  BOOST_TEST((expected_openings(laws, gaps, 1).array() == 0.125).all());
}

BOOST_AUTO_TEST_CASE(where_a_step_does_not_end_as_foretold_the_next_begins_with_what_is_closed) {
  Approach approach(0.25, elastic);
  NodalLaws& laws = approach.contact->pass(0).laws();
  NodalGaps gaps = approach.contact->pass(0).space().gaps();
  const auto is_foretold_after = [&](double gap) {
    gaps.gap.setConstant(gap);
    take_openings(laws, gaps, 1);
    return laws.multipliers.was_foretold;
  };
  BOOST_TEST(is_foretold_after(0.3));
  BOOST_TEST(is_foretold_after(0.125));
  BOOST_TEST(!is_foretold_after(0.125));  // it would have closed
  BOOST_TEST(!is_foretold_after(0.05));   // nothing was foretold
  BOOST_TEST(is_foretold_after(-0.025));
}

BOOST_AUTO_TEST_CASE(expectations_do_not_depend_on_the_unit_of_length) {
  Approach approach(0.25, elastic);
  NodalLaws& laws = approach.contact->pass(0).laws();
  NodalGaps gaps = approach.contact->pass(0).space().gaps();
  // Per node: as the last step began, as it ended, and now. Status may differ where points or penalties have.
  Eigen::Matrix<double, 3, 8> openings_of;
  openings_of << 0.3, 0.3, 0.3, 0.3, -0.3, -0.3, -0.3, -0.3,  //
      0.2, 0.2, -0.2, -0.2, 0.2, 0.2, -0.2, -0.2,             //
      0.1, -0.1, 0.1, -0.1, 0.1, -0.1, 0.1, -0.1;
  const auto expected = [&](double unit) {
    const auto at_time = [&](Index row) {
      gaps.gap.head<8>() = unit * openings_of.row(row).transpose();
      return gaps;
    };
    laws.forget_steps();
    take_openings(laws, at_time(0), 1);
    take_openings(laws, at_time(1), 1);
    return VectorXd(expected_openings(laws, at_time(2), 2) / unit);
  };
  const VectorXd one = expected(1);
  const VectorXd other = expected(1000);
  for (Index node = 0; node < 8; ++node) BOOST_TEST(one[node] == other[node], boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(what_closed_ahead_adds_to_the_residual_can_be_taken_out_of_it) {
  Approach approach(-0.5, elastic, 2);
  const ContactInterface& contact = *approach.contact;
  const PerSide<SurfaceFields>& fields = approach.scene.fields;
  const GlobalLayout layout(approach.scene);
  const auto ahead = [&] {
    VectorXd sum = VectorXd::Zero(layout.size() + 1);
    residual_ahead(contact, fields, 0.25, [&](const ContactInterface::Location& at, const VectorXd& part) {
      sum(layout.entries(at)) += part;
    });
    return VectorXd(sum.head(layout.size()));
  };
  approach.step_to(-0.5, 1, slope);
  approach.step_to(-0.4, 1, slope);
  BOOST_TEST(approach.closed_where_a_step_begins(0) == 3);
  const VectorXd without = assembled_residual(contact, layout, fields, 0.25);
  BOOST_TEST(ahead().isZero(0));
  BOOST_TEST(approach.closed_where_a_step_begins(10) == all);
  const VectorXd added = ahead();
  BOOST_TEST(added.norm() > without.norm());
  const VectorXd with = assembled_residual(contact, layout, fields, 0.25);
  BOOST_TEST((with - added - without).norm() <= 1e-14 * added.norm());
}

BOOST_AUTO_TEST_CASE(a_node_that_slid_without_friction_begins_a_step_sliding) {
  Effects effects = effects_of(false, 0);
  effects.friction_kind = FrictionKind::on_traction;
  Settings settings = explicit_settings(4, 2, 8);
  settings.friction.coefficient = 0.1;
  const Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, 0.0625), effects, settings);
  const auto contact = scene.contact();
  ContactPass& pass = contact->pass(0);
  for (const bool slid : {true, false}) {
    pass.laws().multipliers.slips = NodeFlags(pass.laws().nodes(), slid);
    const NodalLoads loads = pass.nodal_loads({scene.fields[Side::primary], scene.fields[Side::secondary]});
    const NodeFlags slips = ActiveSet(pass.laws()).initial_slip(loads);
    for (Index node = 0; node < slips.count(); ++node) BOOST_TEST(slips[node] == slid);
  }
}

BOOST_AUTO_TEST_CASE(a_step_that_would_begin_open_begins_with_overlapping_points_until_one_is_accepted) {
  Approach approach(-0.1, elastic);
  // The middle of the lower surface stands up by 0.5: facets around the middle overlap there, and averages are open.
  const auto raise_middle = [&] { approach.scene.fields[Side::primary].position(2, 4) += 0.3; };
  raise_middle();
  approach.contact->project(approach.scene.position());
  const NodeFlags around = overlapped_nodes(approach.contact->pass(0).space());
  approach.contact->pass(0).laws().close_overlapped = true;
  const std::ptrdiff_t begun = approach.closed_where_a_step_begins(0);
  BOOST_TEST(begun == std::count(around.begin(), around.end(), true));
  approach.contact->accept_step(approach.scene.fields, 1);
  BOOST_TEST(!approach.contact->pass(0).laws().close_overlapped);
}
