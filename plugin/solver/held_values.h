/// Nodal values that are switched between free and held.
///
/// FEBio takes a value with equation n as prescribed while its code is -n-2. No equation is renumbered.
#pragma once

#include "solver.h"

namespace newton {

/// Holds a value. Returns whether anything changed.
bool hold_at(Solver& solver, Place place, double value);

/// Makes a held value free; the solver's vectors are left as they are. Returns whether it was held.
bool make_free(Solver& solver, Place place);

/// Makes a held value free, with the value it has now, in the node and in the solver's vectors: otherwise the solver
/// would set it to its last value in these vectors. Returns whether it was held.
bool release_with_value(Solver& solver, Place place);

/// Brings the solver's vectors in step with the nodal value, where it is free.
void synchronise(Solver& solver, Place place);

}  // namespace newton
