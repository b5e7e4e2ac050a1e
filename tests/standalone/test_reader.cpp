#include "standalone/reader.h"

#include "standalone/error.h"
#include "standalone/newton.h"

#include <boost/test/unit_test.hpp>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

using namespace standalone;

namespace {

std::string model_text() {
  std::ostringstream text;
  text << std::ifstream(MODEL_FILE).rdbuf();
  return text.str();
}

/// Reads a model from a text, by way of a file.
Model read_text(const std::string& text) {
  const auto path = std::filesystem::temp_directory_path() /
                    ("mixture-contact-test-" + std::to_string(::getpid()) + ".feb");
  std::ofstream(path) << text;
  struct Remove {
    std::filesystem::path path;
    ~Remove() { std::filesystem::remove(path); }
  } const remove{path};
  return read_model(path.string());
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  BOOST_REQUIRE_MESSAGE(at != std::string::npos, what + " is not in the model");
  return text.replace(at, what.size(), by);
}

/// Number of the line of the model that contains a text.
int line_of(const std::string& what) {
  const std::string text = model_text();
  return 1 +
         static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(text.find(what)), '\n'));
}

struct Mistake {
  std::string what, by;  ///< text and its faulty replacement
  std::string tag;       ///< tag in the message
  std::string said;      ///< further text in the message
};

