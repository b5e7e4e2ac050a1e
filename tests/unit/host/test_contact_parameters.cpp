// Tests of defaults for parameters that a model does not set.
#include "host/contact_parameters.h"
#include "host/facet_material.h"
#include "host/friction.h"

#include <boost/test/unit_test.hpp>

#include <limits>
#include <vector>

namespace {

ContactParameters with_friction() {
  ContactParameters parameters;
  parameters.friction.fric_coeff.value = 0.2;
  return parameters;
}

/// Tangential penalty divided by the stiffness of the bodies.
double friction_factor(const ContactParameters& parameters) {
  const mixture_contact::Settings settings = core_settings(parameters);
  return settings.friction.penalty_factor * settings.traction.value;
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_tangential_penalty_is_by_default_a_hundred_times_the_stiffness) {
  ContactParameters parameters = with_friction();
  BOOST_TEST(friction_factor(parameters) == mixture_contact::default_friction_factor);
  parameters.enforcement.two_pass = true;
  BOOST_TEST(friction_factor(parameters) == mixture_contact::default_friction_factor);
}

BOOST_AUTO_TEST_CASE(beside_a_given_penalty_the_tangential_one_is_the_same) {
  ContactParameters parameters = with_friction();
  parameters.penalties.traction.given = true;
  parameters.penalties.traction.value = 1000;
  BOOST_TEST(core_settings(parameters).friction.penalty_factor == 1);
}

BOOST_AUTO_TEST_CASE(fixed_gaps_are_soft_unless_a_given_penalty_is_what_acts_there) {
  ContactParameters parameters;
  const auto is_soft = [&](mixture_contact::Enforcement enforcement) {
    parameters.enforcement.laugon = static_cast<int>(enforcement);
    return core_settings(parameters).traction.softens_fixed_gaps;
  };
  for (const bool given : {false, true}) {
    parameters.penalties.traction.given = given;
    BOOST_TEST(is_soft(mixture_contact::Enforcement::penalty) == !given);
    BOOST_TEST(is_soft(mixture_contact::Enforcement::augmented_lagrangian) == !given);
    BOOST_TEST(is_soft(mixture_contact::Enforcement::lagrange_multipliers));
  }
}

BOOST_AUTO_TEST_CASE(a_given_tangential_penalty_is_a_factor_whatever_the_other) {
  ContactParameters parameters = with_friction();
  parameters.friction.tangential_penalty.given = true;
  parameters.friction.tangential_penalty.value = 3;
  for (const bool given : {false, true}) {
    parameters.penalties.traction.given = given;
    BOOST_TEST(core_settings(parameters).friction.penalty_factor == 3);
  }
}

BOOST_AUTO_TEST_CASE(materials_are_read_again_where_solutes_follow_the_convection_or_where_asked_for) {
  ContactParameters parameters;
  mixture_contact::Effects solvent;
  solvent.solvent = true;
  mixture_contact::Effects solutes = solvent;
  solutes.solutes = {1};
  BOOST_TEST(!reads_properties_again(parameters, solvent));
  BOOST_TEST(reads_properties_again(parameters, solutes));
  parameters.penalties.solute.given = true;
  BOOST_TEST(!reads_properties_again(parameters, solutes));
  parameters.penalties.update_penalty = true;
  BOOST_TEST(reads_properties_again(parameters, solvent));
}

BOOST_AUTO_TEST_CASE(a_parameter_notes_its_load_curve_or_refuses_it) {
  ContactParameters parameters;
  int followed = 0;
  int refused = 0;
  for_each_parameter(parameters, [&](const ParameterTag& tag, auto& /*value*/) {
    const std::string complaint = load_curve_complaint(tag);
    BOOST_TEST(complaint.empty() == (tag.varies != nullptr));
    BOOST_TEST((complaint.empty() || complaint.find("<" + std::string(tag.name) + ">") == 0));
    (complaint.empty() ? followed : refused) += 1;
    if (tag.varies != nullptr) *tag.varies = true;
  });
  BOOST_TEST(followed == 15);
  BOOST_TEST(refused > 20);
  BOOST_TEST(parameters.gap.offset.varies);
  BOOST_CHECK(requested_friction(parameters, true) == mixture_contact::FrictionKind::on_solid_part);
}

BOOST_AUTO_TEST_CASE(a_device_of_the_solver_that_does_not_exist_is_an_error_that_names_what_does) {
  ContactParameters parameters;
  BOOST_TEST(complaints(parameters).empty());
  parameters.helpers.devices.value = "kept_matrix, magic";
  const std::vector<std::string> list = complaints(parameters);
  BOOST_TEST_REQUIRE(list.size() == 1U);
  for (const char* const part : {"<solver_devices>", "\"magic\"", "\"all\"", "loads_as_unknowns", "predictor"})
    BOOST_TEST(list.front().find(part) != std::string::npos, part);
}

BOOST_AUTO_TEST_CASE(implicit_dynamics_bound_the_penalty_that_nothing_else_chooses) {
  ContactParameters parameters;
  BOOST_TEST(core_settings(parameters, SolverKind::implicit_dynamics).traction.value == 3);
  parameters.enforcement.laugon = 1;
  BOOST_TEST(core_settings(parameters, SolverKind::implicit_dynamics).traction.value ==
             mixture_contact::default_traction_factor);
  parameters.penalties.traction.given = true;
  parameters.penalties.traction.value = 50;
  BOOST_TEST(core_settings(parameters, SolverKind::implicit_dynamics).traction.value == 50);
}

BOOST_AUTO_TEST_CASE(nodes_rebound_in_steps_in_which_sound_crosses_less_than_two_elements) {
  FacetMaterial rigid;
  rigid.stiffness = std::numeric_limits<double>::infinity();
  FacetMaterial soft;
  soft.crossing = 1e-3;
  using Facets = std::vector<FacetMaterial>;
  const auto rebound = [](const Facets& primary, const Facets& secondary, double dt) {
    return would_rebound(longest_crossing(FacetMaterials{{primary, secondary}}), dt);
  };
  BOOST_TEST(!rebound({rigid}, {rigid}, 1e-6));
  BOOST_TEST(rebound({rigid}, {rigid, soft}, 1.9e-3));
  BOOST_TEST(rebound({soft}, {rigid}, 1.9e-3));
  BOOST_TEST(!rebound({soft}, {soft}, 2.1e-3));
}
