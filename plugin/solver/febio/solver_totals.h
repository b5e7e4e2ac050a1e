/// The total changes since the start of a step in FEBio's solvers.
///
/// FEBio's solvers store the total change per equation. Those of FEBioMix store it a second time by variables, in
/// another order. Convergence tests compare an increment with these totals.
#pragma once

#include <vector>

class FENewtonSolver;

/// True if set_totals() can set all totals of a solver, as for those of the modules solid, biphasic, solute and
/// multiphasic.
bool has_known_totals(const FENewtonSolver& solver);

/// Sets all totals of the solver. `change`: total change per equation.
void set_totals(FENewtonSolver& solver, const std::vector<double>& change);

/// Makes the solver begin a step at the present nodal values, for any earlier numbering of the unknowns.
void begin_at_nodal_values(FENewtonSolver& solver);
