#include "contact/enforcement/augmentation.h"

#include "surfaces.h"

#include <boost/test/unit_test.hpp>

using namespace test;

namespace {

constexpr Tolerances::Field off{0, 0};

/// Unit squares that overlap by 1/16 with a jump in the solvent and one solute.
Scene loaded_scene() {
  Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, 0.0625), effects_of(true, 1),
              explicit_settings(4, 2, 8));
  scene.set_field(0, 0.5, 0.25);
  scene.set_field(1, 1, 3);
  return scene;
}

/// The fields of a scene with the secondary surface raised.
PerSide<SurfaceFields> lifted(const Scene& scene, double height) {
  PerSide<SurfaceFields> fields = scene.fields;
  fields[Side::secondary].position.row(2).array() += height;
  return fields;
}

PerSide<Matrix3Xd> positions(const PerSide<SurfaceFields>& fields) {
  return {{fields[Side::primary].position, fields[Side::secondary].position}};
}

/// Two conductors in series for one solute, whose adjacent ends are the surfaces of a contact. Conductances are 3 and
/// 0.75, the area is 1, and the values at the far ends are 1 and 0; there is no storage.
struct Conductors {
  static constexpr double first = 3;
  static constexpr double second = 0.75;
  static constexpr double in_series_of_both = first * second / (first + second);

  Scene scene;
  std::unique_ptr<ContactInterface> contact;

  explicit Conductors(double penalty_over_conductance)
      : scene(facing_grids(FacetType::quad4, FacetType::quad4, 0.01), effects_of(false, 1)) {
    scene.mesh[Side::primary].conductance.setConstant(first);
    scene.mesh[Side::secondary].conductance.setConstant(second);
    scene.settings.solute = {false, penalty_over_conductance * in_series_of_both};
    scene.settings.tolerances = {off, off, {0, 1e-10}, {}};
    contact = scene.contact();
  }

  /// The flow through the contact with these values on its two sides.
  double flow(double one, double two) {
    scene.set_field(0, one, two);
    return output(*contact, scene.fields).balance.flow[0];
  }

  /// Finds the values at which the flows through contact and conductors are equal, from the flow at two states, which
  /// is linear in them.
  void solve() {
    const double start = flow(0, 0);
    const double slope = flow(1, 0) - start;
    const double jump = (1 - start / in_series_of_both) / (1 + slope / in_series_of_both);
    const double through = start + slope * jump;
    scene.set_field(0, 1 - through / first, through / second);
  }

  double jump() const { return contact->gaps(scene.fields).flux[0].largest; }
};

/// The scene in other units: lengths, pressures and concentrations (moles per volume) are multiplied by factors, times
/// are not.
Scene in_units(const Scene& scene, double length, double pressure, double concentration) {
  Scene scaled = scene;
  for (const Side side : both_sides) {
    scaled.fields[side].position *= length;
    scaled.fields[side].scalar.col(0) *= pressure;
    scaled.fields[side].scalar.col(1) *= concentration;
    scaled.mesh[side].stiffness *= pressure / length;
    scaled.mesh[side].conductance.row(0) *= length / pressure;
    scaled.mesh[side].conductance.row(1) *= length;
  }
  return scaled;
}

GapReport report_of(const Scene& scene) { return scene.contact()->gaps(scene.fields); }

void check_close(double value, double expected, double relative) {
  BOOST_TEST(std::abs(value - expected) <= relative * std::abs(expected));
}

}  // namespace

BOOST_AUTO_TEST_CASE(multipliers_take_over_the_load) {
  const Scene scene = loaded_scene();
  const auto contact = scene.contact();
  contact->augment(scene.fields);
  const Multipliers& state = contact->pass(0).laws().multipliers;
  BOOST_TEST((state.traction.array() + 0.25).abs().maxCoeff() <= rounding);
  BOOST_TEST((state.flux.row(0).array() - 0.5).abs().maxCoeff() <= rounding);
  BOOST_TEST((state.flux.row(1).array() + 16).abs().maxCoeff() <= 16 * rounding);
}

