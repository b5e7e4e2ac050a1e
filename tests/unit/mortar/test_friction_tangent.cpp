#include "surfaces.h"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

using namespace test;

namespace {

/// Properties of a sliding contact.
struct Sliders {
  double coefficient;  ///< large: every node sticks
  bool solvent;        ///< both sides exchange the solvent
  bool fluid;          ///< friction depends on the fluid pressure
  double contact_fraction = 0.2;
  Integration integration = Integration::gauss;
  bool two_pass = false;
};

Scene sliding_scene(FacetType one, FacetType two, const Sliders& sliding, int cells_two = 2) {
  Effects effects = effects_of(sliding.solvent, sliding.solvent ? 1 : 0);
  effects.friction_kind = sliding.fluid ? FrictionKind::on_solid_part : FrictionKind::on_traction;
  Settings settings = explicit_settings(2.5, 1.5, 0.8);
  settings.integration = sliding.integration;
  settings.two_pass = sliding.two_pass;
  settings.friction.coefficient = sliding.coefficient;
  settings.friction.contact_fraction = sliding.contact_fraction;
  settings.friction.ambient_pressure = 0.1;
  settings.friction.penalty_factor = 0.7;
  return {facing_grids(one, two, 0.08, 1, cells_two), effects, settings};
}

void turn_all(Scene& scene, double angle, const Vector3d& axis) {
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  for (SurfaceFields& field : scene.fields) field.position = (rotation * field.position).eval();
}

/// A contact whose bodies have rotated and slid along each other since the start of the step.
struct SlidingStep {
  Scene scene;
  std::unique_ptr<ContactInterface> contact;

  SlidingStep(Scene given, std::mt19937& random) : scene(std::move(given)) {
    scene.disturb(0.02, random);
    contact = scene.contact();
    for (std::size_t pass = 0; pass < contact->passes(); ++pass) {
      Matrix3Xd& lambda = contact->pass(pass).laws().multipliers.friction;
      lambda = Matrix3Xd::NullaryExpr(3, lambda.cols(), [&] { return 0.03 * random_vector(1, random)[0]; });
      contact->pass(pass).laws().multipliers.slips = NodeFlags(lambda.cols(), scene.settings.friction.coefficient < 1);
    }
    scene.disturb(0.02, random);
    for (SurfaceFields& field : scene.fields) field.scalar *= 0.1;
    scene.fields[Side::primary].position.row(0).array() += 0.04;
    scene.fields[Side::primary].position.row(1).array() -= 0.03;
    turn_all(scene, 0.4, Vector3d(1, -0.5, 0.3));
    contact->project(scene.position());
    accept_any_load(*contact);
    contact->begin_iteration(scene.fields);
  }

