#include "exchange.h"

#include "friction.h"

#include <algorithm>
#include <sstream>

namespace {

std::string number_of(const FieldAtContact& field) {
  return field.solute < 0 ? "solvent" : "solute " + std::to_string(field.solute + 1);
}

bool is_called(const FieldAtContact& field, const std::string& word) {
  return word == number_of(field) || (word == "solutes" && field.solute >= 0) ||
         (!field.name.empty() && word == field.name);
}

std::string trimmed(const std::string& text) {
  const char* const blank = " \t\r\n";
  const auto first = text.find_first_not_of(blank);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blank) - first + 1);
}

std::vector<std::string> words(const std::string& list) {
  std::vector<std::string> found;
  std::istringstream rest(list);
  for (std::string word; std::getline(rest, word, ',');) found.push_back(trimmed(word));
  return found;
}

std::string joined(const std::vector<std::string>& names) {
  std::string list = names.front();
  for (std::size_t i = 1; i < names.size(); ++i) list += ", " + names[i];
  return list;
}

std::string allowed(const std::vector<FieldAtContact>& fields) {
  std::string list = "\"all\", or some of the names traction, friction, solutes";
  for (const FieldAtContact& field : fields) {
    list += ", " + number_of(field);
    if (!field.name.empty()) list += " (" + field.name + ")";
  }
  return list + " with commas between them";
}

void check_word(const std::string& word, const std::vector<FieldAtContact>& fields, std::vector<std::string>& list) {
  if (word == "traction" || word == "friction" || word == "solutes") return;
  const auto field = std::find_if(fields.begin(), fields.end(), [&](const auto& f) { return is_called(f, word); });
  if (field == fields.end()) {
    list.push_back("<effects> names \"" + word + "\"; allowed: " + allowed(fields) + ".");
    return;
  }
  const std::string refusal = "<effects> includes " + word + ", which this contact cannot exchange: ";
  for (const std::string& obstacle : field->obstacles) list.push_back(refusal + obstacle + ".");
}

void exchange(const FieldAtContact& field, mixture_contact::Effects& effects) {
  if (field.solute < 0) {
    effects.solvent = true;
  } else {
    effects.solutes.push_back(field.solute);
  }
}

/// The reason why no traction is exchanged, for the summary.
const char* without_traction(Motion motion) {
  if (motion == Motion::tied) return " No traction: <effects> omits it.";
  return motion == Motion::untouched ? " No traction: <penalty> is 0."
                                     : " No traction: the displacements of both surfaces are fixed.";
}

}  // namespace

void leave_out(const LeftOut& left_out, std::vector<FieldAtContact>& fields) {
  for (FieldAtContact& field : fields) {
    const bool is_solvent = field.solute < 0;
    if (left_out.contact) field.obstacles.emplace_back("<penalty> is 0, and the surfaces never touch");
    if (is_solvent && !left_out.solvent.empty()) field.obstacles.push_back("<" + left_out.solvent + "> is 0");
    if (!is_solvent && left_out.solutes) field.obstacles.emplace_back("<concentration_penalty> is 0");
    const std::vector<int>& stopped = left_out.stopped_solutes;
    if (std::find(stopped.begin(), stopped.end(), field.solute) != stopped.end())
      field.obstacles.emplace_back("<solute_permeance> is 0, <reflection> 1");
  }
}

Exchange decide_exchange(const std::string& asked, const std::vector<FieldAtContact>& fields, Motion motion,
                         mixture_contact::FrictionKind friction) {
  Exchange result;
  const bool everything = trimmed(asked) == "all";
  const std::vector<std::string> names = everything ? std::vector<std::string>{} : words(asked);
  for (const std::string& name : names) check_word(name, fields, result.complaints);
  if (!everything && names.empty())
    result.complaints.push_back("<effects> is empty; allowed: " + allowed(fields) + ".");

  const bool pushes = everything || std::find(names.begin(), names.end(), "traction") != names.end();
  if (!pushes && motion == Motion::possible) {
    result.complaints.emplace_back(
        "<effects> omits traction, but not all displacements of the two surfaces are fixed: a node that moves "
        "could pass through the other surface. Name traction, or fix x, y and z of every node of both surfaces.");
  }
  result.effects.traction = motion == Motion::possible || motion == Motion::undecided ||
                            (motion == Motion::tied && pushes);
  std::vector<std::string> present;
  std::string absent;
  if (result.effects.traction) {
    present.emplace_back("traction");
  } else {
    absent = without_traction(motion);
  }
  const bool rubs = std::find(names.begin(), names.end(), "friction") != names.end();
  decide_friction(friction, rubs, everything || rubs, result, present, absent);
  for (const FieldAtContact& field : fields) {
    const auto means_it = [&](const std::string& name) { return is_called(field, name); };
    const bool wanted = everything || std::any_of(names.begin(), names.end(), means_it);
    for (const std::string& obstacle : field.obstacles) absent += " No " + number_of(field) + ": " + obstacle + ".";
    if (!field.obstacles.empty()) continue;
    if (wanted) {
      exchange(field, result.effects);
      present.push_back(number_of(field));
    } else {
      absent += " No " + number_of(field) + ": <effects> omits it.";
    }
  }
  result.summary = (present.empty() ? "nothing" : joined(present)) + "." + absent;
  return result;
}
