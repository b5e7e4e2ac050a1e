#include "contact/interface/corrections.h"
#include "contact/interface/relocation.h"

#include "surfaces.h"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <optional>

using namespace test;

namespace {

constexpr double dt = 0.25;
constexpr double balance_tolerance = 1e-12;

/// Pairs of facet types for non-matching meshes, with every type on either side.
constexpr std::array<std::array<FacetType, 2>, 5> mixed_pairs{{{FacetType::quad4, FacetType::tri3},
                                                               {FacetType::tri3, FacetType::quad9},
                                                               {FacetType::tri6, FacetType::quad8},
                                                               {FacetType::quad8, FacetType::quad4},
                                                               {FacetType::quad9, FacetType::tri6}}};

/// A non-matching contact with random overlap, slopes, fields and multipliers.
Scene random_scene(FacetType one, FacetType two, bool two_pass, std::mt19937& random) {
  Scene scene(facing_grids(one, two, 0.05, 1, 2), effects_of(true, 1), explicit_settings(3, 2, 5));
  scene.settings.two_pass = two_pass;
  scene.disturb(0.02, random);
  return scene;
}

/// Calls `check` for random contacts of mixed facets with one and two passes, each without and with multipliers.
template <class Check>
void for_random_contacts(unsigned seed, const Check& check) {
  std::mt19937 random(seed);
  for (const auto& [one, two] : mixed_pairs) {
    for (const bool two_pass : {false, true}) {
      const Scene scene = random_scene(one, two, two_pass, random);
      const auto contact = scene.contact();
      contact->augment(scene.fields);
      check(scene, *contact);
    }
  }
}

/// Unit squares with an overlap of 1/16, a jump of 1/4 in the solvent and of -2 in the solute, and penalties 4, 2, 8.
Scene uniform_scene(FacetType one, FacetType two, bool two_pass) {
  Scene scene(facing_grids(one, two, 0.0625, 2, 3), effects_of(true, 1), explicit_settings(4, 2, 8));
  scene.settings.two_pass = two_pass;
  scene.set_field(0, 0.5, 0.25);
  scene.set_field(1, 1, 3);
  return scene;
}

/// Sum of forces and flows on one side, shape (3 + fields).
VectorXd side_sum(const GlobalLayout& layout, const VectorXd& residual, Side side) {
  VectorXd sum = VectorXd::Zero(layout.per_node());
  for (Index node = 0; node < layout.nodes[side]; ++node)
    sum += residual.segment(layout.entry(side, node, 0), layout.per_node());
  return sum;
}

/// The change of the residual by an iteration that has begun; empty if it is unknown.
std::optional<VectorXd> changed_residual(const ContactInterface& contact, const GlobalLayout& layout,
                                         const PerSide<SurfaceFields>& fields) {
  VectorXd sum = VectorXd::Zero(layout.size() + 1);
  const bool known = residual_change(
      contact, fields, dt,
      [&](const ContactInterface::Location& at, const VectorXd& part) { sum(layout.entries(at)) += part; });
  return known ? std::optional<VectorXd>(sum.head(layout.size())) : std::nullopt;
}

/// All results of a contact in one vector.
VectorXd answers(const ContactInterface& contact, const Scene& scene) {
  const GlobalLayout layout(scene);
  std::vector<double> all;
  const auto append = [&](const auto& values) { all.insert(all.end(), values.data(), values.data() + values.size()); };
  append(assembled_residual(contact, layout, scene.fields, dt));
  append(assembled_tangent(contact, layout, scene.fields, dt));
  const GapReport report = contact.gaps(scene.fields);
  all.insert(all.end(), {report.traction.relative, report.traction.largest});
  for (const FieldGap& gap : report.flux) all.insert(all.end(), {gap.relative, gap.largest});
  const InterfaceOutput said = output(contact, scene.fields);
  append(said.balance.force);
  append(said.balance.flow);
  const PerSide<NodeFlags> touched_nodes = contact.nodes_in_contact();
  for (const Side side : both_sides) {
    const NodalOutput& out = said.nodes[side];
    append(out.gap);
    append(out.pressure);
    append(out.flux);
    append(out.jump);
    append(out.tributary_area);
    for (const bool touched : touched_nodes[side]) all.push_back(touched ? 1 : 0);
  }
  return Eigen::Map<const VectorXd>(all.data(), static_cast<Index>(all.size()));
}

PerSide<Matrix3Xd> moved(PerSide<Matrix3Xd> position, const Vector3d& shift) {
  position[Side::secondary].colwise() += shift;
  return position;
}

std::vector<bool> touched_nodes(const Scene& scene, Side side) { return scene.contact()->nodes_in_contact()[side]; }

/// A square plate of one facet type on [0, 3]^2 and one on [1, 2]^2. `small`: side of the smaller plate.
Scene plates(FacetType one, FacetType two, Side small, bool two_pass, int cells_per_length_of_small) {
  PerSide<Grid> grids = facing_grids(one, two, 0.05);
  for (const Side side : both_sides) {
    const bool inner = side == small;
    Grid& grid = grids[side];
    grid.cells_x = grid.cells_y = inner ? cells_per_length_of_small : 3;
    grid.low.setConstant(inner ? 1 : 0);
    grid.high.setConstant(inner ? 2 : 3);
  }
  Scene scene(grids, effects_of(true, 0));
  scene.settings.two_pass = two_pass;
  return scene;
}

/// Distance of a point from the square [1, 2]^2.
double distance_from_inner(const Vector3d& x) {
  return (x.head<2>() - Vector2d::Constant(1.5)).cwiseAbs().maxCoeff() - 0.5;
}

}  // namespace

/// Relative difference between a contact's tangent and central differences of its residual.
double tangent_error(const Scene& scene, ContactInterface& contact) {
  const GlobalLayout layout(scene);
  const auto residual = [&](const VectorXd& q) {
    const PerSide<SurfaceFields> fields = layout.unpack(q);
    contact.project({{fields[Side::primary].position, fields[Side::secondary].position}});
    return assembled_residual(contact, layout, fields, dt);
  };
  const MatrixXd approximate = differences(residual, layout.pack(scene.fields));
  contact.project(scene.position());
  return relative_error(approximate, assembled_tangent(contact, layout, scene.fields, dt));
}

BOOST_AUTO_TEST_CASE(the_tangent_of_a_whole_contact_matches_differences) {
  double worst = 0;
  for_random_contacts(1, [&](const Scene& scene, ContactInterface& contact) {
    const double error = tangent_error(scene, contact);
    worst = std::max(worst, error);
    BOOST_TEST(error <= difference_tolerance);
  });
  BOOST_TEST_MESSAGE("tangent of a whole contact, largest relative difference " << worst);
}

BOOST_AUTO_TEST_CASE(the_tangent_matches_differences_where_surfaces_apart_pull_and_with_an_offset) {
  for_random_contacts(2, [&](const Scene& scene, const ContactInterface&) {
    for (const bool tension : {false, true}) {
      Scene changed = scene;
      changed.settings.gap.tension = tension;
      changed.settings.gap.offset = tension ? 0.05 : 0.4;
      changed.fields[Side::secondary].position.row(2).array() += 0.3;
      const auto contact = changed.contact();
      BOOST_TEST(tangent_error(changed, *contact) <= difference_tolerance);
    }
  });
}

