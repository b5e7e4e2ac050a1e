/// Back substitutions with FEBio's linear solver.
#pragma once

#include <Eigen/Core>

class LinearSolver;

namespace newton {

/// Solves for right-hand sides, which are the columns of a matrix. Returns a matrix without entries if the linear
/// solver fails. FEBio's `pardiso` solves for all of them at once: it reads its factors once, and the reading takes
/// most of the time of a single solution.
Eigen::MatrixXd back_substitute(LinearSolver& solver, Eigen::MatrixXd rights);

}  // namespace newton