BOOST_AUTO_TEST_CASE(a_second_augmentation_adds_the_load_of_the_remaining_gap) {
  Scene scene = loaded_scene();
  scene.settings.tolerances = {off, off, off, {}};  // all errors meet the tolerances, so penalties do not grow
  const auto contact = scene.contact();
  contact->augment(scene.fields);
  contact->augment(scene.fields);
  BOOST_TEST((contact->pass(0).laws().multipliers.traction.array() + 0.5).abs().maxCoeff() <= rounding);
  BOOST_TEST((contact->pass(0).laws().multipliers.flux.row(0).array() - 1).abs().maxCoeff() <= rounding);
}

BOOST_AUTO_TEST_CASE(nodes_that_bear_load_in_a_solution_stay_in_contact_after_it_was_augmented) {
  Scene scene = loaded_scene();
  scene.settings.tolerances = {off, off, off, {}};
  const auto contact = scene.contact();
  contact->augment(scene.fields);
  // A third of the load remains at the overlap at which the penalty cancels the other two thirds; the next trials are
  // then tensile.
  const double load = contact->pass(0).laws().multipliers.traction[0];
  const double penalty = contact->pass(0).laws().traction_penalty(0);
  const double overlap = contact->pass(0).space().gaps().gap[0];
  const PerSide<SurfaceFields> relieved = lifted(scene, -overlap - load * 2 / 3 / penalty);
  contact->end_iterations();
  contact->project(positions(relieved));
  contact->begin_iteration(relieved);
  contact->augment(relieved);
  contact->end_iterations();
  contact->begin_iteration(relieved);
  const NodalLoads loads = contact->pass(0).nodal_loads(seen_from(Side::primary, relieved));
  BOOST_TEST(loads.traction.maxCoeff() > 0);
  BOOST_TEST(std::count(loads.flux_coupled.begin(), loads.flux_coupled.end(), true) ==
             contact->mesh(Side::primary).nodes);
  contact->end_iterations();
  contact->begin_iteration(relieved);
  BOOST_TEST(!any(contact->nodes_in_contact()[Side::primary]));
}

BOOST_AUTO_TEST_CASE(augmentations_leave_nodes_of_fixed_gap_out) {
  Scene scene = loaded_scene();
  scene.settings.traction.softens_fixed_gaps = true;
  scene.settings.tolerances = {{1e-6, 0}, off, off, {}};
  const auto contact = scene.contact();
  PerSide<NodeFlags> immovable;
  for (const Side side : both_sides) immovable[side] = NodeFlags(scene.mesh[side].nodes, side == Side::secondary);
  immovable[Side::primary][0] = true;
  set_immovable(*contact, immovable);
  const NodalLaws& laws = contact->pass(0).laws();
  const double soft = laws.traction_penalty(0);
  const double hard = laws.traction_penalty(1);
  BOOST_TEST(soft <= laws.penalties().stiffness[0]);
  BOOST_TEST(contact->augment(scene.fields));
  BOOST_TEST(laws.traction_penalty(0) == soft);
  BOOST_TEST(laws.traction_penalty(1) > hard);
  BOOST_TEST(laws.multipliers.traction[0] == 0.0);
  BOOST_TEST(laws.multipliers.traction[1] < 0.0);
  BOOST_TEST(contact->gaps(scene.fields).traction.largest > 0.0);
  immovable[Side::primary] = NodeFlags(scene.mesh[Side::primary].nodes, true);
  set_immovable(*contact, immovable);
  BOOST_TEST(laws.traction_penalty(0) == laws.traction_penalty(1));
}

BOOST_AUTO_TEST_CASE(points_out_of_contact_get_no_multiplier) {
  Scene scene = loaded_scene();
  const auto contact = scene.contact();
  contact->augment(scene.fields);
  const PerSide<SurfaceFields> open = lifted(scene, 0.2);
  contact->project(positions(open));
  contact->augment(open);
  BOOST_TEST(contact->pass(0).laws().multipliers.traction.norm() == 0.0);
  BOOST_TEST(contact->pass(0).laws().multipliers.flux.norm() == 0.0);
  const PerSide<SurfaceFields> gone = lifted(scene, 50);
  contact->pass(0).laws().multipliers.traction.setConstant(-1);
  contact->project(positions(gone));
  contact->augment(gone);
  BOOST_TEST(contact->pass(0).laws().multipliers.traction.norm() == 0.0);
}

