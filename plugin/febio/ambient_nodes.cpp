#include "ambient_nodes.h"

#include "equation.h"

#include <FECore/DOFS.h>
#include <FECore/FEAnalysis.h>
#include <FECore/FEModel.h>

FENewtonSolver* AmbientNodes::solver() const {
  return dynamic_cast<FENewtonSolver*>(fem_.GetCurrentStep()->GetFESolver());
}

bool AmbientNodes::is_free(const FENode& node, int dof) {
  return dof >= 0 && node.get_bc(dof) == DOF_OPEN && node.m_ID[static_cast<std::size_t>(dof)] != -1;
}

bool AmbientNodes::hold_at(FENode& node, int dof, double value) {
  int& id = node.m_ID[static_cast<std::size_t>(dof)];
  const bool changed = id >= 0 || node.get(dof) != value;
  if (id >= 0) id = prescribed(id);
  node.set(dof, value);
  return changed;
}

bool AmbientNodes::make_free(FENode& node, int dof) {
  int& id = node.m_ID[static_cast<std::size_t>(dof)];
  if (id >= 0) return false;
  id = prescribed(id);
  return true;
}

bool AmbientNodes::release_with_value(FENewtonSolver& newton, FENode& node, int dof) {
  if (!make_free(node, dof)) return false;
  synchronise(newton, node, dof);
  return true;
}

bool AmbientNodes::release(FENode& node, int dof) {
  FENewtonSolver* newton = solver();
  if (newton == nullptr || !release_with_value(*newton, node, dof)) return false;
  released_.emplace_back(&node, dof);
  return true;
}

void AmbientNodes::synchronise(FENewtonSolver& newton, const FENode& node, int dof) {
  const int id = node.m_ID[static_cast<std::size_t>(dof)];
  if (id < 0) return;
  const auto n = static_cast<std::size_t>(id);
  newton.m_Ut[n] = node.get(dof) - newton.m_Ui[n];
}

void AmbientNodes::synchronise() {
  FENewtonSolver* newton = solver();
  for (const auto& [node, dof] : released_) {
    if (newton != nullptr) synchronise(*newton, *node, dof);
  }
  released_.clear();
}