BOOST_AUTO_TEST_CASE(an_offset_is_the_distance_that_gaps_are_measured_from) {
  Scene scene = uniform_scene(FacetType::quad4, FacetType::tri3, false);
  const Balance touching = output(*scene.contact(), scene.fields).balance;
  scene.settings.gap.offset = 0.25;
  scene.fields[Side::secondary].position.row(2).array() += 0.25;
  const Balance apart = output(*scene.contact(), scene.fields).balance;
  BOOST_TEST((touching.force - apart.force).norm() <= rounding);
}

BOOST_AUTO_TEST_CASE(an_offset_that_changes_counts_at_once) {
  Scene scene = uniform_scene(FacetType::quad4, FacetType::tri3, false);
  const auto contact = scene.contact();
  Settings changed = scene.settings;
  changed.gap.offset = 0.125;
  contact->update_laws(changed);
  scene.settings = changed;
  BOOST_TEST((answers(*contact, scene) == answers(*scene.contact(), scene)));
}

BOOST_AUTO_TEST_CASE(under_tension_surfaces_apart_pull_and_others_do_not) {
  Scene scene = uniform_scene(FacetType::quad4, FacetType::quad4, false);
  scene.fields[Side::secondary].position.row(2).array() += 0.125;
  BOOST_TEST(output(*scene.contact(), scene.fields).balance.force.norm() == 0.0);
  Scene overlapping = uniform_scene(FacetType::quad4, FacetType::quad4, false);
  const double pressed = output(*overlapping.contact(), overlapping.fields).balance.force[2];
  scene.settings.gap.tension = true;
  BOOST_TEST(std::abs(output(*scene.contact(), scene.fields).balance.force[2] + pressed) <= rounding);
}

BOOST_AUTO_TEST_CASE(forces_and_flows_of_the_two_surfaces_cancel) {
  double worst = 0;
  for_random_contacts(2, [&](const Scene& scene, const ContactInterface& contact) {
    const GlobalLayout layout(scene);
    const VectorXd residual = assembled_residual(contact, layout, scene.fields, dt);
    const VectorXd sum = side_sum(layout, residual, Side::primary) + side_sum(layout, residual, Side::secondary);
    const VectorXd magnitude = residual.cwiseAbs();
    const VectorXd size = side_sum(layout, magnitude, Side::primary) + side_sum(layout, magnitude, Side::secondary);
    worst = std::max(worst, (sum.array() / size.array()).abs().maxCoeff());
    BOOST_TEST((sum.array().abs() <= balance_tolerance * size.array()).all());
  });
  BOOST_TEST_MESSAGE("balance of a whole contact, largest relative imbalance " << worst);
}

BOOST_AUTO_TEST_CASE(moments_of_the_two_surfaces_cancel) {
  for_random_contacts(3, [](const Scene& scene, const ContactInterface& contact) {
    const GlobalLayout layout(scene);
    const VectorXd residual = assembled_residual(contact, layout, scene.fields, dt);
    Vector3d moment(0, 0, 0);
    for (const Side side : both_sides) {
      for (Index node = 0; node < layout.nodes[side]; ++node) {
        const Vector3d x = scene.fields[side].position.col(node);
        moment += x.cross(residual.segment<3>(layout.entry(side, node, 0)));
      }
    }
    BOOST_TEST(moment.norm() <= balance_tolerance * residual.norm());
  });
}

BOOST_AUTO_TEST_CASE(the_balance_is_the_sum_of_the_residual) {
  for_random_contacts(4, [](const Scene& scene, const ContactInterface& contact) {
    const GlobalLayout layout(scene);
    const VectorXd sum = side_sum(layout, assembled_residual(contact, layout, scene.fields, dt), Side::primary);
    const Balance total = output(contact, scene.fields).balance;
    BOOST_TEST((sum.head<3>() - total.force).norm() <= balance_tolerance * total.force.norm());
    BOOST_TEST((sum.tail(2) - dt * total.flow).norm() <= balance_tolerance * total.flow.norm());
  });
}

BOOST_AUTO_TEST_CASE(evaluating_again_gives_the_same_bits_and_changes_no_state) {
  for_random_contacts(5, [](const Scene& scene, ContactInterface& contact) {
    const Multipliers before = contact.pass(0).laws().multipliers;
    const VectorXd first = answers(contact, scene);
    BOOST_TEST((answers(contact, scene) == first));
    BOOST_TEST((contact.pass(0).laws().multipliers.traction == before.traction));
    BOOST_TEST((contact.pass(0).laws().multipliers.flux == before.flux));
    BOOST_TEST((contact.pass(0).laws().multipliers.flux_penalty_scale == before.flux_penalty_scale));
    BOOST_TEST(contact.pass(0).laws().multipliers.traction_penalty_scale == before.traction_penalty_scale);
  });
}

BOOST_AUTO_TEST_CASE(loads_held_for_residuals_are_those_of_an_iteration_without_its_linearisation) {
  for_random_contacts(53, [](const Scene& scene, ContactInterface& contact) {
    const GlobalLayout layout(scene);
    contact.begin_iteration(scene.fields);
    const VectorXd linearised = assembled_residual(contact, layout, scene.fields, dt);
    const std::size_t memory = contact.pass(0).memory();
    contact.end_iterations();
    hold_loads(contact, scene.fields);
    BOOST_TEST((assembled_residual(contact, layout, scene.fields, dt) == linearised));
    BOOST_TEST(2 * contact.pass(0).memory() < memory);
  });
}

BOOST_AUTO_TEST_CASE(what_an_iteration_changes_of_the_residual_is_the_difference_of_two) {
  std::mt19937 random(67);
  for (const auto& [one, two] : mixed_pairs) {
    for (const FrictionKind friction : {FrictionKind::none, FrictionKind::on_traction}) {
      Scene scene = random_scene(one, two, true, random);
      scene.effects.friction_kind = friction;
      scene.settings.friction.coefficient = 0.3;
      const GlobalLayout layout(scene);
      const auto contact = scene.contact();
      contact->begin_iteration(scene.fields);
      BOOST_TEST(!changed_residual(*contact, layout, scene.fields).has_value());  // there were no loads before
      scene.disturb(0.02, random);
      contact->project(scene.position());
      const VectorXd before = assembled_residual(*contact, layout, scene.fields, dt);
      BOOST_TEST(contact->begin_iteration(scene.fields));
      const VectorXd after = assembled_residual(*contact, layout, scene.fields, dt);
      const std::optional<VectorXd> change = changed_residual(*contact, layout, scene.fields);
      BOOST_REQUIRE(change.has_value());
      BOOST_TEST((before + *change - after).norm() <= rounding * before.norm());
      BOOST_TEST(change->norm() > 1e-3 * before.norm());
      scene.disturb(0.02, random);
      contact->project(scene.position());
      BOOST_TEST(!changed_residual(*contact, layout, scene.fields).has_value());  // the surfaces have moved
    }
  }
}

