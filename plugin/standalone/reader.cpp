#include "reader.h"

#include "error.h"
#include "sections.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace standalone {
namespace {

void read_module(const Tag& tag, Model& model) {
  tag.read({"type"}, {maybe("units", [](const Tag&) {})});
  model.control.module = tag.attribute("type", {"biphasic", "solute", "multiphasic"});
  model.control.expects_positive = model.control.module != "biphasic";
}

void read_curve_points(const Tag& tag, Model& model) {
  LoadCurve curve;
  const auto add = [&](const Tag& point) {
    const std::vector<double> pair = point.numbers(2);
    if (!curve.points.empty() && pair[0] <= curve.points.back()[0]) point.fail("the times of a load curve must ascend");
    curve.points.push_back({pair[0], pair[1]});
  };
  tag.attribute("type", {"loadcurve"});
  if (tag.integer_attribute("id") != static_cast<int>(model.curves.size()) + 1) tag.fail("ids must count up from 1");
  tag.read({"id", "type", "name"},
           {maybe("interpolate", [&](const Tag& way) { curve.steps = way.one_of({"LINEAR", "STEP"}) == 1; }),
            maybe("extend", must_be({"CONSTANT"})),
            one("points", [&](const Tag& points) { points.read({}, {each("pt", add)}); })});
  if (curve.points.empty()) tag.fail("a load curve needs a point");
  model.curves.push_back(std::move(curve));
}

void read_stepper(const Tag& tag, Model& model) {
  constexpr Range part{[](double x) { return x > 0 && x < 1; }, "positive and less than 1"};
  StepControl stepper;
  const auto largest = [&](const Tag& value) {
    stepper.must_points = read_curve(value, model);
    stepper.largest = value.number(stepper.must_points < 0 ? positive : not_negative);
  };
  tag.attribute("type", {"default"});
  tag.read({"type"},
           {maybe("max_retries", into(stepper.max_retries, 0, 1000)),
            maybe("opt_iter", into(stepper.optimal_iterations, 1)), maybe("dtmin", into(stepper.least, not_negative)),
            maybe("dtmax", largest), one("aggressiveness", must_be({"1"})),
            maybe("cutback", into(stepper.cutback, part)), maybe("dtforce", into(stepper.force))});
  model.control.stepper = stepper;
}

void read_solver(const Tag& tag, Model& model) {
  Control& control = model.control;
  int updates = 1;
  const auto clamp = [&](const Tag& choice) {
    if (control.module != "multiphasic") choice.fail("only the module \"multiphasic\" has this choice");
    control.expects_positive = choice.flag();
  };
  tag.attribute("type", {control.module.c_str()});
  tag.read(
      {"type"},
      {maybe("symmetric_stiffness", must_be({"non-symmetric", "0"})),
       maybe("max_refs", into(control.max_reformations, 1)),
       maybe("dtol", into(control.displacement_tolerance, not_negative)),
       maybe("etol", into(control.energy_tolerance, not_negative)),
       maybe("rtol", into(control.residual_tolerance, not_negative)),
       maybe("ptol", into(control.pressure_tolerance, not_negative)),
       maybe("ctol", into(control.concentration_tolerance, not_negative)),
       maybe("min_residual", into(control.least_residual, not_negative)), maybe("force_positive_concentrations", clamp),
       maybe("qn_method", [&](const Tag& method) { method.read({"type"}, {maybe("max_ups", into(updates, 0))}); })});
  if (updates > 0)
    model.notices.emplace_back("the matrix is formed anew in each iteration (full Newton), whatever <qn_method> says.");
}

void read_control(const Tag& tag, Model& model) {
  Control& control = model.control;
  int steps = 0;
  std::optional<double> end;
  const auto final_time = [&](const Tag& time) {
    if (steps != -1) time.fail("it counts only where time_steps is -1");
    end = time.number(positive);
  };
  tag.read({}, {maybe("analysis", must_be({"TRANSIENT"})), one("step_size", into(control.step_size, positive)),
                one("time_steps", [&](const Tag& count) { steps = count.text() == "-1" ? -1 : count.integer(1); }),
                maybe("final_time", final_time),
                maybe("plot_level",
                      [&](const Tag& level) { control.plot = level.one_of({"PLOT_NEVER", "PLOT_MAJOR_ITRS"}) == 1; }),
                maybe("time_stepper", [&](const Tag& stepper) { read_stepper(stepper, model); }),
                maybe("solver", [&](const Tag& solver) { read_solver(solver, model); })});
  if (steps == -1 && !end) tag.fail("the tag <final_time> is missing");
  control.end = end.value_or(steps * control.step_size);
  if (!std::isfinite(control.end)) tag.fail("the end of the analysis, time_steps x step_size, is not a finite number");
}

void read_data(const Tag& tag, Model& model) {
  tag.read({"data", "file", "delim", "name"});
  if (!tag.text().empty()) tag.fail("a choice of items is not supported; the data of all are written");
  DataFile file;
  file.elements = tag.name() == "element_data";
  file.names = tag.attribute("data");
  file.file = tag.attribute("file");
  file.separator = tag.find_attribute("delim").value_or(" ");
  std::istringstream names(file.names);
  const std::vector<std::string> known = file.elements ? model.element_data() : model.node_data();
  for (std::string name; std::getline(names, name, ';');) {
    const auto place = std::find(known.begin(), known.end(), name);
    if (place == known.end()) tag.fail("the data \"" + name + "\" are not supported; there is " + listed(known));
    file.rows.push_back(static_cast<int>(place - known.begin()));
  }
  if (file.rows.empty()) tag.fail("the attribute data names no column");
  model.data.push_back(std::move(file));
}

}  // namespace