const std::vector<Mistake> mistakes{
    {"<time_steps>5", "<time_steps>-5", "time_steps", "not an integer"},
    {"<time_steps>5", "<time_steps>99999999999999999999", "time_steps", "not an integer"},
    {"<time_steps>5", "<final_time>50</final_time><time_steps>5", "final_time", "time_steps is -1"},
    {"<step_size>10", "<step_size>nan", "step_size", "not a finite number"},
    {"<step_size>10", "<step_size>1e308", "Control", "not a finite number"},
    {"<step_size>10", "<step_size>0", "step_size", "must be positive"},
    {"<dtol>0.001", "<dtol>inf", "dtol", "not a finite number"},
    {"<dtol>0.001</dtol>", "<dtoll>0.001</dtoll>", "dtoll", "not supported here"},
    {"<solver type=\"solute\">", "<solver type=\"solid\">", "solver", "allowed: \"solute\""},
    {"<phi0>0.2", "<phi0>1", "phi0", "less than 1"},
    {"<v>0.1", "<v>0.5", "v", "less than 0.5"},
    {"<perm>0.001", "<perm>-1", "perm", "must be positive"},
    {"type=\"perm-const-iso\"", "type=\"perm-Holmes-Mow\"", "permeability", "perm-const-iso"},
    {"type=\"biphasic-solute\"", "type=\"triphasic\"", "material", "not supported"},
    {"<solute sol=\"1\">", "<solute sol=\"2\">", "solute", "does not exist"},
    {"<charge_number>0", "<charge_number>1", "charge_number", "not supported"},
    {"<node id=\"3\">", "<node id=\"2\">", "node", "used twice"},
    {"<node id=\"3\">", "<node id=\"0\">", "node", "not an integer from 1"},
    {"<node id=\"3\">", "<node id=\"99999999999\">", "node", "not an integer"},
    {"<node id=\"3\">", "<node>", "node", "id is missing"},
    {"<node id=\"3\">", "<node id=\"300\">", "elem", "node 3 does not exist"},
    {"1,2,3,4,5,6,7,8</elem>", "1,2,3,4,5,6,7,88</elem>", "elem", "node 88 does not exist"},
    {"1,2,3,4,5,6,7,8</elem>", "1,2,3,4,5,6,7</elem>", "elem", "needs 8 nodes"},
    {"<node id=\"1\">0,0,-1", "<node id=\"1\">0,0,9", "elem", "inverted"},
    {"<elem id=\"2\">", "<elem id=\"1\">", "elem", "used twice"},
    {"type=\"hex8\"", "type=\"tet4\"", "Elements", "not supported"},
    {"5,6,7,8</quad4>", "5,6,7,9</quad4>", "quad4", "not a face"},
    {"5,6,7,8</quad4>", "8,7,6,5</quad4>", "quad4", "counter-clockwise"},
    {"<laugon>PENALTY", "<laugon>LAGMULT", "laugon", "allowed"},
    {"<aggressiveness>1", "<aggressiveness>0", "aggressiveness", "allowed"},
    {"<NodeSet name=\"top\">", "<NodeSet name=\"bottom\">", "NodeSet", "used twice"},
    {"<secondary>upper-bottom", "<secondary>upper", "SurfacePair", "does not exist"},
    {"name=\"upper\" mat=\"gel\"", "name=\"upper\" mat=\"glue\"", "SolidDomain", "does not exist"},
    {"    <SolidDomain name=\"upper\" mat=\"gel\"/>\n", "", "MeshDomains", "no material"},
    {"node_set=\"top\"", "node_set=\"side\"", "bc", "does not exist"},
    {"<dof>z", "<dof>w", "dof", "allowed"},
    {"<dof>c1", "<dof>c2", "dof", "c1"},
    {"<value lc=\"1\">-0.001", "<value lc=\"3\">-0.001", "value", "load curve 3 does not exist"},
    {"<pt>10,1", "<pt>0,1", "pt", "ascend"},
    {"<pt>10,1", "<pt>10", "pt", "expected 2 numbers"},
    {"<load_controller id=\"2\" type=\"loadcurve\">", "<load_controller id=\"2\" type=\"loadcurve\" lc=\"1\">",
     "load_controller", "not supported"},
    {"<extend>CONSTANT", "<extend>REPEAT", "extend", "CONSTANT"},
    {"type=\"loadcurve\"", "type=\"math\"", "load_controller", "loadcurve"},
    {"<load_controller id=\"2\"", "<load_controller id=\"1\"", "load_controller", "count up"},
    {"type=\"sliding-mixture\"", "type=\"sliding-elastic\"", "contact", "mixcontact convert"},
    {"<penalty>100", "<penalty>-100", "contact", "<penalty>"},
    {"<penalty>100", "<penalty>1e400", "penalty", "not a finite number"},
    {"<search_radius>0.5", "<search_radius>-1", "contact", "<search_radius>"},
    {"surface_pair=\"pair\"", "surface_pair=\"pear\"", "contact", "does not exist"},
    {"<secondary>upper-bottom", "<secondary>lower-top", "contact", "contact of a body with itself is for febio4"},
    {"sol=\"1\" lc=\"1\">0.1", "sol=\"2\" lc=\"1\">0.1", "ambient_concentration", "does not exist"},
    {"data=\"x;y", "data=\"xx;y", "node_data", "not supported"},
    {"<Module type=\"solute\"/>", "<Module type=\"heat\"/>", "Module", "not supported"},
    {"version=\"4.0\"", "version=\"3.0\"", "febio_spec", "4.0"},
};

/// Texts that a random change inserts.
const std::vector<std::string> scraps{
    "",   "0",  "-1",   "1e308", "-1e308", "nan",  "999999999999", "2147483647", "<",   ">",    "\"", "&",
    "/>", "--", "\xff", ",,",    "<a>",    "</a>", "lc",           "1e-320",     "]]>", "<!--", "=",  ";"};

/// The text with up to four random changes: of characters, words, whole lines, or insertions of scraps.
std::string mutated(std::string text, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
  for (std::size_t changes = 1 + below(4); changes > 0 && !text.empty(); --changes) {
    const std::size_t at = below(text.size());
    switch (below(5)) {
      case 0:
        text[at] = static_cast<char>(below(256));
        break;
      case 1:
        text.replace(at, below(20), scraps[below(scraps.size())]);
        break;
      case 2: {  // replaces a number
        const std::size_t digit = text.find_first_of("0123456789", at);
        if (digit != std::string::npos) text.replace(digit, 1, scraps[below(8)]);
        break;
      }
      case 3: {  // deletes or repeats a line
        const std::size_t from = text.rfind('\n', at) + 1;
        const std::size_t length = std::min(text.find('\n', at), text.size() - 1) - from + 1;
        const std::string line = text.substr(from, length);
        if (below(2) == 0) {
          text.erase(from, length);
        } else {
          text.insert(from, line);
        }
        break;
      }
      default:
        text.resize(std::max<std::size_t>(1, at));
    }
  }
  return text;
}