BOOST_AUTO_TEST_CASE(surfaces_that_have_moved_by_rounding_have_other_gaps_at_the_same_points) {
  Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, 0.05, 3, 4), effects_of(false, 0),
              explicit_settings(3, 2, 5));
  scene.settings.integration = Integration::segments;
  const auto contact = scene.contact();
  const FacingPairs& facing = contact->pass(0).space().facing();
  const auto places = [&] {
    std::vector<double> all;
    for (const FacetPair& pair : facing.pairs()) {
      for (const IntegrationPoint& point : facing.points(pair))
        all.insert(all.end(), {point.xi[0], point.xi[1], point.weight});
    }
    return all;
  };
  const std::vector<double> before = places();
  const VectorXd gap = contact->pass(0).space().gaps().gap;
  const Matrix3Xd there = scene.fields[Side::secondary].position;
  const double rounding_of_coordinates = std::numeric_limits<double>::epsilon() * there.cwiseAbs().maxCoeff();
  const auto move_by = [&](double by) {
    scene.fields[Side::secondary].position = there.array() + by;  // also along the surface
    contact->project(scene.position());
  };
  move_by(2 * rounding_of_coordinates);
  BOOST_TEST((places() == before));
  BOOST_TEST((contact->pass(0).space().gaps().gap != gap));
  move_by(1e-6);
  BOOST_TEST((places() != before));
}

PerSide<bool> on_both_sides(bool is_so) { return {{is_so, is_so}}; }

/// A contact that was linearised at the start of an iteration and has then moved.
struct MovedContact {
  MovedContact(Scene at, std::mt19937& random) : scene(std::move(at)), layout(scene), contact(scene.contact()) {
    contact->begin_iteration(scene.fields);
    has_matrix(*contact, on_both_sides(false));
    start = scene.fields;
    scene.disturb(0.005, random);
    contact->project(scene.position());
  }
  VectorXd residual_at(const PerSide<SurfaceFields>& fields) const {
    return assembled_residual(*contact, layout, fields, dt);
  }
  VectorXd correction() const {
    return changed_residual(*contact, layout, scene.fields).value_or(VectorXd::Zero(layout.size()));
  }

  Scene scene;
  GlobalLayout layout;
  std::unique_ptr<ContactInterface> contact;
  PerSide<SurfaceFields> start;
};

BOOST_AUTO_TEST_CASE(a_correction_gives_gaps_and_jumps_their_true_values_and_keeps_how_they_vary) {
  std::mt19937 random(73);
  for (const auto& [one, two] : mixed_pairs) {
    MovedContact moved(random_scene(one, two, false, random), random);
    const ContactPass& pass = moved.contact->pass(0);
    const auto loads = [&](const PerSide<SurfaceFields>& fields) {
      return pass.nodal_loads(seen_from(Side::primary, fields));
    };
    const NodalLoads before = loads(moved.scene.fields);
    const NodalLoads at_start = loads(moved.start);
    BOOST_TEST(correct(*moved.contact, moved.scene.fields));
    const NodalLoads after = loads(moved.scene.fields);
    const NodalGaps true_gaps = pass.space().gaps();
    double moved_by = 0;
    for (Index node = 0; node < after.in_contact.count(); ++node) {
      if (!after.in_contact[node]) continue;
      BOOST_TEST(std::abs(after.gap[node] - true_gaps.gap[node]) < rounding);
      moved_by = std::max(moved_by, std::abs(after.gap[node] - before.gap[node]));
    }
    BOOST_TEST(moved_by > 1e-5);
    BOOST_TEST((after.traction - before.traction - (loads(moved.start).traction - at_start.traction)).norm() <
               rounding * at_start.traction.norm());
  }
}

BOOST_AUTO_TEST_CASE(a_correction_changes_the_residual_by_the_works_of_the_linearisation) {
  std::mt19937 random(79);
  for (const auto& [one, two] : mixed_pairs) {
    MovedContact moved(random_scene(one, two, true, random), random);
    ContactInterface& contact = *moved.contact;
    const PerSide<Matrix3Xd> there = moved.scene.position();
    const auto at_start = [&] {
      Scene start = moved.scene;
      start.fields = moved.start;
      contact.project(start.position());
      const VectorXd residual = moved.residual_at(moved.start);
      contact.project(there);
      return residual;
    };
    const VectorXd before = at_start();
    correct(contact, moved.scene.fields);
    const VectorXd correction = moved.correction();
    BOOST_TEST(correction.norm() > 1e-4 * before.norm());
    BOOST_TEST((before + correction - at_start()).norm() < rounding * before.norm());
  }
}

BOOST_AUTO_TEST_CASE(a_linearisation_that_the_matrix_is_not_of_is_not_corrected) {
  std::mt19937 random(83);
  Scene scene = random_scene(FacetType::quad4, FacetType::tri3, false, random);
  const auto contact = scene.contact();
  contact->begin_iteration(scene.fields);
  scene.disturb(0.005, random);
  contact->project(scene.position());
  BOOST_TEST(!correct(*contact, scene.fields));
  BOOST_TEST(serves_again(*contact, scene.fields) == contact->is_solution(scene.fields));
  const GlobalLayout layout(scene);
  const std::optional<VectorXd> change = changed_residual(*contact, layout, scene.fields);
  BOOST_TEST((change.has_value() && change->isZero(0)));
}

/// An elastic contact of flat surfaces, one of which can be tilted by more than the overlap: nodes on one side are then
/// in tension. Gaps are linear in the tilt, and loads are known up to rounding.
struct TiltedContact {
  TiltedContact()
      : scene(facing_grids(FacetType::quad4, FacetType::quad4, 0.05, 3, 4), effects_of(false, 0),
              explicit_settings(3, 2, 5)),
        flat(scene.fields),
        contact(scene.contact()) {}
  void tilt(double by) {
    scene.fields = flat;
    const auto x = flat[Side::secondary].position.row(0);
    scene.fields[Side::secondary].position.row(2).array() += by * (x.array() - x.minCoeff()) /
                                                             (x.maxCoeff() - x.minCoeff());
    contact->project(scene.position());
  }
  NodalLoads loads() const { return contact->pass(0).nodal_loads(seen_from(Side::primary, scene.fields)); }
  HeldLinearisation& held() const { return contact->pass(0).geometry().moving()->held(); }
  FacingFields fields() const { return seen_from(Side::primary, scene.fields); }

  Scene scene;
  PerSide<SurfaceFields> flat;
  std::unique_ptr<ContactInterface> contact;
};

constexpr double much = 0.1;