BOOST_AUTO_TEST_CASE(a_point_that_opens_for_a_while_keeps_its_multiplier) {
  const Scene scene = loaded_scene();
  const auto contact = scene.contact();
  contact->augment(scene.fields);
  const GlobalLayout layout(scene);
  const Multipliers before = contact->pass(0).laws().multipliers;
  const VectorXd residual = assembled_residual(*contact, layout, scene.fields, 1);
  for (const double height : {0.2, 50.0}) {
    const PerSide<SurfaceFields> open = lifted(scene, height);
    contact->project(positions(open));
    BOOST_TEST(assembled_residual(*contact, layout, open, 1).norm() == 0.0);
    BOOST_TEST(contact->gaps(open).traction.largest == 0.0);
    contact->project(scene.position());
    BOOST_TEST((contact->pass(0).laws().multipliers.traction == before.traction));
    BOOST_TEST((contact->pass(0).laws().multipliers.flux == before.flux));
    BOOST_TEST((assembled_residual(*contact, layout, scene.fields, 1) == residual));
  }
}

BOOST_AUTO_TEST_CASE(a_field_that_is_not_exchanged_gets_no_multiplier) {
  Scene scene = loaded_scene();
  for (FieldMask& mask : scene.mesh[Side::secondary].permeable) mask = only(1);
  const auto contact = scene.contact();
  contact->augment(scene.fields);
  BOOST_TEST(contact->pass(0).laws().multipliers.flux.row(0).norm() == 0.0);
  BOOST_TEST(contact->pass(0).laws().multipliers.flux.row(1).norm() > 0.0);
  BOOST_TEST(contact->gaps(scene.fields).flux[0].largest == 0.0);
}

BOOST_AUTO_TEST_CASE(a_small_penalty_closes_a_jump_in_ten_augmentations) {
  Conductors conductors(1e-4);
  conductors.solve();
  BOOST_TEST(conductors.jump() > 0.99);
  int augmentations = 0;
  while (!is_converged(*conductors.contact, conductors.contact->gaps(conductors.scene.fields)) && augmentations < 20) {
    conductors.contact->augment(conductors.scene.fields);
    conductors.solve();
    ++augmentations;
  }
  BOOST_TEST_MESSAGE(augmentations << " augmentations to a jump of " << conductors.jump());
  BOOST_TEST(augmentations <= 10);
  BOOST_TEST(conductors.jump() <= 1e-10);
  check_close(output(*conductors.contact, conductors.scene.fields).balance.flow[0], Conductors::in_series_of_both,
              1e-9);
}

BOOST_AUTO_TEST_CASE(without_growth_the_same_penalty_would_need_a_hundred_thousand) {
  // Uzawa's method without larger penalties reduces the jump by k/(k + eps) per augmentation, where k is the
  // conductance of the bodies in series.
  Conductors conductors(1e-4);
  conductors.solve();
  for (int augmentation = 0; augmentation < 5; ++augmentation) {
    const double before = conductors.jump();
    conductors.contact->augment(conductors.scene.fields);
    conductors.contact->pass(0).laws().multipliers.flux_penalty_scale.setOnes();
    conductors.solve();
    // The solution loses digits in 1 + slope/k, where the slope 1e-4 k is a difference of flows of size 1.
    check_close(conductors.jump() / before, 1 / (1 + 1e-4), 1e-10);
  }
  BOOST_TEST(std::log(1e10) / std::log1p(1e-4) > 1e5);
}

BOOST_AUTO_TEST_CASE(growth_stops_at_the_accurate_penalty_and_never_shrinks) {
  Conductors conductors(1e-4);
  double& growth = conductors.contact->pass(0).laws().multipliers.flux_penalty_scale[0];
  double last = 1;
  for (int augmentation = 0; augmentation < 30; ++augmentation) {
    conductors.scene.set_field(0, 1, 0);  // a jump that never closes
    conductors.contact->augment(conductors.scene.fields);
    BOOST_TEST(growth >= last);
    last = growth;
  }
  const ContactPass& pass = conductors.contact->pass(0);
  check_close(growth * pass.penalty().flux(0, 0), default_flux_factor * pass.penalty().conductance(0, 0), rounding);
}

