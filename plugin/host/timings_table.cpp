#include "timings_table.h"

#include "facet_material.h"

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <string_view>
#include <utility>

using mixture_contact::all_tasks;
using mixture_contact::Effects;
using mixture_contact::Task;
using mixture_contact::TimingBreakdown;

namespace {

std::string_view name_of(Task task) {
  switch (task) {
    case Task::search:
      return "search";
    case Task::residual:
      return "residual";
    case Task::stiffness:
      return "stiffness";
    case Task::augmentation:
      return "augmentation";
    case Task::output:
      return "output";
  }
  return {};
}

std::string padded(const std::string& text, std::size_t width) {
  return std::string(width - std::min(width, text.size()), ' ') + text;
}

std::string row(std::string_view title, const std::vector<std::string>& entries) {
  std::string line = "    " + std::string(title) + std::string(14 - std::min<std::size_t>(14, title.size()), ' ');
  for (const std::string& entry : entries) line += padded(entry, 12);
  return line;
}

std::string scientific(double value) {
  std::ostringstream text;
  text << std::scientific << std::setprecision(3) << value;
  return text.str();
}

/// The columns of the table: name and time [s].
std::vector<std::pair<std::string, double>> columns(const TimingBreakdown& spent, const Effects& effects) {
  std::vector<std::pair<std::string, double>> all{{"shared", spent.shared}, {"traction", spent.traction}};
  const auto tangential = mixture_contact::tangential_condition(effects.friction_kind).count();
  all.resize(all.size() + indexing::entries(tangential), {"friction", spent.friction});
  for (int field = 0; field < effects.scalar_fields(); ++field) {
    const int solute = solute_of(effects, field);
    all.emplace_back(solute < 0 ? "solvent" : "solute " + std::to_string(solute + 1), spent.fields[field]);
  }
  all.emplace_back("all", spent.total());
  all.emplace_back("of it host", spent.host);
  return all;
}

std::string headings(const Effects& effects) {
  std::vector<std::string> names;
  for (const auto& column : columns(TimingBreakdown(effects.scalar_fields()), effects)) names.push_back(column.first);
  return row("", names);
}

std::string seconds(std::string_view title, const TimingBreakdown& spent, const Effects& effects) {
  std::vector<std::string> entries;
  for (const auto& column : columns(spent, effects)) entries.push_back(scientific(column.second));
  return row(title, entries);
}

}  // namespace

std::vector<std::string> timings_table(const std::string& name, const mixture_contact::ContactInterface& contact,
                                       double run) {
  const TimingBreakdown sum = contact.measurements().timings.sum();
  std::vector<std::string> lines{"sliding-mixture \"" + name + "\": time in the contact [s]",
                                 headings(contact.effects())};
  for (const Task task : all_tasks)
    lines.push_back(seconds(name_of(task), contact.measurements().timings[task], contact.effects()));
  lines.push_back(seconds("all", sum, contact.effects()));
  std::ostringstream share;
  share << std::setprecision(3) << "    share of the run: " << 100 * sum.total() / run << " percent of " << run << " s";
  lines.push_back(share.str());
  const auto [points, bytes] = contact.measurements().memory;
  if (points > 0) {
    lines.push_back("    memory: " + std::to_string(bytes / points) + " bytes for each of " + std::to_string(points) +
                    " integration points");
  }
  return lines;
}