BOOST_AUTO_TEST_CASE(nodes_that_open_are_released_where_the_host_can_and_close_again) {
  for (const bool may_release : {false, true}) {
    TiltedContact tilted;
    ContactInterface& contact = *tilted.contact;
    contact.begin_iteration(tilted.scene.fields);
    has_matrix(contact, on_both_sides(may_release));
    tilted.tilt(much);
    BOOST_TEST(serves_again(contact, tilted.scene.fields) == may_release);
    if (!may_release) continue;
    correct(contact, tilted.scene.fields);
    const IndexedVector<int> released = tilted.held().released();
    BOOST_TEST(!released.empty());
    const NodalLoads loads = tilted.loads();
    for (const int node : released) BOOST_TEST(loads.traction[node] == 0);
    BOOST_TEST(loads.traction.maxCoeff() <= 0);
    BOOST_TEST(contact.is_solution(tilted.scene.fields));
    BOOST_TEST(correct(contact, tilted.scene.fields));  // loads stay the same and have to be kept at zero again
    tilted.tilt(0);
    BOOST_TEST(serves_again(contact, tilted.scene.fields));
    correct(contact, tilted.scene.fields);
    BOOST_TEST(tilted.held().released().empty());
    BOOST_TEST(tilted.held().added().empty());
  }
}

BOOST_AUTO_TEST_CASE(what_elastic_nodes_that_open_and_close_change_of_the_residual_is_the_difference_of_two) {
  TiltedContact tilted;
  ContactInterface& contact = *tilted.contact;
  const GlobalLayout layout(tilted.scene);
  contact.begin_iteration(tilted.scene.fields);
  std::vector<Index> open;
  for (const double tilt : {0.3 * much, much, 0.0}) {
    tilted.tilt(tilt);
    const VectorXd before = assembled_residual(contact, layout, tilted.scene.fields, dt);
    contact.begin_iteration(tilted.scene.fields);
    const std::optional<VectorXd> change = changed_residual(contact, layout, tilted.scene.fields);
    BOOST_REQUIRE(change.has_value());
    const VectorXd after = assembled_residual(contact, layout, tilted.scene.fields, dt);
    BOOST_TEST((before + *change - after).norm() < rounding * before.norm());
    const NodeFlags status = tilted.loads().in_contact;
    open.push_back(std::count(status.begin(), status.end(), false));
  }
  BOOST_TEST(open[1] > open[0]);
  BOOST_TEST(open[2] < open[1]);
}

Index known(const VectorXd& values) { return values.array().isFinite().count(); }

BOOST_AUTO_TEST_CASE(nodes_open_as_an_iteration_begins_where_its_matrix_answers_that_they_pull) {
  TiltedContact tilted;
  ContactInterface& contact = *tilted.contact;
  contact.begin_iteration(tilted.scene.fields);
  BOOST_TEST(known(tilted.held().undecided(tilted.fields())) == 0);  // there is no matrix yet
  has_matrix(contact, on_both_sides(true));
  VectorXd answered = tilted.held().undecided(tilted.fields());
  const NodalLoads before = tilted.loads();
  BOOST_TEST(known(answered) == std::count(before.in_contact.begin(), before.in_contact.end(), true));
  BOOST_TEST(answered == before.traction, boost::test_tools::per_element());

  answered[0] = 1;
  answered[1] = std::numeric_limits<double>::quiet_NaN();  // the host does not know this value
  const double rounding_of_answers = 1e-9 * answered[2];
  answered[3] = -rounding_of_answers;
  const NodeFlags none = tilted.scene.nowhere()[Side::primary];
  const NodeFlags opened = tilted.held().opening(answered, none);
  NodeFlags expected = none;
  expected[0] = true;
  BOOST_TEST((opened == expected));
  answered[0] = -1;  // the node would overlap if it had opened
  BOOST_TEST((tilted.held().opening(answered, opened) == none));

  const GlobalLayout layout(tilted.scene);
  const VectorXd residual = assembled_residual(contact, layout, tilted.scene.fields, dt);
  tilted.held().open(opened, tilted.fields());
  const std::optional<VectorXd> change = changed_residual(contact, layout, tilted.scene.fields);
  BOOST_REQUIRE(change.has_value());
  const VectorXd after = assembled_residual(contact, layout, tilted.scene.fields, dt);
  BOOST_TEST((residual + *change - after).norm() < rounding * residual.norm());
  BOOST_TEST(change->norm() > 1e-3 * residual.norm());
  NodalLoads loads = tilted.loads();
  BOOST_TEST(loads.traction[0] == 0);
  loads.traction[0] = before.traction[0];
  BOOST_TEST(loads.traction == before.traction, boost::test_tools::per_element());
  BOOST_TEST((tilted.held().released() == IndexedVector<int>{0}));

  tilted.held().open(none, tilted.fields());
  BOOST_TEST(changed_residual(contact, layout, tilted.scene.fields).value().norm() == 0);  // opened nodes count once
}

BOOST_AUTO_TEST_CASE(nodes_close_as_an_iteration_begins_where_its_matrix_answers_that_they_overlap) {
  TiltedContact tilted;
  ContactInterface& contact = *tilted.contact;
  tilted.tilt(much);
  contact.begin_iteration(tilted.scene.fields);
  const NodeFlags before = tilted.loads().in_contact;
  PerSide<Matrix3Xd> back;
  for (const Side side : both_sides) back[side] = tilted.flat[side].position - tilted.scene.fields[side].position;
  const auto find_nearing = [&] { return tilted.held().find_nearing(seen_from(Side::primary, back), tilted.fields()); };
  const NodeFlags none = tilted.scene.nowhere()[Side::primary];
  BOOST_TEST(!tilted.held().may_decide());  // there is no matrix yet
  has_matrix(contact, on_both_sides(true));
  BOOST_TEST(tilted.held().may_decide());
  BOOST_TEST((find_nearing() == none));  // no nodes are found at the start of a step
  contact.begin_iteration(tilted.scene.fields);
  has_matrix(contact, on_both_sides(true));

  const NodeFlags nearing = find_nearing();
  // All nodes of the flat surface.
  for (Index node = 0; node < nearing.count(); ++node) BOOST_TEST(nearing[node] == !before[node]);
  for (const int node : tilted.held().nearing()) BOOST_TEST(nearing[node]);
  BOOST_TEST((find_nearing() == none));  // no further node
  const VectorXd tractions = tilted.held().undecided(tilted.fields());
  const NodalLaws& laws = contact.pass(0).laws();
  const NodalGaps gaps = contact.pass(0).space().gaps();
  for (Index node = 0; node < nearing.count(); ++node) {
    if (nearing[node]) BOOST_TEST(std::abs(tractions[node] - laws.traction_penalty(node) * gaps.gap[node]) < rounding);
  }
  BOOST_TEST((tilted.held().opening(tractions, nearing) == nearing));  // the nodes would be in tension

  const GlobalLayout layout(tilted.scene);
  const VectorXd residual = assembled_residual(contact, layout, tilted.scene.fields, dt);
  tilted.held().open(nearing, tilted.fields());
  BOOST_TEST(changed_residual(contact, layout, tilted.scene.fields).value().norm() == 0);
  BOOST_TEST(tilted.held().added().empty());
  tilted.held().open(none, tilted.fields());
  const std::optional<VectorXd> change = changed_residual(contact, layout, tilted.scene.fields);
  BOOST_REQUIRE(change.has_value());
  const VectorXd after = assembled_residual(contact, layout, tilted.scene.fields, dt);
  BOOST_TEST((residual + *change - after).norm() < rounding * residual.norm());
  BOOST_TEST(change->norm() > 1e-3 * residual.norm());
  BOOST_TEST(tilted.held().added().count() == std::count(nearing.begin(), nearing.end(), true));
  tilted.tilt(0);
  const NodalLoads flat = tilted.loads();
  for (Index node = 0; node < nearing.count(); ++node) BOOST_TEST(flat.traction[node] < 0);
}