BOOST_AUTO_TEST_CASE(fields_that_meet_their_tolerance_keep_their_penalty) {
  Scene scene = loaded_scene();
  // Gap and solute exceed their tolerances, the solvent does not.
  scene.settings.tolerances = {{0, 1e-3}, {0, 1}, {0, 1e-3}, {}};
  const auto contact = scene.contact();
  contact->augment(scene.fields);
  BOOST_TEST(contact->pass(0).laws().multipliers.traction_penalty_scale == 10.0);
  BOOST_TEST(contact->pass(0).laws().multipliers.flux_penalty_scale[0] == 1.0);
  BOOST_TEST(contact->pass(0).laws().multipliers.flux_penalty_scale[1] == 10.0);
}

BOOST_AUTO_TEST_CASE(impermeable_facets_do_not_keep_the_others_from_growing) {
  Scene scene = loaded_scene();
  scene.settings = Settings{};
  scene.settings.solute = {true, 1e-4};
  scene.settings.tolerances.solute = {0, 1e-3};  // a jump of 2 that never closes
  scene.mesh[Side::primary].conductance(1, 0) = 0;
  const auto contact = scene.contact();
  contact->augment(scene.fields);
  BOOST_TEST(contact->pass(0).laws().multipliers.flux_penalty_scale[1] == 10.0);
  for (int augmentation = 0; augmentation < 30; ++augmentation) contact->augment(scene.fields);
  // The factor on all penalties of the field grows until the smallest penalty is accurate.
  const Penalties& penalty = contact->pass(0).penalty();
  const Eigen::ArrayXd flux = penalty.flux.row(1);
  const double smallest = (flux > 0).select(flux, flux.maxCoeff()).minCoeff();
  const double accurate = default_flux_factor * penalty.conductance.row(1).maxCoeff();
  check_close(contact->pass(0).laws().multipliers.flux_penalty_scale[1] * smallest, accurate, rounding);
}

BOOST_AUTO_TEST_CASE(gaps_are_measured_against_the_drop_across_the_adjoining_elements) {
  // In penalty mode, a load eps g over the stiffness k shortens the elements by eps g/k; the relative gap is k/eps.
  Scene scene = loaded_scene();
  for (const Side side : both_sides) {
    scene.mesh[side].stiffness.setConstant(0.5);
    scene.mesh[side].conductance.row(0).setConstant(3);
    scene.mesh[side].conductance.row(1).setConstant(16);
  }
  const GapReport report = report_of(scene);
  check_close(report.traction.relative, 0.5 / 4, rounding);
  check_close(report.traction.largest, 0.0625, rounding);
  check_close(report.flux[0].relative, 3.0 / 2, rounding);
  check_close(report.flux[0].largest, 0.25, rounding);
  check_close(report.flux[1].relative, 16.0 / 8, rounding);
  check_close(report.flux[1].largest, 2, rounding);
}

