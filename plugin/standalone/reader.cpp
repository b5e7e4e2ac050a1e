#include "reader.h"

#include "error.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace standalone {
namespace {

void read_module(const Tag& tag, Model& model) {
  tag.ignore({"units"});
  model.control.module = tag.attribute("type", {"biphasic", "solute", "multiphasic"});
  model.control.expects_positive = model.control.module != "biphasic";
}

void read_load_curve(const Tag& tag, Model& model) {
  LoadCurve curve;
  tag.attribute("type", {"loadcurve"});
  if (tag.integer_attribute("id") != number_of(model.curves) + 1) tag.fail("ids must count up from 1");
  if (const auto way = tag.find("interpolate")) curve.steps = way->one_of({"LINEAR", "STEP"}) == 1;
  tag.must_be("extend", {"CONSTANT"});
  for (const Tag& point : tag.one("points").all("pt")) {
    const std::vector<double> pair = point.numbers(2);
    if (!curve.points.empty() && pair[0] <= curve.points.back()[0]) point.fail("the times of a load curve must ascend");
    curve.points.push_back({pair[0], pair[1]});
  }
  if (curve.points.empty()) tag.fail("a load curve needs a point");
  model.curves.push_back(std::move(curve));
}

StepControl read_stepper(const Tag& tag, const Model& model) {
  constexpr Range part{[](double x) { return x > 0 && x < 1; }, "positive and less than 1"};
  StepControl stepper;
  tag.attribute("type", {"default"});
  tag.one("aggressiveness").one_of({"1"});
  tag.take("max_retries", stepper.max_retries, 0, 1000);
  tag.take("opt_iter", stepper.optimal_iterations, 1);
  tag.take("dtmin", stepper.least, not_negative);
  tag.take("cutback", stepper.cutback, part);
  if (const auto force = tag.find("dtforce")) stepper.force = force->flag();
  if (const auto largest = tag.find("dtmax")) {
    stepper.must_points = read_curve(*largest, model);
    stepper.largest = largest->number(stepper.must_points < 0 ? positive : not_negative);
  }
  return stepper;
}

void read_solver(const Tag& tag, Model& model) {
  Control& control = model.control;
  tag.attribute("type", {control.module.c_str()});
  tag.must_be("symmetric_stiffness", {"non-symmetric", "0"});
  tag.take("max_refs", control.max_reformations, 1);
  tag.take("dtol", control.displacement_tolerance, not_negative);
  tag.take("etol", control.energy_tolerance, not_negative);
  tag.take("rtol", control.residual_tolerance, not_negative);
  tag.take("ptol", control.pressure_tolerance, not_negative);
  tag.take("ctol", control.concentration_tolerance, not_negative);
  tag.take("min_residual", control.least_residual, not_negative);
  if (control.module == "multiphasic") {
    if (const auto clamp = tag.find("force_positive_concentrations")) control.expects_positive = clamp->flag();
  }
  int updates = 1;
  if (const auto method = tag.find("qn_method")) {
    method->find_attribute("type");
    method->take("max_ups", updates, 0);
  }
  if (updates > 0)
    model.notices.emplace_back(
        "the matrix is formed again in each iteration (full Newton), whatever <qn_method> says.");
}

void read_control(const Tag& tag, Model& model) {
  Control& control = model.control;
  tag.must_be("analysis", {"TRANSIENT"});
  control.step_size = tag.one("step_size").number(positive);
  const Tag steps = tag.one("time_steps");
  const std::optional<Tag> end = tag.find("final_time");
  if (steps.text() == "-1") {
    control.end = tag.one("final_time").number(positive);
  } else {
    if (end) end->fail("it counts only where time_steps is -1");
    control.end = steps.integer(1) * control.step_size;
  }
  if (!std::isfinite(control.end)) tag.fail("the end of the analysis, time_steps x step_size, is not a finite number");
  if (const auto level = tag.find("plot_level")) control.plot = level->one_of({"PLOT_NEVER", "PLOT_MAJOR_ITRS"}) == 1;
  if (const auto stepper = tag.find("time_stepper")) control.stepper = read_stepper(*stepper, model);
  if (const auto solver = tag.find("solver")) read_solver(*solver, model);
}

void read_data(const Tag& tag, Model& model) {
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

void read_output(const Tag& tag, Model& model) {
  if (const auto log = tag.find("logfile")) {
    for (const char* kind : {"node_data", "element_data"}) {
      for (const Tag& data : log->all(kind)) read_data(data, model);
    }
  }
  model.control.plot = model.control.plot && tag.find("plotfile");
  tag.ignore({"plotfile"});
  if (model.control.plot)
    model.notices.emplace_back(
        "the plot file is written for ParaView (.pvd), with displacement, pressure and concentrations.");
}

}  // namespace

int read_curve(const Tag& tag, const Model& model) {
  if (!tag.find_attribute("lc")) return -1;
  const int curve = tag.integer_attribute("lc");
  const auto count = number_of(model.curves);
  if (curve <= count) return curve - 1;
  tag.fail("load curve " + std::to_string(curve) + " does not exist; there are " + std::to_string(count));
}

Parameter read_parameter(const Tag& tag, const Model& model) { return {tag.number(), read_curve(tag, model)}; }

Model read_model(const std::string& path) {
  Model model;
  model.file = path;
  read_xml(path, [&model](const Tag& root) {
    if (root.name() != "febio_spec") root.fail("this is no FEBio model; the first tag must be <febio_spec>");
    root.attribute("version", {"4.0"});
    const auto maybe = [&](const char* name, void (*read)(const Tag&, Model&)) {
      if (const auto section = root.find(name)) read(*section, model);
    };
    read_module(root.one("Module"), model);
    maybe("LoadData", [](const Tag& section, Model& to) {
      for (const Tag& curve : section.all("load_controller")) read_load_curve(curve, to);
    });
    read_control(root.one("Control"), model);
    maybe("Globals", read_globals);
    read_materials(root.one("Material"), model);
    read_mesh(root.one("Mesh"), model);
    read_mesh_domains(root.one("MeshDomains"), model);
    maybe("Boundary", read_boundary);
    maybe("Rigid", read_rigid);
    maybe("Initial", read_initial);
    maybe("Loads", read_loads);
    maybe("Contact", read_contacts);
    maybe("Output", read_output);
  });
  return model;
}

}  // namespace standalone