BOOST_AUTO_TEST_CASE(no_node_opens_as_an_iteration_begins_where_others_decide_with_its_traction) {
  const auto releasable = [](const Effects& effects, const Settings& settings, bool has_loads) {
    Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, 0.05, 3, 4), effects, settings);
    const auto contact = scene.contact();
    contact->begin_iteration(scene.fields);
    has_matrix(*contact, on_both_sides(has_loads));
    Index undecided = 0;
    for_each_correctable(*contact, [&](Side side, const HeldLinearisation& held) {
      undecided += known(held.undecided(seen_from(side, scene.fields)));
    });
    return undecided;
  };
  const Settings plain = explicit_settings(3, 2, 5);
  Settings both = plain;
  both.two_pass = true;
  Settings pulling = plain;
  pulling.gap.tension = true;
  Effects rubbing = effects_of(false, 0);
  rubbing.friction_kind = FrictionKind::on_traction;
  Settings rough = plain;
  rough.friction.coefficient = 0.3;
  BOOST_TEST(releasable(effects_of(false, 0), plain, true) > 0);
  BOOST_TEST(releasable(effects_of(false, 0), plain, false) == 0);
  BOOST_TEST(releasable(effects_of(true, 0), plain, true) == 0);
  BOOST_TEST(releasable(effects_of(false, 0), both, true) > 0);
  BOOST_TEST(releasable(effects_of(false, 0), pulling, true) == 0);
  BOOST_TEST(releasable(rubbing, rough, true) == 0);
}

BOOST_AUTO_TEST_CASE(nodes_that_close_are_added_where_the_host_can_and_open_again) {
  for (const bool may_add : {false, true}) {
    TiltedContact tilted;
    ContactInterface& contact = *tilted.contact;
    tilted.tilt(much);
    contact.begin_iteration(tilted.scene.fields);
    const NodeFlags before = tilted.loads().in_contact;
    has_matrix(contact, on_both_sides(may_add));
    tilted.tilt(0);
    BOOST_TEST(serves_again(contact, tilted.scene.fields) == may_add);
    if (!may_add) continue;
    BOOST_TEST(correct(contact, tilted.scene.fields));
    const IndexedVector<int> added = tilted.held().added();
    const NodalLoads loads = tilted.loads();
    const NodalGaps gaps = contact.pass(0).space().gaps();
    BOOST_TEST(!added.empty());
    for (const int node : added) {
      BOOST_TEST(!before[node]);
      BOOST_TEST(loads.traction[node] < 0);
      BOOST_TEST(std::abs(loads.gap[node] - gaps.gap[node]) < rounding);
    }
    BOOST_TEST(contact.is_solution(tilted.scene.fields));
    BOOST_TEST(correct(contact, tilted.scene.fields));  // loads stay the same and have to be added again
    tilted.tilt(much);
    BOOST_TEST(serves_again(contact, tilted.scene.fields));
    correct(contact, tilted.scene.fields);
    BOOST_TEST(tilted.held().added().empty());
    BOOST_TEST(tilted.held().released().empty());  // none of the nodes is in the matrix
  }
}

BOOST_AUTO_TEST_CASE(what_an_added_node_makes_of_the_residual_is_its_work) {
  TiltedContact tilted;
  ContactInterface& contact = *tilted.contact;
  tilted.tilt(much);
  contact.begin_iteration(tilted.scene.fields);
  has_matrix(contact, on_both_sides(true));
  tilted.tilt(0);
  const GlobalLayout layout(tilted.scene);
  const VectorXd before = assembled_residual(contact, layout, tilted.scene.fields, dt);
  correct(contact, tilted.scene.fields);
  const std::optional<VectorXd> change = changed_residual(contact, layout, tilted.scene.fields);
  BOOST_REQUIRE(change.has_value());
  // Both surfaces are flat, so that the works of the present state differ from those of the tilted state by the angle.
  const VectorXd after = assembled_residual(contact, layout, tilted.scene.fields, dt);
  BOOST_TEST((before + *change - after).norm() < much * after.norm());
  BOOST_TEST(change->norm() > much * after.norm());
}

/// True if the linearisation is reused for a flat surface whose nodes are on a rigid body where `is_rigid` is true for
/// x, relative to the surface's length.
template <class IsRigid>
bool serves_flat(Side side, const IsRigid& is_rigid) {
  TiltedContact tilted;
  ContactInterface& contact = *tilted.contact;
  const auto x = tilted.flat[side].position.row(0);
  for (const double at : x)
    tilted.flat[side].rigid.body.push_back(is_rigid((at - x.minCoeff()) / (x.maxCoeff() - x.minCoeff())) ? 0 : -1);
  tilted.flat[side].rigid.poses = {{Vector3d::Zero(), Eigen::Quaterniond::Identity()}};
  tilted.tilt(much);
  contact.begin_iteration(tilted.scene.fields);
  has_matrix(contact, on_both_sides(true));
  tilted.tilt(0);
  return serves_again(contact, tilted.scene.fields);
}

BOOST_AUTO_TEST_CASE(nodes_that_close_beside_those_of_a_rigid_body_take_a_matrix_and_others_do_not) {
  for (const Side side : both_sides) {
    BOOST_TEST(serves_flat(side, [](double x) { return x < 0.1; }));   // nodes that are always closed
    BOOST_TEST(!serves_flat(side, [](double x) { return x > 0.9; }));  // nodes that close
  }
}

BOOST_AUTO_TEST_CASE(a_node_that_faced_nothing_is_added_as_it_is_linearised_where_it_closes) {
  TiltedContact tilted;
  ContactInterface& contact = *tilted.contact;
  const auto shift = [&](double by) {
    tilted.scene.fields = tilted.flat;
    tilted.scene.fields[Side::secondary].position.row(0).array() += by;
    contact.project(tilted.scene.position());
  };
  const auto x = tilted.flat[Side::secondary].position.row(0);
  shift(0.5 * (x.maxCoeff() - x.minCoeff()));
  contact.begin_iteration(tilted.scene.fields);
  has_matrix(contact, on_both_sides(true));
  const NodalLoads before = tilted.loads();
  shift(0);
  BOOST_TEST(serves_again(contact, tilted.scene.fields));
  correct(contact, tilted.scene.fields);
  NodalLoads there = contact.pass(0).space().averages(contact.pass(0).space().gaps(),
                                                      seen_from(Side::primary, tilted.scene.fields),
                                                      {tilted.loads().in_contact, tilted.loads().flux_coupled, {}});
  there.traction.setZero(there.area.size());
  const auto expected = linearise(contact.pass(0).space(), there, seen_from(Side::primary, tilted.scene.fields));
  Index faced_nothing = 0;
  tilted.held().add_loads(tilted.held().added(), dt, [&](const LoadBlock& load) {
    const int node = load.place.node;
    if (before.area[node] == 0) ++faced_nothing;
    BOOST_TEST((load.variation - expected[node].gap_variation).norm() < rounding);
    BOOST_TEST((load.work - expected[node].traction_work).norm() < rounding);
    BOOST_TEST(std::abs(load.factor - contact.pass(0).laws().traction_penalty(node)) < rounding * load.factor);
  });
  BOOST_TEST(faced_nothing > 0);
  BOOST_TEST(tilted.loads().traction.allFinite());
}

