#include "solver_totals.h"

#include "solver/solver.h"

#include <FEBioMech/FESolidSolver2.h>
#include <FEBioMix/FEBiphasicSoluteSolver.h>
#include <FEBioMix/FEMultiphasicSolver.h>
#include <FECore/FEMesh.h>
#include <FECore/FEModel.h>

#include <initializer_list>
#include <typeinfo>

namespace {

/// Sets `total` to the changes of some degrees of freedom, node by node and including prescribed ones, from the changes
/// per equation.
void gather(std::vector<double>& total, FEModel& fem, const std::vector<double>& change,
            std::initializer_list<int> dofs) {
  FEMesh& mesh = fem.GetMesh();
  auto entry = total.begin();
  for (int i = 0; i < mesh.Nodes(); ++i) {
    for (const int dof : dofs) {
      const int equation = dof < 0 ? -1 : newton::equation_of(indexing::at(mesh.Node(i).m_ID, dof));
      if (equation == -1 || entry == total.end()) continue;
      *entry++ = indexing::at(change, equation);
    }
  }
}

void gather_displacements_and_pressure(std::vector<double>& displacements, std::vector<double>& pressures, FEModel& fem,
                                       const std::vector<double>& change) {
  const auto dof = [&](const char* name) { return fem.GetDOFIndex(name); };
  gather(displacements, fem, change, {dof("x"), dof("y"), dof("z"), dof("sx"), dof("sy"), dof("sz")});
  gather(pressures, fem, change, {dof("p"), dof("q")});
}

void gather_concentrations(std::vector<std::vector<double>>& concentrations, FEModel& fem,
                           const std::vector<double>& change) {
  for (int k = 0; k < indexing::number_of(concentrations); ++k) {
    const auto dof = [&](const char* variable) { return fem.GetDOFIndex(variable, k); };
    gather(indexing::at(concentrations, k), fem, change, {dof("concentration"), dof("shell concentration")});
  }
}

}  // namespace

bool has_known_totals(const FENewtonSolver& solver) {
  const std::type_info& type = typeid(solver);
  return type == typeid(FESolidSolver2) || type == typeid(FEBiphasicSolver) || type == typeid(FEBiphasicSoluteSolver) ||
         type == typeid(FEMultiphasicSolver);
}

void set_totals(FENewtonSolver& solver, const std::vector<double>& change) {
  FEModel& fem = *solver.GetFEModel();
  solver.m_Ui = change;
  if (auto* multiphasic = dynamic_cast<FEMultiphasicSolver*>(&solver)) {
    gather_displacements_and_pressure(multiphasic->m_Di, multiphasic->m_Pi, fem, change);
    gather_concentrations(multiphasic->m_Ci, fem, change);
  } else if (auto* biphasic = dynamic_cast<FEBiphasicSolver*>(&solver)) {
    gather_displacements_and_pressure(biphasic->m_Di, biphasic->m_Pi, fem, change);
    if (auto* solute = dynamic_cast<FEBiphasicSoluteSolver*>(biphasic))
      gather_concentrations(solute->m_Ci, fem, change);
  }
}

void begin_at_nodal_values(FENewtonSolver& solver) {
  solver.m_Ut.assign(solver.m_ui.size(), 0);
  solver.m_Ui.assign(solver.m_ui.size(), 0);
  FEMesh& mesh = solver.GetFEModel()->GetMesh();
  for (int i = 0; i < mesh.Nodes(); ++i) {
    const FENode& node = mesh.Node(i);
    for (int dof = 0; dof < node.dofs(); ++dof) {
      const int equation = newton::equation_of(indexing::at(node.m_ID, dof));
      if (equation >= 0) indexing::at(solver.m_Ut, equation) = node.get(dof);
    }
  }
}
