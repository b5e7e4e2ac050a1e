#include "node_equations.h"

#include "bound_contact.h"
#include "contact/base/parallel.h"
#include "contact/interface/multipliers.h"
#include "solver/solver.h"

#include <algorithm>
#include <iterator>
#include <utility>

using namespace mixture_contact;

namespace {

/// Equations of some degrees of freedom at a node; -1 for those that the model does not have.
std::array<int, 3> equations_at(const FENode& node, const std::array<int, 3>& dofs) {
  std::array<int, 3> equations{-1, -1, -1};
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    if (mixture_contact::at(dofs, i) >= 0)
      mixture_contact::at(equations, i) = mixture_contact::at(node.m_ID, mixture_contact::at(dofs, i));
  }
  return equations;
}

/// Sets the equations of a sliding contact's multipliers. `first`: the first of these equations.
void fill_multipliers(const ContactInterface& core, int first, const Patch& patch, int node, std::vector<int>& ids) {
  const LocalLayout layout = patch.layout();
  const MultiplierLayout own = multiplier_layout(core);
  if (layout.has_displacements())
    mixture_contact::at(ids, layout.traction_multiplier()) = first + indexing::as_int(own.traction(node));
  for (Index k = 0; k < layout.scalar_fields(); ++k)
    mixture_contact::at(ids, layout.flux_multiplier(k)) = first + indexing::as_int(own.flux(node, patch.fields[k]));
}

}  // namespace

NodeEquations::NodeEquations(const BoundContact& contact)
    : NodeEquations(contact.dofs(), contact.core().effects(),
                    [&contact](const Patch& patch, int node, std::vector<int>& ids) {
                      fill_multipliers(contact.core(), contact.dofs().first_multiplier(), patch, node, ids);
                    }) {}

NodeEquations::NodeEquations(const DofMap& dofs, Effects effects, FillMultipliers fill_multipliers)
    : dofs_(dofs),
      constraints_(dofs.fem()),
      effects_(std::move(effects)),
      fill_multipliers_(std::move(fill_multipliers)) {
  for (const Side side : both_sides) of_[side] = of_surface(dofs.surfaces()[side], side);
}

NodeEquations::Surface NodeEquations::of_surface(FEMixtureSurface& surface, Side side) const {
  const int fields = effects_.nodal_fields();
  std::vector<int> field_dofs;
  for (int k = 0; k < fields; ++k) field_dofs.push_back(dofs_.field(side, effects_, k));
  const int count = surface.Nodes();
  Surface found{&surface, Eigen::MatrixXi(Surface::displacements + fields, count)};
  in_parallel(count, [&](Index i) {
    const FENode& node = surface.Node(indexing::as_int(i));
    const std::array<int, 3> displacements = equations_at(node, dofs_.displacements(side, node));
    std::copy(displacements.begin(), displacements.end(), found.equations.col(i).begin());
    for (int k = 0; k < fields; ++k)
      found.equations(Surface::displacements + k, i) = mixture_contact::at(node.m_ID,
                                                                           mixture_contact::at(field_dofs, k));
  });
  return found;
}

template <class Use>
void NodeEquations::for_each_node(const Location& at, const Use& use) const {
  for (const int node : at.patch.primary) use(of_[at.first], node);
  for (const int node : at.patch.secondary) use(of_[other(at.first)], node);
}

std::vector<int> NodeEquations::nodes(const Location& at) const {
  std::vector<int> nodes;
  nodes.reserve(at.patch.primary.size() + at.patch.secondary.size() + 1);
  for_each_node(at, [&](const Surface& surface, int node) { nodes.push_back(surface.mesh_node(node)); });
  if (at.patch.multiplier_node) nodes.push_back(dofs_.multiplier_node());
  return nodes;
}

std::vector<int> NodeEquations::equations(const Location& at) const {
  const LocalLayout layout = at.patch.layout();
  std::vector<int> ids(indexing::entries(layout.size()), -1);
  Index n = 0;
  for_each_node(at, [&](const Surface& surface, int node) {
    for (Index i = 0; layout.has_displacements() && i < 3; ++i)
      mixture_contact::at(ids, layout.displacement(n, i)) = surface.displacement(node, i);
    for (Index k = 0; k < layout.scalar_fields(); ++k)
      mixture_contact::at(ids, layout.scalar(n, k)) = surface.field(node, at.patch.fields[k]);
    ++n;
  });
  if (at.patch.multiplier_node) fill_multipliers_(at.patch, *at.patch.multiplier_node, ids);
  return ids;
}

