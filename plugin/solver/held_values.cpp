#include "held_values.h"

namespace newton {

bool hold_at(Solver& solver, Place place, double value) {
  const int code = solver.equation(place);
  const bool changed = code >= 0 || solver.value(place) != value;
  if (code >= 0) solver.set_equation(place, prescribed(code));
  solver.set_value(place, value);
  return changed;
}

bool make_free(Solver& solver, Place place) {
  const int code = solver.equation(place);
  if (code >= 0) return false;
  solver.set_equation(place, prescribed(code));
  return true;
}

bool release_with_value(Solver& solver, Place place) {
  if (!make_free(solver, place)) return false;
  synchronise(solver, place);
  return true;
}

void synchronise(Solver& solver, Place place) {
  const int equation = solver.equation(place);
  if (equation < 0 || !solver.is_newton()) return;
  const Vectors vectors = solver.vectors();
  if (vectors.total.empty()) return;
  at(vectors.total, equation) = solver.value(place) - at(vectors.change, equation);
}

}  // namespace newton
