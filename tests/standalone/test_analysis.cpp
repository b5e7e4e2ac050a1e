#include "standalone/analysis.h"

#include "small_models.h"

#include <boost/test/unit_test.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>

using namespace test;

namespace {

/// Two unit cubes on top of each other. The upper one is moved down by `depth` until t = 1 in one step.
Model pressed_cubes(double depth) {
  Model model = column(3, 1, 1);
  model.control.module = "biphasic";
  model.control.plot = false;
  model.control.stepper = StepControl{};
  model.control.stepper->max_retries = 1;
  model.control.stepper->largest = 1;
  model.mesh.nodes.conservativeResize(3, 16);
  model.mesh.nodes.rightCols<8>() = model.mesh.nodes.leftCols<8>().colwise() + Vector3d(0, 0, 1);
  model.mesh.elements.push_back({2, 0, {8, 9, 10, 11, 12, 13, 14, 15}});
  const auto face = [](std::array<int, 4> nodes, int element) {
    SurfaceFacet facet;
    facet.element = element;
    facet.facet.type = mixture_contact::FacetType::quad4;
    std::copy(nodes.begin(), nodes.end(), facet.facet.nodes.begin());
    return facet;
  };
  model.mesh.surfaces = {{"low", {face({4, 5, 6, 7}, 0)}}, {"up", {face({8, 11, 10, 9}, 1)}}};
  ContactDefinition contact;
  contact.name = "cubes";
  contact.surfaces = {{"up", "low"}};
  model.contacts.sliding.push_back(contact);
  LoadCurve ramp;
  ramp.points = {{0, 0}, {1, 1}};
  model.curves.push_back(ramp);
  confine(model);
  model.prescribed.push_back({2, level(3), {-depth, 0}});
  return model;
}

/// The text of the log of a run.
std::string log_of(const Model& model) {
  const std::string path = (std::filesystem::temp_directory_path() / "standalone_test_analysis.log").string();
  {
    Log log(false);
    log.open(path);
    run(model, log);
  }
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  std::filesystem::remove(path);
  return text.str();
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

// The displacement is larger than the height of the cubes: the attempt to t = 1 fails, and so does any step after the
// first half.
BOOST_AUTO_TEST_CASE(an_automatic_penalty_is_reduced_after_a_failed_attempt) {
  const std::string log = log_of(pressed_cubes(2.2));
  BOOST_TEST(has(log, "the step to time 1 has failed. The next attempt divides automatic penalties"));
  BOOST_TEST(has(log, "the largest overlap of an accepted step was"));
}

BOOST_AUTO_TEST_CASE(a_penalty_that_is_given_is_not_reduced) {
  Model model = pressed_cubes(2.2);
  model.contacts.sliding[0].parameters.penalties.traction = {{1000, true}};
  const std::string log = log_of(model);
  BOOST_TEST(has(log, "Retrying time step"));
  BOOST_TEST(!has(log, "automatic penalties"));
}

BOOST_AUTO_TEST_CASE(penalties_are_full_where_no_step_fails) {
  BOOST_TEST(!has(log_of(pressed_cubes(0.2)), "automatic penalties"));
}