void NodeEquations::add_followed(const Location& at, std::vector<int>& ids) const {
  if (constraints_.empty()) return;
  for_each_node(at, [&](const Surface& surface, int node) {
    for (int i = 0; i < Surface::displacements; ++i) {
      const auto* const followed = constraints_.of(surface.mesh_node(node), i);
      if (followed == nullptr) continue;
      for (const LinearConstraints::Followed& each : *followed) ids.push_back(each.equation);
    }
  });
}

std::vector<newton::Condition::Entry> NodeEquations::entries(const Location& at, const VectorXd& values) const {
  std::vector<newton::Condition::Entry> found;
  const auto add = [&](int equation, double value) {
    if (equation >= 0) found.push_back({equation, value});
  };
  const std::vector<int> ids = equations(at);
  for (Index i = 0; i < values.size(); ++i) add(mixture_contact::at(ids, i), values[i]);
  if (constraints_.empty() || !at.patch.displacements) return found;
  const LocalLayout layout = at.patch.layout();
  Index n = 0;
  for_each_node(at, [&](const Surface& surface, int node) {
    for (int i = 0; i < Surface::displacements; ++i) {
      const auto* const followed = constraints_.of(surface.mesh_node(node), i);
      if (followed == nullptr) continue;
      for (const auto& [equation, factor] : *followed) add(equation, factor * values[layout.displacement(n, i)]);
    }
    ++n;
  });
  return found;
}

std::vector<int> NodeEquations::coupled(const Location& at) const {
  std::vector<int> ids = equations(at);
  if (at.patch.displacements) {
    for_each_node(at, [&](const Surface& surface, int node) {
      if (!surface.is_rigid(node)) return;
      const std::array<int, 3> rotations = equations_at(surface.febio->Node(node), dofs_.rotations());
      ids.insert(ids.end(), rotations.begin(), rotations.end());
    });
    add_followed(at, ids);
  }
  for (int& id : ids) id = newton::equation_of(id);  // prescribed values also have positions in the matrix
  return ids;
}

std::vector<int> NodeEquations::unknowns(Side surface, int node) const {
  std::vector<int> found;
  if (of_[surface].is_rigid(node)) return found;
  const std::vector<int>& all = of_[surface].febio->Node(node).m_ID;
  std::copy_if(all.begin(), all.end(), std::back_inserter(found), [](int id) { return id >= 0; });
  return found;
}

double NodeEquations::change(const Surface& surface, int node, int i, const std::vector<double>& increment) const {
  const auto of_equation = [&](int equation) { return equation < 0 ? 0.0 : mixture_contact::at(increment, equation); };
  const auto* const followed = constraints_.empty() ? nullptr : constraints_.of(surface.mesh_node(node), i);
  if (followed == nullptr) return of_equation(surface.displacement(node, i));
  double sum = 0;
  for (const auto& [equation, factor] : *followed) sum += factor * of_equation(equation);
  return sum;
}

PerSide<Matrix3Xd> NodeEquations::displacements(const std::vector<double>& increment) const {
  PerSide<Matrix3Xd> found;
  for (const Side side : both_sides) {
    found[side].resize(Surface::displacements, of_[side].equations.cols());
    for (int node = 0; node < found[side].cols(); ++node) {
      for (int i = 0; i < Surface::displacements; ++i) found[side](i, node) = change(of_[side], node, i, increment);
    }
  }
  return found;
}

bool NodeEquations::is_rigid(const Location& at, Index n) const {
  const Side side = n < at.patch.primary.count() ? at.first : other(at.first);
  return of_[side].is_rigid(at.patch.node(n));
}

bool NodeEquations::are_rigid(const Location& at) const {
  bool found = false;
  for_each_node(at, [&](const Surface& surface, int node) { found = found || surface.is_rigid(node); });
  return found;
}
