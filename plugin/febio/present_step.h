/// The method by which FEBio solves the present analysis step.
#pragma once

#include "host/contact_parameters.h"

class FEModel;

/// The solution method of the present step.
SolverKind solver_kind_of(FEModel& fem);
/// True if bodies have inertia in the solver of the present step, which uses a tangent; they have none in the solvers
/// for mixtures.
bool has_inertia(FEModel& fem);
/// The time step in which elements store solvent [s]; 0 for a steady-state analysis.
double storing_time_step(FEModel& fem);