BOOST_AUTO_TEST_CASE(a_correction_of_a_pass_without_contact_adds_nothing_to_the_residual) {
  Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, -0.05, 3, 4), effects_of(false, 0),
              explicit_settings(3, 2, 5));
  const auto contact = scene.contact();
  contact->begin_iteration(scene.fields);
  has_matrix(*contact, on_both_sides(true));
  scene.fields[Side::secondary].position.row(2).array() += 0.001;
  contact->project(scene.position());
  correct(*contact, scene.fields);
  BOOST_TEST(residual_change(
      *contact, scene.fields, dt,
      [](const ContactInterface::Location& /*place*/, const VectorXd& /*values*/) { BOOST_TEST(false); }));
}

/// Otherwise, meshes that overlap at the start would cause a geometric stiffness of the size of the penalty times the
/// overlap.
BOOST_AUTO_TEST_CASE(the_geometric_part_of_a_steps_first_tangent_is_that_of_accepted_loads) {
  for_random_contacts(59, [](const Scene& scene, ContactInterface& contact) {
    const GlobalLayout layout(scene);
    contact.end_iterations();
    const auto first_tangent = [&] {
      contact.begin_iteration(scene.fields);
      contact.end_iterations();
      contact.begin_iteration(scene.fields);
      return assembled_tangent(contact, layout, scene.fields, dt);
    };
    const MatrixXd overlap_of_no_step = first_tangent();
    contact.accept_step(scene.fields);
    const MatrixXd of_accepted_step = first_tangent();
    contact.end_iterations();
    const MatrixXd exact = assembled_tangent(contact, layout, scene.fields, dt);
    BOOST_TEST(relative_error(of_accepted_step, exact) < rounding);
    BOOST_TEST(relative_error(overlap_of_no_step, exact) > 1e-3);
    contact.forget_steps();
    BOOST_TEST((first_tangent() == overlap_of_no_step));
  });
}

BOOST_AUTO_TEST_CASE(projecting_away_and_back_leaves_no_trace) {
  for_random_contacts(6, [](const Scene& scene, ContactInterface& contact) {
    const VectorXd first = answers(contact, scene);
    for (const Vector3d& shift : {Vector3d(0.1, 0.05, 0.3), Vector3d(0.4, 0, 0), Vector3d(0, 0, 100)}) {
      contact.project(moved(scene.position(), shift));
      contact.project(scene.position());
      BOOST_TEST((answers(contact, scene) == first));
    }
  });
}

BOOST_AUTO_TEST_CASE(keeping_the_facets_leaves_no_trace_either) {
  using Search = ContactInterface::Search;
  for_random_contacts(7, [](const Scene& scene, ContactInterface& contact) {
    const VectorXd first = answers(contact, scene);
    // Far away, no point hits its last facet; all points are paired again after the return.
    for (const double shift : {1e-3, 5.0}) {
      contact.project(moved(scene.position(), {shift, 0, 0}), Search::same_facets);
      contact.project(scene.position(), Search::same_facets);
      BOOST_TEST((answers(contact, scene) == first));
    }
  });
}

BOOST_AUTO_TEST_CASE(a_search_follows_a_projection_on_the_same_facets_at_the_same_place) {
  using Search = ContactInterface::Search;
  for_random_contacts(8, [](const Scene& scene, ContactInterface& contact) {
    const PerSide<Matrix3Xd> aside = moved(scene.position(), {-0.45, 0, 0});
    Scene there = scene;
    there.fields[Side::secondary].position = aside[Side::secondary];
    contact.project(aside);
    const VectorXd searched = answers(contact, there);
    contact.project(scene.position());
    contact.project(aside, Search::same_facets);
    BOOST_TEST((answers(contact, there) != searched));
    contact.project(aside);
    BOOST_TEST((answers(contact, there) == searched));
  });
}

BOOST_AUTO_TEST_CASE(a_stored_state_restores_a_contact) {
  for_random_contacts(9, [](const Scene& scene, ContactInterface& contact) {
    const auto fresh = scene.contact();
    BOOST_TEST((answers(*fresh, scene) != answers(contact, scene)));
    fresh->restore(contact.state());
    BOOST_TEST((answers(*fresh, scene) == answers(contact, scene)));
  });
}

BOOST_AUTO_TEST_CASE(a_state_that_does_not_fit_is_refused_and_changes_nothing) {
  for_random_contacts(3, [](const Scene& scene, ContactInterface& contact) {
    const auto before = answers(contact, scene);
    const ContactInterface::State sound = contact.state();
    const auto refused = [&](const auto& spoil) {
      ContactInterface::State state = sound;
      spoil(state);
      BOOST_CHECK_THROW(contact.restore(state), std::invalid_argument);
      BOOST_TEST((answers(contact, scene) == before));
    };
    refused([](auto& state) { state.multipliers.clear(); });
    refused([](auto& state) { state.multipliers.emplace_back(state.multipliers.front()); });
    refused([](auto& state) { state.check_nodes.push_back(0); });  // a second pass without its multipliers
    refused([&](auto& state) { state.check_nodes.push_back(scene.mesh[Side::secondary].nodes); });
    refused([](auto& state) { state.check_nodes.push_back(-1); });
    refused([](auto& state) { state.multipliers.front().traction.conservativeResize(1); });
    refused([](auto& state) { state.multipliers.front().flux.conservativeResize(Eigen::NoChange, 1); });
    refused([](auto& state) { state.multipliers.front().flux_penalty_scale.conservativeResize(7); });
  });
}

