#include "clamped_concentrations.h"

#include "ambient_nodes.h"
#include "equation.h"

#include <FEBioMix/FEBiphasicSoluteSolver.h>
#include <FEBioMix/FEMultiphasicSolver.h>
#include <FECore/FEAnalysis.h>
#include <FECore/FEMesh.h>
#include <FECore/FEModel.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace {

/// Concentrations below this part of the largest one, and reactions likewise, do not decide.
constexpr double negligible = 1e-6;

/// The solver, if it clamps concentrations, and its nodal reactions.
struct ClampingSolver {
  FENewtonSolver* newton = nullptr;
  const std::vector<double>* reaction = nullptr;
};

ClampingSolver clamping_solver(FEModel& fem) {
  FESolver* solver = fem.GetCurrentStep()->GetFESolver();
  if (auto* solute = dynamic_cast<FEBiphasicSoluteSolver*>(solver)) return {solute, &solute->m_Fr};
  auto* multiphasic = dynamic_cast<FEMultiphasicSolver*>(solver);
  if (multiphasic != nullptr && multiphasic->m_forcePositive) return {multiphasic, &multiphasic->m_Fr};
  return {};
}

}  // namespace

std::vector<ClampedConcentrations::Place> ClampedConcentrations::negative() const {
  std::vector<Place> places;
  const ClampingSolver solver = clamping_solver(fem_);
  if (solver.newton == nullptr) return places;
  FEMesh& mesh = fem_.GetMesh();
  const int first = fem_.GetDOFIndex("concentration", 0);
  const int solutes = fem_.GetDOFS().GetVariableSize("concentration");
  for (int dof = first; dof < first + solutes; ++dof) {
    double largest = 0;
    for (int i = 0; i < mesh.Nodes(); ++i) largest = std::max(largest, std::abs(mesh.Node(i).get(dof)));
    for (int i = 0; i < mesh.Nodes(); ++i) {
      const int id = mesh.Node(i).m_ID[static_cast<std::size_t>(dof)];
      if (id < 0) continue;
      const auto n = static_cast<std::size_t>(id);
      if (solver.newton->m_Ut[n] + solver.newton->m_Ui[n] < -negligible * largest)
        places.emplace_back(&mesh.Node(i), dof);
    }
  }
  return places;
}

std::vector<ClampedConcentrations::Place> ClampedConcentrations::rising() const {
  // FEBio's reaction is minus the residual of the node's balance, and in FEBio's sign the residual of a solute falls
  // where solute comes in: a positive reaction drives the concentration up. Each is freed once a step at the most, so
  // that none comes and goes for ever.
  std::vector<Place> places;
  const ClampingSolver solver = clamping_solver(fem_);
  if (solver.reaction == nullptr) return places;
  const auto reaction = [&](const Place& place) {
    const int id = place.first->m_ID[static_cast<std::size_t>(place.second)];
    return id < 0 ? (*solver.reaction)[static_cast<std::size_t>(prescribed(id))] : 0.0;
  };
  double largest = 0;
  for (const Place& place : held_) largest = std::max(largest, std::abs(reaction(place)));
  std::copy_if(held_.begin(), held_.end(), std::back_inserter(places),
               [&](const Place& place) { return reaction(place) > negligible * largest && freed_.count(place) == 0; });
  return places;
}

bool ClampedConcentrations::settled() const { return negative().empty() && rising().empty(); }

bool ClampedConcentrations::update() {
  const ClampingSolver solver = clamping_solver(fem_);
  if (solver.newton == nullptr) return false;
  const std::vector<Place> to_free = rising();
  const std::vector<Place> to_hold = negative();
  for (const Place& place : to_free) {
    AmbientNodes::release_with_value(*solver.newton, *place.first, place.second);
    forget(*place.first, place.second);
    freed_.insert(place);
  }
  for (const Place& place : to_hold) {
    AmbientNodes::hold_at(*place.first, place.second, 0.0);
    held_.push_back(place);
  }
  return !to_free.empty() || !to_hold.empty();
}

bool ClampedConcentrations::update_at_new_state() {
  const ClampingSolver solver = clamping_solver(fem_);
  if (solver.newton == nullptr) return false;
  if (!held_.empty()) {  // reactions are theirs
    std::vector<double> residual(solver.newton->m_R0.size());
    solver.newton->Residual(residual);
  }
  return update();
}

bool ClampedConcentrations::holds(const FENode& node, int dof) const {
  return std::any_of(held_.begin(), held_.end(),
                     [&](const Place& place) { return place.first == &node && place.second == dof; });
}

void ClampedConcentrations::forget(const FENode& node, int dof) {
  held_.erase(std::remove_if(held_.begin(), held_.end(),
                             [&](const Place& place) { return place.first == &node && place.second == dof; }),
              held_.end());
}

void ClampedConcentrations::release() {
  const ClampingSolver solver = clamping_solver(fem_);
  if (solver.newton != nullptr) {
    for (const auto& [node, dof] : held_) AmbientNodes::release_with_value(*solver.newton, *node, dof);
    // Those freed in an attempt that was cut back have the value of the step's start again.
    for (const auto& [node, dof] : freed_) AmbientNodes::synchronise(*solver.newton, *node, dof);
  }
  held_.clear();
  freed_.clear();
}

void ClampedConcentrations::resume() {
  for (const auto& [node, dof] : last_) {
    const bool is_free = node->m_ID[static_cast<std::size_t>(dof)] >= 0;
    if (!is_free || node->get(dof) != 0) continue;
    AmbientNodes::hold_at(*node, dof, 0.0);
    held_.emplace_back(node, dof);
  }
}

void ClampedConcentrations::end_step() {
  last_ = held_;
  const ClampingSolver solver = clamping_solver(fem_);
  for (const auto& [node, dof] : held_) {
    if (solver.newton == nullptr || !AmbientNodes::make_free(*node, dof)) continue;
    // FEBio has added the step's increments to its solution vector already.
    const int equation = node->m_ID[static_cast<std::size_t>(dof)];
    solver.newton->m_Ut[static_cast<std::size_t>(equation)] = node->get(dof);
  }
  held_.clear();
  freed_.clear();
}