BOOST_AUTO_TEST_CASE(relative_gaps_do_not_depend_on_the_units) {
  std::mt19937 random(1);
  Scene scene(facing_grids(FacetType::quad4, FacetType::tri3, 0.1), effects_of(true, 1));
  scene.disturb(0.02, random);
  const GapReport reference = report_of(scene);
  for (const double length : {1e3, 1e-6}) {
    for (const double pressure : {1e3, 1e-6}) {
      for (const double concentration : {1e3, 1e-6}) {
        const GapReport report = report_of(in_units(scene, length, pressure, concentration));
        // Gaps of 0.05 to 0.15 are differences of coordinates of size 1 and have one or two digits less.
        constexpr double tolerance = 20 * rounding;
        check_close(report.traction.relative, reference.traction.relative, tolerance);
        check_close(report.flux[0].relative, reference.flux[0].relative, tolerance);
        check_close(report.flux[1].relative, reference.flux[1].relative, tolerance);
        check_close(report.traction.largest, length * reference.traction.largest, tolerance);
        check_close(report.flux[0].largest, pressure * reference.flux[0].largest, tolerance);
        check_close(report.flux[1].largest, concentration * reference.flux[1].largest, tolerance);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(no_gap_and_no_load_is_a_gap_of_zero) {
  for (const double value : {0.0, 0.3, 1e6}) {
    Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, 0), effects_of(true, 1));
    scene.set_field(0, value, value);
    scene.set_field(1, value, value);
    const auto contact = scene.contact();
    const GapReport report = contact->gaps(scene.fields);
    BOOST_TEST(report.traction.relative == 0.0);
    BOOST_TEST(report.traction.largest == 0.0);
    for (const FieldGap& gap : report.flux) BOOST_TEST(gap.relative <= scene.settings.tolerances.solute.relative);
    for (const FieldGap& gap : report.flux) BOOST_TEST(gap.largest <= rounding * value);
    BOOST_TEST(is_converged(*contact, report));
  }
}

BOOST_AUTO_TEST_CASE(a_gap_of_zero_with_a_multiplier_is_no_gap) {
  Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, 0), effects_of(true, 1));
  const auto contact = scene.contact();
  contact->pass(0).laws().multipliers.traction.setConstant(-2);
  contact->pass(0).laws().multipliers.flux.setConstant(3);
  const GapReport report = contact->gaps(scene.fields);
  BOOST_TEST(report.traction.relative == 0.0);
  for (const FieldGap& gap : report.flux) BOOST_TEST(gap.relative == 0.0);
}

BOOST_AUTO_TEST_CASE(nothing_in_contact_is_converged) {
  const Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, -0.5), effects_of(true, 1));
  const GapReport report = report_of(scene);
  BOOST_TEST(report.flux.size() == 2U);
  BOOST_TEST(report.traction.relative == 0.0);
  for (const FieldGap& gap : report.flux) BOOST_TEST(gap.relative == 0.0);
  BOOST_TEST(meets(report, scene.settings.tolerances, scene.effects));
}

BOOST_AUTO_TEST_CASE(each_tolerance_guards_its_own_field) {
  const Effects effects = effects_of(true, 1);
  const GapReport report{{0.1, 1}, {{0.2, 2}, {0.3, 3}}, {}};
  BOOST_TEST(meets(report, {off, off, off, {}}, effects));
  BOOST_TEST(meets(report, {{0.1, 1}, {0.2, 2}, {0.3, 3}, {}}, effects));
  BOOST_TEST(!meets(report, {{0.09, 0}, off, off, {}}, effects));
  BOOST_TEST(!meets(report, {{0, 0.9}, off, off, {}}, effects));
  BOOST_TEST(!meets(report, {off, {0.19, 0}, off, {}}, effects));
  BOOST_TEST(!meets(report, {off, {0, 1.9}, off, {}}, effects));
  BOOST_TEST(!meets(report, {off, off, {0.29, 0}, {}}, effects));
  BOOST_TEST(!meets(report, {off, off, {0, 2.9}, {}}, effects));
  // Without a solvent, both fields are solutes.
  BOOST_TEST(meets(report, {off, {0, 0.1}, {0, 3}, {}}, effects_of(false, 2)));
  BOOST_TEST(!meets(report, {off, off, {0, 1.9}, {}}, effects_of(false, 2)));
}

BOOST_AUTO_TEST_CASE(a_gap_that_is_not_a_number_is_never_converged) {
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  BOOST_TEST(!meets({{not_a_number, 0}, {}, {}}, {{1e-3, 0}, off, off, {}}, effects_of(false, 0)));
  BOOST_TEST(!meets({{0, 0}, {{0, not_a_number}}, {}}, {off, off, {0, 1}, {}}, effects_of(false, 1)));
}