int read_curve(const Tag& tag, const Model& model) {
  if (!tag.find_attribute("lc")) return -1;
  const int curve = tag.integer_attribute("lc");
  const auto count = static_cast<int>(model.curves.size());
  if (curve <= count) return curve - 1;
  tag.fail("load curve " + std::to_string(curve) + " does not exist; there are " + std::to_string(count));
}

Read into(Parameter& value, const Model& model) {
  return [&value, &model](const Tag& tag) {
    tag.read({"lc"});
    value = {tag.number(), read_curve(tag, model)};
  };
}

Model read_model(const std::string& path) {
  Model model;
  model.file = path;
  const auto to = [&](void (*section)(const Tag&, Model&)) {
    return [&model, section](const Tag& tag) { section(tag, model); };
  };
  const auto data = to(read_data);
  const auto output = [&](const Tag& tag) {
    bool plot = false;
    tag.read({}, {maybe("logfile",
                        [&](const Tag& log) { log.read({}, {each("node_data", data), each("element_data", data)}); }),
                  maybe("plotfile", [&](const Tag&) { plot = model.control.plot; })});
    model.control.plot = plot;
    if (plot)
      model.notices.emplace_back(
          "the plot file is written for ParaView (.pvd), with displacement, pressure and concentrations.");
  };
  read_xml(path, [&](const Tag& root) {
    if (root.name() != "febio_spec") root.fail("this is no FEBio model; the first tag must be <febio_spec>");
    root.attribute("version", {"4.0"});
    const auto curves = [&](const Tag& tag) { tag.read({}, {each("load_controller", to(read_curve_points))}); };
    root.read({"version"},
              {one("Module", to(read_module)), maybe("LoadData", curves), one("Control", to(read_control)),
               maybe("Globals", to(read_globals)), one("Material", to(read_materials)), one("Mesh", to(read_mesh)),
               one("MeshDomains", to(read_mesh_domains)), maybe("Boundary", to(read_conditions)),
               maybe("Rigid", to(read_rigid)), maybe("Initial", to(read_conditions)), maybe("Loads", to(read_loads)),
               maybe("Contact", to(read_contacts)), maybe("Output", output)});
  });
  return model;
}

}  // namespace standalone
