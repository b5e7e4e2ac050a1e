#include "back_substitution.h"

#include "indexing/entries.h"

#include <FECore/LinearSolver.h>

#include <algorithm>
#include <cstring>

#if __has_include(<NumCore/PardisoSolver.h>)
#include <NumCore/PardisoSolver.h>
#define MIXCONTACT_HAS_PARDISO
#endif

namespace newton {
namespace {

#ifdef MIXCONTACT_HAS_PARDISO
/// FEBio's `pardiso` with access to the number of right-hand sides, for which its interface has no function.
class Pardiso : public PardisoSolver {
 public:
  Pardiso() = delete;
  static int& right_hand_sides(PardisoSolver& solver) { return solver.*(&Pardiso::m_nrhs); }
};

/// FEBio's `pardiso`; null for another linear solver. FEBio does not export the class to a dynamic_cast on all systems.
PardisoSolver* pardiso(LinearSolver& solver) {
  return std::strcmp(solver.GetTypeStr(), "pardiso") == 0 ? static_cast<PardisoSolver*>(&solver) : nullptr;
}

bool solve_together(PardisoSolver& solver, std::vector<std::vector<double>>& vectors) {
  const std::size_t size = vectors.front().size();
  std::vector<double> right;
  right.reserve(size * vectors.size());
  for (const std::vector<double>& each : vectors) right.insert(right.end(), each.begin(), each.end());
  std::vector<double> solution(right.size());
  int& right_hand_sides = Pardiso::right_hand_sides(solver);
  const int before = std::exchange(right_hand_sides, indexing::number_of(vectors));
  const bool is_solved = solver.BackSolve(solution.data(), right.data());
  right_hand_sides = before;
  auto next = solution.begin();
  for (std::vector<double>& each : vectors) {
    std::copy_n(next, size, each.begin());
    next += static_cast<std::ptrdiff_t>(size);
  }
  return is_solved;
}
#endif

bool solve_each(LinearSolver& solver, std::vector<std::vector<double>>& vectors) {
  return std::all_of(vectors.begin(), vectors.end(), [&](std::vector<double>& each) {
    std::vector<double> right = each;
    return solver.BackSolve(each, right);
  });
}

}  // namespace

bool back_substitute(LinearSolver& solver, std::vector<std::vector<double>>& vectors) {
#ifdef MIXCONTACT_HAS_PARDISO
  PardisoSolver* const together = vectors.size() > 1 ? pardiso(solver) : nullptr;
  if (together != nullptr) return solve_together(*together, vectors);
#endif
  return solve_each(solver, vectors);
}

}  // namespace newton