BOOST_AUTO_TEST_CASE(fields_that_are_not_numbers_are_never_converged) {
  for (const bool two_pass : {false, true}) {
    Scene scene = loaded_scene();
    scene.settings.two_pass = two_pass;
    scene.fields[Side::primary].scalar(0, 1) = std::numeric_limits<double>::quiet_NaN();
    const auto contact = scene.contact();
    const GapReport report = contact->gaps(scene.fields);
    BOOST_TEST(std::isnan(report.flux[1].relative));
    BOOST_TEST(std::isnan(report.flux[1].largest));
    BOOST_TEST(std::isfinite(report.flux[0].relative));
    BOOST_TEST(!is_converged(*contact, report));
  }
}

BOOST_AUTO_TEST_CASE(surfaces_that_touch_without_a_load_are_converged) {
  const Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, -1e-11), effects_of(false, 0));
  const GapReport report = report_of(scene);
  BOOST_TEST(report.traction.relative == 0.0);
  BOOST_TEST(report.traction.largest == 0.0);
}

BOOST_AUTO_TEST_CASE(a_pressure_that_nothing_drives_is_converged_at_any_tolerance) {
  // The remaining values of a pressure that is zero: noise of the size of rounding, as large as its jumps.
  for (const Enforcement enforcement : {Enforcement::augmented_lagrangian, Enforcement::lagrange_multipliers}) {
    Scene scene = loaded_scene();
    scene.settings.enforcement = enforcement;
    scene.settings.tolerances = {off, {1e-8, 0}, off, {}};
    scene.set_field(0, 3e-17, -2e-17);
    const auto contact = scene.contact();
    contact->begin_iteration(scene.fields);
    BOOST_TEST(is_converged(*contact, contact->gaps(scene.fields)));
    scene.set_field(0, -1e-17, 4e-17);
    BOOST_TEST(contact->is_solution(scene.fields));
    scene.set_field(0, 3e-9, -2e-9);  // larger than rounding
    BOOST_TEST(!is_converged(*contact, contact->gaps(scene.fields)));
  }
}

BOOST_AUTO_TEST_CASE(gaps_between_rigid_bodies_are_measured_against_the_penalty) {
  Scene scene = loaded_scene();
  for (const Side side : both_sides) scene.mesh[side].stiffness.setConstant(std::numeric_limits<double>::infinity());
  const auto contact = scene.contact();
  check_close(contact->gaps(scene.fields).traction.relative, 1, rounding);
  contact->augment(scene.fields);
  contact->pass(0).laws().multipliers.traction_penalty_scale = 1;
  check_close(contact->gaps(scene.fields).traction.relative, 0.5, rounding);  // the load has doubled
}

BOOST_AUTO_TEST_CASE(augmentations_do_not_grow_a_reduced_penalty_back) {
  for (const double reduction : {1.0, 100.0}) {
    Scene scene = loaded_scene();
    scene.settings.traction = {true, default_traction_factor};
    scene.settings.reduced_traction.divisor = reduction;
    scene.settings.tolerances = {{1e-12, 0}, off, off, {}};
    const auto contact = scene.contact();
    contact->augment(scene.fields);
    BOOST_TEST(contact->pass(0).laws().multipliers.traction_penalty_scale == 1);
  }
}