/// Solves the first step of a model as far as possible.
void try_step(const Model& model) {
  Log quiet(false);
  Problem problem(model);
  Newton newton(problem, quiet);
  try {
    newton.solve_step(model.control.step_size, model.control.step_size);
  } catch (const StepFailure&) {
    BOOST_TEST_MESSAGE("the step failed, as it may");
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_model_is_read_as_it_stands) {
  const Model model = read_model(MODEL_FILE);
  BOOST_TEST(model.mesh.nodes.cols() == 16);
  BOOST_TEST(model.mesh.elements.size() == 2U);
  BOOST_TEST(model.materials.size() == 3U);
  BOOST_TEST(model.materials[0].fields() == 5);
  BOOST_TEST(model.control.end == 50);
  BOOST_TEST(model.control.stepper->must_points == 1);
  BOOST_TEST(model.prescribed.size() == 6U);
  BOOST_TEST(model.curves[0].at(2.5) == 0.25);
  BOOST_TEST(model.contacts.sliding[0].parameters.penalties.traction.value == 100);
  BOOST_TEST(model.contacts.sliding[0].ambient_concentration.at(0).at(5, model.curves) == 0.05,
             boost::test_tools::tolerance(1e-15));
  BOOST_TEST(model.data.size() == 2U);
}

BOOST_AUTO_TEST_CASE(each_mistake_is_named_with_its_tag_and_line) {
  for (const Mistake& mistake : mistakes) {
    try {
      const Model model = read_text(replaced(model_text(), mistake.what, mistake.by));
      const Problem problem(model);
      BOOST_ERROR("no complaint about " + mistake.by);
    } catch (const InputError& error) {
      const std::string said = error.what();
      BOOST_TEST_INFO(mistake.by + ": " + said);
      BOOST_TEST(said.find("<" + mistake.tag + ">") != std::string::npos);
      BOOST_TEST_INFO(mistake.by + ": " + said);
      BOOST_TEST(said.find(mistake.said) != std::string::npos);
    }
  }
}

BOOST_AUTO_TEST_CASE(the_line_is_that_of_the_tag) {
  try {
    read_text(replaced(model_text(), "<perm>0.001", "<perm>-1"));
    BOOST_ERROR("no complaint");
  } catch (const InputError& error) {
    BOOST_TEST(std::string(error.what()).find("line " + std::to_string(line_of("<perm>")) + ",") != std::string::npos);
  }
}

BOOST_AUTO_TEST_CASE(files_that_are_missing_or_no_xml_are_errors) {
  BOOST_CHECK_THROW(read_model("/nowhere/model.feb"), InputError);
  BOOST_CHECK_THROW(read_model("/"), InputError);
  BOOST_CHECK_THROW(read_text(""), InputError);
  BOOST_CHECK_THROW(read_text("not XML at all"), InputError);
  BOOST_CHECK_THROW(read_text(std::string(1000, '<')), InputError);
  std::string deep;
  for (int k = 0; k < 100000; ++k) deep += "<a>";
  BOOST_CHECK_THROW(read_text(deep), InputError);
}

BOOST_AUTO_TEST_CASE(a_damaged_model_is_read_or_refused_but_never_crashes) {
  std::mt19937 random(20261121);
  const std::string text = model_text();
  int accepted = 0;
  constexpr int trials = 5000;
  for (int trial = 0; trial < trials; ++trial) {
    try {
      const Model model = read_text(mutated(text, random));
      ++accepted;
      try_step(model);
    } catch (const InputError& error) {
      BOOST_TEST(std::string(error.what()).size() > 10U);
    }
  }
  BOOST_TEST(accepted > trials / 50);
  BOOST_TEST(accepted < trials);
}
