/// Switching of nodal values between free and prescribed.
///
/// FEBio treats a value with equation n as prescribed if its code is -n-2. Switching does not renumber equations.
#pragma once

#include "solver.h"

namespace newton {

/// Prescribes a value. Returns true if anything changed.
bool hold_at(Solver& solver, Place place, double value);

/// Frees a prescribed value without a change of the solver's vectors. Returns true if the value was prescribed.
bool make_free(Solver& solver, Place place);

/// Frees a prescribed value, which keeps its present value. It also sets this value in the solver's vectors, to whose
/// values the solver would otherwise reset it. Returns true if the value was prescribed.
bool release_with_value(Solver& solver, Place place);

/// Sets the entries of a free value in the solver's vectors to the present nodal value. A solver whose analysis step
/// begins has no vectors yet, and makes them from the nodal values.
void synchronise(Solver& solver, Place place);

}  // namespace newton
