#include "augmentation.h"

#include "facet_material.h"

#include <array>
#include <cstdio>

using namespace mixture_contact;

namespace {

std::string gap_line(const std::string& name, const FieldGap& gap, const Tolerances::Field& tolerance) {
  std::array<char, 128> line{};
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg): columns of numbers
  std::snprintf(line.data(), line.size(), "    %-16s %12.4e (%9.2e)  %12.4e (%9.2e)", name.c_str(), gap.relative,
                tolerance.relative, gap.largest, tolerance.largest);
  return line.data();
}

std::vector<std::string> gap_table(const std::string& title, const GapReport& report, const Tolerances& tolerances,
                                   const Effects& effects) {
  std::vector<std::string> lines{" " + title + ": gaps, with the tolerances (0: none)",
                                 "                         RELATIVE                  LARGEST",
                                 gap_line("gap", report.traction, tolerances.traction)};
  for (const FieldGap& slip : report.slip) lines.push_back(gap_line("slip in stick", slip, tolerances.traction));
  for (std::size_t k = 0; k < report.flux.size(); ++k) {
    const int solute = solute_of(effects, static_cast<int>(k));
    const std::string name = solute < 0 ? "pressure jump" : "jump of c" + std::to_string(solute + 1);
    lines.push_back(gap_line(name, report.flux[k], solute < 0 ? tolerances.solvent : tolerances.solute));
  }
  return lines;
}

}  // namespace

Augmentation augment(const std::string& title, const GapReport& report, const Settings& settings,
                     const Effects& effects, int augmentation, const std::function<bool()>& take_up) {
  Augmentation outcome;
  outcome.lines = gap_table(title + ", augmentation " + std::to_string(augmentation), report, settings.tolerances,
                            effects);
  // Unknown multipliers have closed the gaps: a solution meets the conditions.
  if (settings.enforcement == Enforcement::lagrange_multipliers) return outcome;
  if (meets(report, settings.tolerances, effects) && augmentation >= settings.tolerances.augmentations.least)
    return outcome;
  if (augmentation >= settings.tolerances.augmentations.most) {
    outcome.warning = title + ": " + std::to_string(augmentation) +
                      " augmentations (maxaug) were not enough to meet the tolerances.";
    return outcome;
  }
  outcome.stiffens = take_up();
  outcome.done = false;
  return outcome;
}

Augmentation augment(const std::string& name, ContactInterface& core, const PerSide<SurfaceFields>& fields,
                     int augmentation) {
  if (core.settings().enforcement == Enforcement::penalty) return {};
  return augment("sliding-mixture \"" + name + "\"", core.gaps(fields), core.settings(), core.effects(), augmentation,
                 [&] { return core.augment(fields); });
}
