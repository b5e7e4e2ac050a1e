/// Back substitutions with FEBio's linear solver.
#pragma once

#include <vector>

class LinearSolver;

namespace newton {

/// Replaces right-hand sides of the same length by their solutions. Returns false if the linear solver fails. FEBio's
/// `pardiso` solves for all of them at once: it reads its factors once, and the reading takes most of the time of a
/// single solution.
bool back_substitute(LinearSolver& solver, std::vector<std::vector<double>>& vectors);

}  // namespace newton
