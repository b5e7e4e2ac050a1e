#include "sections.h"

#include <cmath>
#include <limits>

namespace standalone {
namespace {

constexpr int most = std::numeric_limits<int>::max();

double not_negative(const Tag& tag) {
  const double value = tag.number();
  if (value < 0) tag.fail("the value must not be negative");
  return value;
}

double positive(const Tag& tag) {
  const double value = tag.number();
  if (value <= 0) tag.fail("the value must be positive");
  return value;
}

void read_stepper(const Tag& section, Model& model) {
  section.allow_attributes({"type"});
  section.allow_children({"max_retries", "opt_iter", "dtmin", "dtmax", "aggressiveness", "cutback", "dtforce"});
  if (section.attribute("type") != "default") section.fail("only the type \"default\" is supported");
  StepControl stepper;
  if (const auto tag = section.find("max_retries")) stepper.max_retries = tag->integer(0, 1000);
  if (const auto tag = section.find("opt_iter")) stepper.optimal_iterations = tag->integer(1, most);
  if (const auto tag = section.find("dtmin")) stepper.least = not_negative(*tag);
  if (const auto tag = section.find("dtmax")) {
    stepper.must_points = read_curve(*tag, model);
    stepper.largest = stepper.must_points < 0 ? positive(*tag) : not_negative(*tag);
  }
  if (const auto tag = section.find("aggressiveness")) stepper.aggressive = tag->flag();
  if (const auto tag = section.find("cutback")) stepper.cutback = positive(*tag);
  if (const auto tag = section.find("dtforce")) stepper.force = tag->flag();
  if (stepper.cutback >= 1) section.child("cutback").fail("the value must be less than 1");
  model.control.stepper = stepper;
}

void read_solver(const Tag& section, Model& model) {
  Control& control = model.control;
  section.allow_attributes({"type"});
  section.allow_children({"symmetric_stiffness", "max_refs", "dtol", "etol", "rtol", "ptol", "ctol", "lstol", "lsmin",
                          "lsiter", "min_residual", "qn_method", "force_positive_concentrations"});
  if (section.attribute("type") != control.module)
    section.fail("the type must be that of the module, \"" + control.module + "\"");
  if (const auto tag = section.find("symmetric_stiffness")) {
    if (tag->text() != "non-symmetric" && tag->text() != "0") tag->fail("only \"non-symmetric\" is supported");
  }
  if (const auto tag = section.find("max_refs")) control.max_reformations = tag->integer(1, most);
  if (const auto tag = section.find("dtol")) control.displacement_tolerance = not_negative(*tag);
  if (const auto tag = section.find("etol")) control.energy_tolerance = not_negative(*tag);
  if (const auto tag = section.find("rtol")) control.residual_tolerance = not_negative(*tag);
  if (const auto tag = section.find("ptol")) control.pressure_tolerance = not_negative(*tag);
  if (const auto tag = section.find("ctol")) control.concentration_tolerance = not_negative(*tag);
  if (const auto tag = section.find("lstol")) control.search_tolerance = not_negative(*tag);
  if (const auto tag = section.find("lsmin")) control.least_search = not_negative(*tag);
  if (const auto tag = section.find("lsiter")) control.max_searches = tag->integer(1, 1000);
  if (const auto tag = section.find("min_residual")) control.least_residual = not_negative(*tag);
  if (const auto tag = section.find("force_positive_concentrations")) {
    if (control.module != "multiphasic") tag->fail("only the module \"multiphasic\" has this choice");
    control.clamp = tag->flag();
  }
  const auto method = section.find("qn_method");
  if (method) {
    method->allow_attributes({"type"});
    method->allow_children({"max_ups"});
  }
  const auto updates = method ? method->find("max_ups") : std::nullopt;
  if (!updates || updates->integer(0, most) > 0) {
    model.notices.emplace_back("the matrix is formed anew in each iteration (full Newton), whatever <qn_method> says.");
  }
}

}  // namespace

void read_control(const Tag& section, Model& model) {
  Control& control = model.control;
  section.allow_children({"analysis", "time_steps", "final_time", "step_size", "plot_level", "time_stepper", "solver"});
  if (const auto tag = section.find("analysis")) {
    if (tag->text() != "TRANSIENT") tag->fail("only \"TRANSIENT\" is supported");
  }
  control.step_size = positive(section.child("step_size"));
  const Tag steps = section.child("time_steps");
  const auto end = section.find("final_time");
  if (end && steps.text() != "-1") end->fail("it counts only where time_steps is -1");
  control.end = end ? positive(*end) : steps.integer(1, most) * control.step_size;
  if (!std::isfinite(control.end))
    section.fail("the end of the analysis, time_steps x step_size, is not a finite number");
  if (const auto tag = section.find("plot_level")) {
    control.plot = tag->text() != "PLOT_NEVER";
    if (control.plot && tag->text() != "PLOT_MAJOR_ITRS")
      tag->fail(R"(only "PLOT_MAJOR_ITRS" and "PLOT_NEVER" are supported)");
  }
  if (const auto tag = section.find("time_stepper")) read_stepper(*tag, model);
  if (const auto tag = section.find("solver")) read_solver(*tag, model);
}

int read_curve(const Tag& tag, const Model& model) {
  tag.allow_attributes({"lc", "sol"});
  if (!tag.find_attribute("lc")) return -1;
  const int curve = tag.integer_attribute("lc");
  const auto count = static_cast<int>(model.curves.size());
  if (curve > count) {
    tag.fail("load curve " + std::to_string(curve) + " does not exist; there are " + std::to_string(count));
  }
  return curve - 1;
}

Parameter read_parameter(const Tag& tag, const Model& model) { return {tag.number(), read_curve(tag, model)}; }

void read_load_data(const Tag& section, Model& model) {
  section.allow_children({"load_controller"});
  for (const Tag& tag : section.children()) {
    tag.allow_attributes({"id", "type", "name"});
    tag.allow_children({"interpolate", "extend", "points"});
    if (tag.attribute("type") != "loadcurve") tag.fail("only the type \"loadcurve\" is supported");
    if (tag.integer_attribute("id") != static_cast<int>(model.curves.size()) + 1) tag.fail("ids must count up from 1");
    LoadCurve curve;
    if (const auto way = tag.find("interpolate")) {
      curve.steps = way->text() == "STEP";
      if (!curve.steps && way->text() != "LINEAR") way->fail(R"(only "LINEAR" and "STEP" are supported)");
    }
    if (const auto beyond = tag.find("extend")) {
      if (beyond->text() != "CONSTANT") beyond->fail("only \"CONSTANT\" is supported");
    }
    const Tag points = tag.child("points");
    points.allow_children({"pt"});
    for (const Tag& point : points.children()) {
      const std::vector<double> pair = point.numbers(2);
      if (!curve.points.empty() && pair[0] <= curve.points.back()[0])
        point.fail("the times of a load curve must ascend");
      curve.points.push_back({pair[0], pair[1]});
    }
    if (curve.points.empty()) points.fail("a load curve needs a point");
    model.curves.push_back(std::move(curve));
  }
}

}  // namespace standalone