BOOST_AUTO_TEST_CASE(augmentations_grow_penalties_to_the_default_of_one_pass_or_of_two) {
  for (const bool two_pass : {false, true}) {
    Scene scene = loaded_scene();
    scene.settings.two_pass = two_pass;
    scene.settings.traction = scene.settings.solvent = scene.settings.solute = {true, 1};
    scene.settings.tolerances = {{1e-15, 0}, {1e-15, 0}, {1e-15, 0}, {}};
    const auto contact = scene.contact();
    for (int n = 0; n < 8; ++n) contact->augment(scene.fields);
    for (std::size_t pass = 0; pass < contact->passes(); ++pass) {
      const Multipliers& state = contact->pass(pass).laws().multipliers;
      BOOST_TEST(state.traction_penalty_scale == (two_pass ? two_pass_traction_factor : default_traction_factor));
      for (const double scale : state.flux_penalty_scale)
        BOOST_TEST(scale == (two_pass ? two_pass_flux_factor : default_flux_factor));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_penalty_grows_to_what_meets_the_relative_tolerance_without_multipliers) {
  Scene scene = loaded_scene();
  scene.settings.traction = scene.settings.solvent = scene.settings.solute = {true, 0.25};
  scene.settings.tolerances = {{0.2, 0}, {0.05, 0}, {0.2, 1e-15}, {}};
  const auto contact = scene.contact();
  BOOST_TEST(contact->augment(scene.fields));
  for (int n = 0; n < 8; ++n) contact->augment(scene.fields);
  BOOST_TEST(!contact->augment(scene.fields));
  const Multipliers& state = contact->pass(0).laws().multipliers;
  check_close(0.25 * state.traction_penalty_scale, 1 / 0.2, rounding);
  check_close(0.25 * state.flux_penalty_scale[0], 1 / 0.05, rounding);
  // A largest jump, which has a unit, does not limit the multiple.
  check_close(0.25 * state.flux_penalty_scale[1], default_flux_factor, rounding);
}

BOOST_AUTO_TEST_CASE(what_slips_along_the_normal_of_a_node_is_no_slip_of_one_that_sticks) {
  Effects effects = effects_of(false, 0);
  effects.friction_kind = FrictionKind::on_traction;
  Settings settings = explicit_settings(4, 2, 8);
  settings.friction.coefficient = 10;
  const Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, 0.0625), effects, settings);
  const auto contact = scene.contact();
  const FacingFields fields{scene.fields[Side::primary], scene.fields[Side::secondary]};
  const ContactPass& pass = contact->pass(0);
  NodalLoads loads = pass.nodal_loads(fields);
  loads.friction.traction.row(0).setConstant(1e-3);
  loads.friction.slip.row(2).setConstant(0.1);  // the surfaces are in the plane z = 0
  BOOST_TEST(measure_gaps(pass.laws(), loads, fields).slip.front().largest <= rounding);
  loads.friction.slip.row(1).setConstant(0.1);
  check_close(measure_gaps(pass.laws(), loads, fields).slip.front().largest, 0.1, rounding);
}

/// A contact with an accepted step, and its tractions at the start of a step with a reduced penalty.
struct Accepted {
  Scene scene = loaded_scene();
  std::unique_ptr<ContactInterface> contact;
  VectorXd traction;

  Accepted() {
    scene.settings.traction = {true, default_traction_factor};
    contact = scene.contact();
    contact->begin_iteration(scene.fields);
    traction = present();
    contact->accept_step(scene.fields);
  }
  const ContactPass& pass() const { return contact->pass(0); }
  VectorXd present() const {
    return pass().nodal_loads({scene.fields[Side::primary], scene.fields[Side::secondary]}).traction;
  }
  VectorXd with(const ReducedPenalty& reduction) {
    scene.settings.reduced_traction = reduction;
    contact->update_laws(scene.settings);
    contact->end_iterations();
    contact->begin_iteration(scene.fields);
    return present();
  }
};

BOOST_AUTO_TEST_CASE(a_reduced_penalty_keeps_the_loads_of_the_accepted_state) {
  Accepted accepted;
  const Penalties& penalty = accepted.pass().penalty();
  for (const double divisor : {10.0, 1000.0, 1000.0, 100.0}) {
    BOOST_TEST((accepted.with({divisor}) - accepted.traction).norm() <= rounding * accepted.traction.norm());
    check_close(divisor * penalty.traction[0], default_traction_factor * penalty.stiffness[0], rounding);
  }
  accepted.scene.settings.reduced_traction = {};
  accepted.contact->update_laws(accepted.scene.settings);
  BOOST_TEST(accepted.pass().laws().multipliers.traction.norm() == 0);
}

BOOST_AUTO_TEST_CASE(loads_that_a_reduced_penalty_does_not_bear_fade) {
  constexpr double divisor = 10;
  Accepted accepted;
  for (const double kept : {1.0, 0.25, 0.0}) {
    // The gaps are those under the full penalty.
    const VectorXd expected = (kept + (1 - kept) / divisor) * accepted.traction;
    BOOST_TEST((accepted.with({divisor, kept}) - expected).norm() <= rounding * accepted.traction.norm());
  }
}
