#include "columns.h"

#include <algorithm>

namespace standalone {
namespace {

constexpr std::array<const char*, 3> axes{"x", "y", "z"};

NodeColumn nodal_value(int dof) {
  return [dof](const Problem& problem, int node) { return problem.values()(dof, node); };
}

/// A value of a solute, by its index in the model's list; `value` takes its index in the material. 0 where the material
/// lacks it.
ElementColumn of_solute(int solute, const std::function<double(const Bodies::Average&, Index)>& value) {
  return [=](const Bodies::Average& average, const Material& material) {
    const auto& list = material.solutes;
    const auto own = std::find_if(list.begin(), list.end(), [=](const Solute& s) { return s.index == solute; });
    return own == list.end() ? 0.0 : value(average, own - list.begin());
  };
}

}  // namespace

std::map<std::string, NodeColumn> node_columns(int solutes) {
  std::map<std::string, NodeColumn> columns{{"p", nodal_value(pressure_dof)}};
  for (int i = 0; i < 3; ++i) {
    const std::string axis = axes[static_cast<std::size_t>(i)];
    columns[axis] = [i](const Problem& p, int node) { return p.model().mesh.nodes(i, node) + p.values()(i, node); };
    columns["u" + axis] = nodal_value(i);
    columns["R" + axis] = [i](const Problem& problem, int node) { return problem.reaction(i, node); };
  }
  for (int k = 0; k < solutes; ++k) columns["c" + std::to_string(k + 1)] = nodal_value(concentration_dof(k));
  return columns;
}

std::map<std::string, ElementColumn> element_columns(int solutes) {
  using Average = Bodies::Average;
  std::map<std::string, ElementColumn> columns{{"p", [](const Average& a, const Material&) { return a.pressure; }}};
  const auto add_solute = [&](int solute, const std::string& number) {
    columns["c" + number] = of_solute(solute, [](const Average& a, Index k) { return a.concentration[k]; });
    for (Index i = 0; i < 3; ++i) {
      columns["j" + number + axes[static_cast<std::size_t>(i)]] = of_solute(
          solute, [i](const Average& a, Index k) { return a.solute_flux(i, k); });
    }
  };
  for (Index i = 0; i < 3; ++i) {
    const std::string axis = axes[static_cast<std::size_t>(i)];
    columns["w" + axis] = [i](const Average& a, const Material&) { return a.solvent_flux[i]; };
    columns["s" + axis] = [i](const Average& a, const Material&) { return a.stress(i, i); };
  }
  if (solutes > 0) add_solute(0, "");
  for (int k = 0; k < solutes; ++k) add_solute(k, std::to_string(k + 1));
  return columns;
}

}  // namespace standalone
