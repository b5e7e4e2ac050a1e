/// The changes since the start of a step in FEBio's solvers.
///
/// They keep it per equation, and those of FEBioMix once more for each variable, in an order of their own. Their
/// convergence tests compare an increment with these totals.
#pragma once

#include <vector>

class FENewtonSolver;

/// Whether the solver is one whose totals are known: those of the modules solid, biphasic, solute and multiphasic.
bool has_known_totals(const FENewtonSolver& solver);

/// Sets the totals of such a solver to the change given per equation.
void set_totals(FENewtonSolver& solver, const std::vector<double>& change);

/// Has the solver begin a step at the present nodal values, whatever the numbers of the unknowns were before.
void begin_at_nodal_values(FENewtonSolver& solver);