BOOST_AUTO_TEST_CASE(a_uniform_overlap_and_jump_have_exact_balance) {
  for (const auto& [one, two] : mixed_pairs) {
    for (const bool two_pass : {false, true}) {
      const Scene scene = uniform_scene(one, two, two_pass);
      const Balance total = output(*scene.contact(), scene.fields).balance;
      const double passes = two_pass ? 2 : 1;
      BOOST_TEST(std::abs(total.area - 1) <= rounding);
      BOOST_TEST((total.force - Vector3d(0, 0, -0.25 * passes)).norm() <= rounding);
      BOOST_TEST(std::abs(total.flow[0] - 0.5 * passes) <= rounding);
      BOOST_TEST(std::abs(total.flow[1] + 16 * passes) <= 16 * rounding);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_uniform_overlap_and_jump_have_exact_nodal_values) {
  for (const auto& [one, two] : mixed_pairs) {
    for (const bool two_pass : {false, true}) {
      const Scene scene = uniform_scene(one, two, two_pass);
      const auto contact = scene.contact();
      const double passes = two_pass ? 2 : 1;
      for (const Side side : both_sides) {
        const NodalOutput out = output(*contact, scene.fields).nodes[side];
        const double sign = side == Side::primary ? 1 : -1;
        BOOST_TEST((out.gap.array() + 0.0625).abs().maxCoeff() <= rounding);
        BOOST_TEST((out.pressure.array() - 0.25 * passes).abs().maxCoeff() <= rounding);
        BOOST_TEST((out.flux.row(0).array() - sign * 0.5 * passes).abs().maxCoeff() <= rounding);
        BOOST_TEST((out.flux.row(1).array() + sign * 16 * passes).abs().maxCoeff() <= 32 * rounding);
        BOOST_TEST((out.jump.row(0).array() - sign * 0.25).abs().maxCoeff() <= rounding);
        BOOST_TEST((out.jump.row(1).array() + sign * 2).abs().maxCoeff() <= 2 * rounding);
        BOOST_TEST(std::abs(out.tributary_area.sum() - 1) <= rounding);
        BOOST_TEST(out.tributary_area.minCoeff() > 0.0);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(two_passes_share_the_load) {
  // After the multipliers have taken over the load, each pass bears a half, and the nodal pressure is that of the sum.
  const Scene scene = uniform_scene(FacetType::quad4, FacetType::quad4, true);
  const auto contact = scene.contact();
  const GlobalLayout layout(scene);
  PerSide<VectorXd> force;
  contact->residual(scene.fields, dt, [&](const ContactInterface::Location& location, const VectorXd& values) {
    VectorXd& sum = force[location.first];
    if (sum.size() == 0) sum = VectorXd::Zero(layout.size());
    sum(layout.entries(location)) += values;
  });
  const VectorXd one = side_sum(layout, force[Side::primary], Side::primary);
  const VectorXd two = side_sum(layout, force[Side::secondary], Side::primary);
  BOOST_TEST((one - two).norm() <= rounding * one.norm());
  BOOST_TEST((one.head<3>() + two.head<3>() - output(*contact, scene.fields).balance.force).norm() <= rounding);
}

BOOST_AUTO_TEST_CASE(nothing_in_contact_gives_nothing) {
  for (const bool two_pass : {false, true}) {
    Scene scene = uniform_scene(FacetType::quad8, FacetType::tri3, two_pass);
    for (const double height : {0.3, 100.0}) {
      scene.fields[Side::secondary].position.row(2).setConstant(height);
      const auto contact = scene.contact();
      const VectorXd all = answers(*contact, scene);
      BOOST_TEST(all.norm() == 0.0);  // also fails for NaN
      contact->residual(scene.fields, dt, [](const auto&, const VectorXd&) { BOOST_TEST(false); });
      contact->tangent(scene.fields, dt, [](const auto&, const auto&, const MatrixXd&) { BOOST_TEST(false); });
      BOOST_TEST(output(*contact, scene.fields).balance.area == 0.0);
      contact->augment(scene.fields);
      BOOST_TEST(contact->pass(0).laws().multipliers.traction.norm() == 0.0);
      BOOST_TEST(is_converged(*contact, contact->gaps(scene.fields)));
    }
  }
}

BOOST_AUTO_TEST_CASE(all_nodes_of_facing_surfaces_are_in_contact) {
  for (const auto& [one, two] : mixed_pairs) {
    for (const bool two_pass : {false, true}) {
      const Scene scene = uniform_scene(one, two, two_pass);
      for (const Side side : both_sides) {
        const std::vector<bool> touched = touched_nodes(scene, side);
        BOOST_TEST(static_cast<int>(touched.size()) == scene.mesh[side].nodes);
        BOOST_TEST(std::count(touched.begin(), touched.end(), false) == 0);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(all_nodes_of_the_smaller_surface_are_in_contact_and_no_distant_ones_of_the_larger) {
  for (const auto& [one, two] : facet_pairs()) {
    for (const Side small : both_sides) {
      for (const bool two_pass : {false, true}) {
        for (const int cells : {1, 2, 5}) {
          const Scene scene = plates(one, two, small, two_pass, cells);
          for (const bool touched : touched_nodes(scene, small)) BOOST_TEST(touched);
          const std::vector<bool> touched = touched_nodes(scene, other(small));
          for (std::size_t node = 0; node < touched.size(); ++node) {
            const double away = distance_from_inner(scene.fields[other(small)].position.col(static_cast<Index>(node)));
            if (away < 1e-9) BOOST_TEST(touched[node]);
            if (away > 0.9) BOOST_TEST(!touched[node]);
          }
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(nodes_at_the_edge_of_tilted_surfaces_face_what_their_normals_miss) {
  // Both surfaces rise towards x = 1, as next to a plane of symmetry. The normals of nodes at x = 0 miss the edge of
  // the other surface by 0.01, a tenth of their distance and a twenty-fifth of a facet. The next row of nodes misses it
  // by more.
  for (const FacetType type : all_facets) {
    PerSide<Grid> grids = facing_grids(type, type, 0.1, 4, 6);
    grids[Side::secondary].low[0] = -0.5;
    grids[Side::secondary].cells_x = 9;
    Scene scene(grids, effects_of(true, 1), explicit_settings(4, 2, 8));
    for (SurfaceFields& side : scene.fields) side.position.row(2) += 0.1 * side.position.row(0);
    const std::vector<bool> touched = scene.contact()->nodes_in_contact()[Side::secondary];
    for (std::size_t node = 0; node < touched.size(); ++node) {
      const double x = scene.fields[Side::secondary].position(0, static_cast<Index>(node));
      if (x > -1e-9) BOOST_TEST(touched[node]);
      if (x < -0.05) BOOST_TEST(!touched[node]);
    }
  }
}

BOOST_AUTO_TEST_CASE(nodes_are_in_contact_up_to_the_rim_of_the_contact_zone) {
  for (const FacetType type : all_facets) {
    PerSide<Grid> grids = facing_grids(type, FacetType::quad4, 0.05);
    grids[Side::secondary].high[0] = 0.5;  // one of two columns of cells
    const Scene half(grids, effects_of(false, 0));
    const std::vector<bool> touched = touched_nodes(half, Side::primary);
    for (std::size_t node = 0; node < touched.size(); ++node) {
      BOOST_TEST(touched[node] == (half.fields[Side::primary].position(0, static_cast<Index>(node)) < 0.51));
    }
    grids[Side::secondary].z = 0.1;
    for (const bool open : touched_nodes(Scene(grids, effects_of(false, 0)), Side::primary)) BOOST_TEST(!open);
  }
}

BOOST_AUTO_TEST_CASE(with_two_passes_nodes_that_face_contact_are_in_contact_too) {
  Settings settings;
  settings.two_pass = true;
  Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, 0, 8, 1), effects_of(true, 0), settings);
  Matrix3Xd& x1 = scene.fields[Side::primary].position;  // a bump at the corner of a single facet
  const auto bump = (x1.row(0) + x1.row(1)).array() < 0.3;
  x1.row(2) = bump.select(Eigen::RowVectorXd::Constant(x1.cols(), 0.05), -0.2);
  const auto contact = scene.contact();
  BOOST_TEST(contact->pass(1).nodal_loads(seen_from(Side::secondary, scene.fields)).traction.norm() == 0.0);
  const std::vector<bool> touched = contact->nodes_in_contact()[Side::secondary];
  const Matrix3Xd& x2 = scene.fields[Side::secondary].position;
  for (std::size_t node = 0; node < touched.size(); ++node) {
    BOOST_TEST(touched[node] == (x2.col(static_cast<Index>(node)).norm() < 0.1));
  }
  contact->begin_iteration(scene.fields);
  BOOST_TEST((contact->hold_nodes_in_contact()[Side::secondary] == touched));
}

BOOST_AUTO_TEST_CASE(nodes_of_graded_facets_are_in_contact_where_a_facet_around_them_is) {
  // A narrow facet in contact is adjacent to a wide one that is not: the nodes between them are in contact.
  PerSide<Grid> grids = facing_grids(FacetType::quad4, FacetType::quad4, 0.05, 2, 1);
  grids[Side::secondary].high[0] = 0.5;
  Scene scene(grids, effects_of(false, 0));
  Matrix3Xd& x1 = scene.fields[Side::primary].position;
  for (Index node = 0; node < x1.cols(); ++node) {
    if (x1(0, node) > 0.9) x1(0, node) = 10;
  }
  const std::vector<bool> touched = touched_nodes(scene, Side::primary);
  for (std::size_t node = 0; node < touched.size(); ++node) {
    BOOST_TEST(touched[node] == (x1(0, static_cast<Index>(node)) < 1));
  }
}

BOOST_AUTO_TEST_CASE(overlapping_nodes_can_be_moved_onto_the_other_surface) {
  std::mt19937 random(10);
  Scene scene(facing_grids(FacetType::quad4, FacetType::quad8, 0), effects_of(false, 0));
  scene.fields[Side::primary].position.row(2).setConstant(0.0625);
  scene.fields[Side::primary].position(2, 4) = -0.25;
  const auto contact = scene.contact();
  const Matrix3Xd moved_nodes = without_overlap(*contact, scene.position());
  Matrix3Xd expected = scene.fields[Side::primary].position;
  BOOST_TEST(moved_nodes.row(2).maxCoeff() <= rounding);
  BOOST_TEST((moved_nodes.col(4) == expected.col(4)));  // unchanged
  Scene apart(facing_grids(FacetType::quad4, FacetType::quad8, -0.1), effects_of(false, 0));
  BOOST_TEST((without_overlap(*apart.contact(), apart.position()) == apart.fields[Side::primary].position));
}

BOOST_AUTO_TEST_CASE(overlapping_nodes_whose_normals_pass_an_edge_are_moved_onto_the_surface_beyond_it) {
  // Both surfaces rise towards x = 1, as next to a plane of symmetry: the primary normals there miss the edge of the
  // other surface.
  for (const FacetType type : all_facets) {
    Scene scene(facing_grids(type, type, 0.1, 4, 6), effects_of(false, 0));
    for (SurfaceFields& side : scene.fields) side.position.row(2) += 0.1 * side.position.row(0);
    const Matrix3Xd moved = without_overlap(*scene.contact(), scene.position());
    const Eigen::RowVectorXd above = moved.row(2) - 0.1 * moved.row(0) +
                                     Eigen::RowVectorXd::Constant(moved.cols(), 0.1);
    BOOST_TEST(above.cwiseAbs().maxCoeff() <= rounding);
  }
}

BOOST_AUTO_TEST_CASE(new_properties_change_the_automatic_penalties) {
  Scene scene = uniform_scene(FacetType::quad4, FacetType::quad4, true);
  scene.settings = Settings{};
  scene.settings.two_pass = true;
  const auto contact = scene.contact();
  PerSide<VectorXd> stiffness;
  PerSide<MatrixXd> conductance;
  for (const Side side : both_sides) {
    stiffness[side] = 2 * scene.mesh[side].stiffness;
    conductance[side] = 4 * scene.mesh[side].conductance;
  }
  const Penalties before = contact->pass(1).penalty();
  contact->update_properties(stiffness, conductance);
  BOOST_TEST((contact->pass(1).penalty().traction == 2 * before.traction));
  BOOST_TEST((contact->pass(1).penalty().flux == 4 * before.flux));
}

BOOST_AUTO_TEST_CASE(where_bodies_are_one_nothing_crosses_and_no_ambient_acts) {
  Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, 0.01), effects_of(true, 1), explicit_settings(4, 2, 8));
  PerSide<std::vector<int>> numbers;
  for (const Side side : both_sides) {
    for (int node = 0; node < scene.mesh[side].nodes; ++node)
      numbers[side].push_back(side == Side::primary ? node : node + 8);
  }
  find_joined_nodes(scene.mesh, numbers);  // the last primary node is the first secondary one
  const Index last = scene.mesh[Side::primary].nodes - 1;
  BOOST_TEST(scene.mesh[Side::primary].is_joined(last));
  BOOST_TEST(!scene.mesh[Side::primary].is_joined(0));
  BOOST_TEST(scene.mesh[Side::secondary].is_joined(0));
  const auto contact = scene.contact();
  contact->begin_iteration(scene.fields);
  const NodalLoads loads = contact->pass(0).nodal_loads(seen_from(Side::primary, scene.fields));
  BOOST_TEST(loads.in_contact[0]);
  BOOST_TEST(!loads.in_contact[last]);
  const PerSide<NodeFlags> without_ambient = contact->hold_nodes_in_contact();
  BOOST_TEST(without_ambient[Side::primary][last]);
  BOOST_TEST(without_ambient[Side::secondary][0]);
  numbers[Side::secondary] = std::vector<int>(numbers[Side::secondary].size(), 100);
  find_joined_nodes(scene.mesh, numbers);
  BOOST_TEST(scene.mesh[Side::primary].joined.empty());
}

BOOST_AUTO_TEST_CASE(joined_surfaces_have_no_pairs_until_a_node_is_free) {
  const Scene scene = uniform_scene(FacetType::quad4, FacetType::quad4, false);
  const auto contact = scene.contact();
  PerSide<NodeFlags> joined{
      {NodeFlags(scene.mesh[Side::primary].nodes, true), NodeFlags(scene.mesh[Side::secondary].nodes, true)}};
  join(*contact, joined);
  contact->project(scene.position());
  BOOST_TEST(contact->pass(0).pairs().empty());
  BOOST_TEST(contact->check_penetration(scene.fields).nodes == 0);
  joined[Side::primary][0] = false;
  join(*contact, joined);
  contact->project(scene.position(), ContactInterface::Search::same_facets);
  BOOST_TEST(!contact->pass(0).pairs().empty());
}