  NodeFlags slips() const {
    return contact->pass(0).nodal_loads({scene.fields[Side::primary], scene.fields[Side::secondary]}).slips;
  }
  VectorXd residual(const GlobalLayout& layout, const VectorXd& at) const {
    const PerSide<SurfaceFields> fields = layout.unpack(at);
    contact->project({{fields[Side::primary].position, fields[Side::secondary].position}});
    return assembled_residual(*contact, layout, fields, 0.3);
  }
};

/// Relative error of the part of the tangent that a frictionless contact does not have. The much larger rest of the
/// tangent would hide this error.
double tangent_error(const SlidingStep& step) {
  const GlobalLayout layout(step.scene);
  const VectorXd q = layout.pack(step.scene.fields);
  const MatrixXd approximate = differences([&](const VectorXd& at) { return step.residual(layout, at); }, q);
  step.contact->project(step.scene.position());
  const MatrixXd exact = assembled_tangent(*step.contact, layout, step.scene.fields, 0.3);
  return (exact - approximate).norm() / exact.norm();
}

/// The facets of both sides on which the points are, pair by pair.
std::vector<std::array<Index, 3>> pairing(const ContactInterface& contact) {
  std::vector<std::array<Index, 3>> found;
  for (const FacetPair& pair : contact.pass(0).space().facing().pairs())
    found.push_back({pair.primary, pair.secondary, pair.points});
  return found;
}

/// True if all points stay on the same facets in all differences. The residual jumps, and has no derivative, where a
/// point crosses an edge.
bool is_smooth(const SlidingStep& step) {
  const GlobalLayout layout(step.scene);
  const VectorXd q = layout.pack(step.scene.fields);
  const auto at = [&](Index entry, double change) {
    const PerSide<SurfaceFields> fields = layout.unpack(q + change * VectorXd::Unit(q.size(), entry));
    step.contact->project({{fields[Side::primary].position, fields[Side::secondary].position}});
    return pairing(*step.contact);
  };
  const auto here = at(0, 0);
  bool smooth = true;
  for (Index entry = 0; entry < q.size() && smooth; ++entry)
    smooth = at(entry, difference_step) == here && at(entry, -difference_step) == here;
  step.contact->project(step.scene.position());
  return smooth;
}

/// The first smooth one of random steps.
SlidingStep smooth_step(const std::function<Scene()>& scene, std::mt19937& random) {
  for (;;) {
    SlidingStep step(scene(), random);
    if (is_smooth(step)) return step;
  }
}

/// The mean normal of the first node in contact.
Vector3d normal_of_first_node(const SlidingStep& step) {
  const NodalLoads loads = step.contact->pass(0).nodal_loads(
      {step.scene.fields[Side::primary], step.scene.fields[Side::secondary]});
  const auto first = std::find(loads.in_contact.begin(), loads.in_contact.end(), true) - loads.in_contact.begin();
  return loads.friction.normal(first);
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_tangent_matches_differences_in_stick_and_slip_for_every_pair_of_meshes) {
  std::mt19937 random(7);
  double worst = 0;
  for (const auto& [one, two] : facet_pairs()) {
    for (const double coefficient : {10.0, 0.2}) {
      const bool solvent = one == two;
      const SlidingStep step = smooth_step(
          [&, one = one, two = two] { return sliding_scene(one, two, {coefficient, solvent, true}, 1); }, random);
      const NodeFlags slips = step.slips();
      const auto sliding = std::count(slips.begin(), slips.end(), true);
      if (coefficient > 1) BOOST_TEST(sliding == 0);
      if (coefficient < 1) BOOST_TEST(sliding > 0);
      worst = std::max(worst, tangent_error(step));
    }
  }
  BOOST_TEST_MESSAGE("largest relative difference " << worst);
  BOOST_TEST(worst <= 1e-7);
}

BOOST_AUTO_TEST_CASE(the_tangent_matches_differences_without_fluid_on_segments_and_in_two_passes) {
  std::mt19937 random(8);
  for (const bool two_pass : {false, true}) {
    for (const Integration integration : {Integration::gauss, Integration::segments}) {
      for (const bool fluid : {false, true}) {
        const Sliders sliding{0.2, false, fluid, 0.2, integration, two_pass};
        const SlidingStep step(sliding_scene(FacetType::quad4, FacetType::tri3, sliding, 1), random);
        BOOST_TEST(tangent_error(step) <= 1e-7);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(the_tangent_matches_differences_where_points_on_segments_count_as_fixed) {
  std::mt19937 random(14);
  for (const Side dry : both_sides) {
    for (const double coefficient : {10.0, 0.2}) {
      Scene scene = sliding_scene(FacetType::tri3, FacetType::tri3,
                                  {coefficient, false, true, 0.2, Integration::segments}, 3);
      Matrix3Xd& x2 = scene.fields[Side::secondary].position;
      x2.topRows<2>() = (2 * x2.topRows<2>().array() - 0.5).matrix();
      for (FieldMask& mask : scene.mesh[dry].permeable) mask = 0;
      const SlidingStep step(std::move(scene), random);
      for (const FacetPair& pair : step.contact->pass(0).space().facing().pairs()) BOOST_TEST(pair.unbroken);
      BOOST_TEST(tangent_error(step) <= 1e-7);
    }
  }
}

/// Only one side has fluid: its pressure is not an exchanged field, but friction depends on it.
BOOST_AUTO_TEST_CASE(the_pressure_of_the_side_that_has_fluid_acts_on_friction) {
  std::mt19937 random(9);
  for (const Side side : both_sides) {
    Scene scene = sliding_scene(FacetType::quad4, FacetType::quad4, {0.2, false, true});
    for (FieldMask& mask : scene.mesh[other(side)].permeable) mask = 0;
    const SlidingStep step(std::move(scene), random);
    BOOST_TEST(tangent_error(step) <= 1e-7);
    const GlobalLayout layout(step.scene);
    const MatrixXd tangent = assembled_tangent(*step.contact, layout, step.scene.fields, 0.3);
    for (const Side columns : both_sides) {
      double size = 0;
      for (Index node = 0; node < layout.nodes[columns]; ++node)
        size += tangent.col(layout.entry(columns, node, 3)).norm();
      BOOST_TEST((size > 0) == (columns == side));
    }
  }
}

BOOST_AUTO_TEST_CASE(what_does_not_depend_on_the_fluid_has_no_column_of_it) {
  std::mt19937 random(10);
  const SlidingStep step(sliding_scene(FacetType::quad4, FacetType::quad4, {0.2, false, false}), random);
  step.contact->for_each_coupling(
      [](const ContactInterface::Location& at) { BOOST_TEST(at.patch.fields.size() == 0u); });
  // The solid bears the whole load: the derivative with respect to the pressure is zero, and there is no block for it.
  const SlidingStep dry(sliding_scene(FacetType::quad4, FacetType::quad4, {0.2, false, true, 1.0}), random);
  using Location = ContactInterface::Location;
  dry.contact->tangent(dry.scene.fields, 0.3, [](const Location& /*rows*/, const Location& columns, const MatrixXd&) {
    BOOST_TEST(columns.patch.fields.size() == 0u);
  });
}

BOOST_AUTO_TEST_CASE(every_block_of_the_tangent_is_in_the_profile) {
  std::mt19937 random(11);
  for (const bool solvent : {false, true}) {
    const SlidingStep step(sliding_scene(FacetType::quad4, FacetType::tri3, {0.2, solvent, true}), random);
    const GlobalLayout layout(step.scene);
    MatrixXd profile = MatrixXd::Zero(layout.size(), layout.size());
    step.contact->for_each_coupling([&](const ContactInterface::Location& at) {
      const std::vector<Index> entries = layout.entries(at);
      profile(entries, entries).setOnes();
    });
    const MatrixXd tangent = assembled_tangent(*step.contact, layout, step.scene.fields, 0.3);
    BOOST_TEST((profile.array() == 0).select(tangent, 0.0).norm() == 0.0);
    BOOST_TEST(tangent.norm() > 0.0);
  }
}

BOOST_AUTO_TEST_CASE(friction_of_both_sides_cancels) {
  std::mt19937 random(12);
  for (const bool two_pass : {false, true}) {
    Sliders sliding{0.2, false, true};
    sliding.two_pass = two_pass;
    const SlidingStep step(sliding_scene(FacetType::quad8, FacetType::tri6, sliding), random);
    const GlobalLayout layout(step.scene);
    const VectorXd residual = assembled_residual(*step.contact, layout, step.scene.fields, 0.3);
    PerSide<Vector3d> force{{Vector3d(0, 0, 0), Vector3d(0, 0, 0)}};
    for (const Side side : both_sides) {
      for (Index node = 0; node < layout.nodes[side]; ++node)
        force[side] += residual.segment<3>(layout.entry(side, node, 0));
    }
    BOOST_TEST(force[Side::primary].norm() > 1e-3);
    BOOST_TEST((force[Side::primary] + force[Side::secondary]).norm() <= 1e-12 * force[Side::primary].norm());
  }
}

BOOST_AUTO_TEST_CASE(slip_has_the_size_of_the_bound_and_points_against_the_slip) {
  std::mt19937 random(13);
  Scene scene = sliding_scene(FacetType::quad4, FacetType::quad4, {0.2, false, true});
  const SlidingStep step(std::move(scene), random);
  step.contact->pass(0).laws().multipliers.friction.setZero();
  step.contact->end_iterations();
  step.contact->begin_iteration(step.scene.fields);
  const NodalLoads loads = step.contact->pass(0).nodal_loads(
      {step.scene.fields[Side::primary], step.scene.fields[Side::secondary]});
  int sliding = 0;
  for (Index node = 0; node < loads.gap.size(); ++node) {
    if (!loads.in_contact[node] || !loads.slips[node]) continue;
    ++sliding;
    const Vector3d traction = loads.friction.traction.col(node);
    BOOST_TEST(std::abs(traction.norm() - loads.friction.bound[node]) <= 1e-10 * loads.friction.bound[node]);
    const Vector3d n = loads.friction.normal(node);
    const Vector3d carried = loads.friction.convection[node] * loads.friction.slip.col(node);
    const Vector3d slip = carried - n * n.dot(carried);
    BOOST_TEST(std::abs(traction.dot(n)) <= rounding * traction.norm());
    BOOST_TEST(traction.dot(slip) < 0.0);
    BOOST_TEST(traction.cross(slip).norm() <= 1e-8 * traction.norm() * slip.norm());
  }
  BOOST_TEST(sliding > 0);
}

/// Both bodies rotate together by 90 degrees about an axis: there is no slip, and friction rotates with them.
BOOST_AUTO_TEST_CASE(friction_turns_with_both_bodies) {
  std::mt19937 random(14);
  for (const Integration integration : {Integration::gauss, Integration::segments}) {
    for (const Vector3d& axis : {Vector3d(0, 0, 1), Vector3d(1, 0, 0), Vector3d(1, 2, -1)}) {
      Scene scene = sliding_scene(FacetType::quad4, FacetType::quad4, {10, false, false, 0.2, integration});
      scene.disturb(0.02, random);
      const auto contact = scene.contact();
      const NodalLoads start = contact->pass(0).nodal_loads(
          {scene.fields[Side::primary], scene.fields[Side::secondary]});
      Matrix3Xd& lambda = contact->pass(0).laws().multipliers.friction;
      for (Index node = 0; node < lambda.cols(); ++node)
        lambda.col(node) = start.friction.normal(node).cross(random_vector(0.03, random));
      contact->project(scene.position());
      const NodalLoads before = contact->pass(0).nodal_loads(
          {scene.fields[Side::primary], scene.fields[Side::secondary]});
      turn_all(scene, 0.5 * 3.14159265358979, axis);
      contact->project(scene.position());
      const NodalLoads after = contact->pass(0).nodal_loads(
          {scene.fields[Side::primary], scene.fields[Side::secondary]});
      const Eigen::Matrix3d rotation = Eigen::AngleAxisd(0.5 * 3.14159265358979, axis.normalized()).toRotationMatrix();
      BOOST_TEST(after.friction.slip.cwiseAbs().maxCoeff() <= 1e-12);
      BOOST_TEST(before.friction.traction.norm() > 1e-3);
      BOOST_TEST((after.friction.traction - rotation * before.friction.traction).norm() <= 1e-12);
    }
  }
}

/// The next step begins with the friction of an accepted step.
BOOST_AUTO_TEST_CASE(an_accepted_step_keeps_its_friction_and_measures_slip_anew) {
  std::mt19937 random(15);
  for (const double coefficient : {10.0, 0.2}) {
    const SlidingStep step(sliding_scene(FacetType::quad4, FacetType::tri3, {coefficient, false, true}), random);
    const FacingFields fields{step.scene.fields[Side::primary], step.scene.fields[Side::secondary]};
    const NodalLoads before = step.contact->pass(0).nodal_loads(fields);
    step.contact->accept_step(step.scene.fields);
    step.contact->begin_iteration(step.scene.fields);
    const NodalLoads after = step.contact->pass(0).nodal_loads(fields);
    BOOST_TEST(after.friction.slip.norm() <= 1e-14);
    BOOST_TEST((after.slips == before.slips));
    BOOST_TEST((after.friction.traction - before.friction.traction).norm() <= rounding);
    // The same iteration again.
    const ContactInterface::State state = step.contact->state();
    step.contact->restore(state);
    step.contact->begin_iteration(step.scene.fields);
    const NodalLoads again = step.contact->pass(0).nodal_loads(fields);
    BOOST_TEST((again.friction.traction == after.friction.traction));
  }
}

/// After forget_steps(), the next step begins as the first one did.
BOOST_AUTO_TEST_CASE(a_forgotten_step_leaves_no_friction_and_no_status_behind) {
  std::mt19937 random(18);
  const SlidingStep step(sliding_scene(FacetType::quad4, FacetType::tri3, {0.2, true, false}), random);
  step.contact->accept_step(step.scene.fields);
  step.contact->forget_steps();
  const Multipliers& left = step.contact->pass(0).laws().multipliers;
  const Multipliers first = step.scene.contact()->pass(0).laws().multipliers;
  BOOST_TEST((left.friction == first.friction));
  BOOST_TEST((left.slips == first.slips));
  BOOST_TEST((left.flux_coupled == first.flux_coupled));
}

/// After Uzawa's update, the present friction is the trial of surfaces that do not slide further.
BOOST_AUTO_TEST_CASE(an_augmentation_takes_the_friction_over) {
  std::mt19937 random(16);
  const SlidingStep step(sliding_scene(FacetType::quad4, FacetType::tri3, {10, false, true}), random);
  const FacingFields fields{step.scene.fields[Side::primary], step.scene.fields[Side::secondary]};
  const NodalLoads before = step.contact->pass(0).nodal_loads(fields);
  step.contact->augment(step.scene.fields);
  const NodalLaws& laws = step.contact->pass(0).laws();
  for (Index node = 0; node < before.gap.size(); ++node) {
    if (!before.in_contact[node]) continue;
    const Vector3d n = before.friction.normal(node);
    const Vector3d carried = before.friction.convection[node] * laws.multipliers.friction.col(node);
    const Vector3d trial = carried - n * n.dot(carried);
    BOOST_TEST((trial - before.friction.traction.col(node)).norm() <= rounding);
  }
}

/// Within an iteration, trial and bound are linear in the positions, also if the bound is negative: an overlap that
/// becomes a gap of second order must not lead to an iteration without friction.
BOOST_AUTO_TEST_CASE(within_an_iteration_trial_and_bound_are_linear) {
  std::mt19937 random(17);
  const SlidingStep step(sliding_scene(FacetType::quad4, FacetType::tri3, {0.2, false, false}), random);
  const auto loads_at = [&](double part) {
    PerSide<SurfaceFields> fields = step.scene.fields;
    fields[Side::primary].position.colwise() -= part * 0.3 * normal_of_first_node(step);
    fields[Side::primary].position.row(0).array() += 0.05 * part;
    return step.contact->pass(0).nodal_loads({fields[Side::primary], fields[Side::secondary]});
  };
  const NodalLoads start = loads_at(0);
  const NodalLoads middle = loads_at(0.5);
  const NodalLoads end = loads_at(1);
  int below_zero = 0;
  for (Index node = 0; node < start.gap.size(); ++node) {
    if (!start.in_contact[node] || !start.rubs[node]) continue;
    if (end.friction.bound[node] < 0) ++below_zero;
    const double bound = 0.5 * (start.friction.bound[node] + end.friction.bound[node]);
    const Vector3d trial = 0.5 * (start.friction.trial.col(node) + end.friction.trial.col(node));
    BOOST_TEST(std::abs(middle.friction.bound[node] - bound) <= rounding);
    BOOST_TEST((middle.friction.trial.col(node) - trial).norm() <= rounding);
  }
  BOOST_TEST(below_zero > 0);
}

/// A node that closes within iterations begins as at the start of iterations, except that its direction of friction is
/// constant, because the bound of an overlap does not indicate its load.
BOOST_AUTO_TEST_CASE(a_node_that_closes_within_iterations_sticks_or_slides_as_its_own_trial_says) {
  for (const double shift : {0.02, 0.2}) {
    Scene scene = sliding_scene(FacetType::quad4, FacetType::quad4, {0.5, false, false});
    scene.fields[Side::secondary].position.row(2).array() += 0.2;  // apart
    const auto contact = scene.contact();
    contact->begin_iteration(scene.fields);
    scene.fields[Side::secondary].position.row(2).array() -= 0.3;
    scene.fields[Side::primary].position.row(0).array() += shift;
    contact->project(scene.position());
    contact->begin_iteration(scene.fields);
    const NodalLoads closed = contact->pass(0).nodal_loads(
        {scene.fields[Side::primary], scene.fields[Side::secondary]});
    BOOST_TEST(std::count(closed.in_contact.begin(), closed.in_contact.end(), true) > 0);
    for (Index node = 0; node < closed.gap.size(); ++node) {
      if (!closed.in_contact[node]) continue;
      const double trial = closed.friction.trial.col(node).norm();
      BOOST_TEST(closed.slips[node] == (trial > closed.friction.bound[node]));
      BOOST_TEST(closed.slips[node] == (shift > 0.1));
      const double friction = std::min(trial, closed.friction.bound[node]);
      BOOST_TEST(std::abs(closed.friction.traction.col(node).norm() - friction) <= rounding);
      BOOST_TEST(closed.friction.reference_bound[node] == 0.0);
    }
  }
}

/// The friction of a sticking node may be the cause of its tension.
BOOST_AUTO_TEST_CASE(a_node_that_sticks_and_is_pulled_slides_before_it_opens) {
  Scene scene = sliding_scene(FacetType::quad4, FacetType::quad4, {10, false, false});
  const auto contact = scene.contact();
  contact->begin_iteration(scene.fields);
  scene.fields[Side::secondary].position.row(2).array() += 0.2;
  const auto begin = [&] {
    contact->project(scene.position());
    contact->begin_iteration(scene.fields);
    return contact->pass(0).nodal_loads({scene.fields[Side::primary], scene.fields[Side::secondary]});
  };
  const NodalLoads pulled = begin();
  const auto closed = std::count(pulled.in_contact.begin(), pulled.in_contact.end(), true);
  BOOST_TEST(closed > 0);
  BOOST_TEST(std::count(pulled.slips.begin(), pulled.slips.end(), true) == closed);
  const NodalLoads open = begin();
  BOOST_TEST(std::count(open.in_contact.begin(), open.in_contact.end(), true) == 0);
}
