#include "interface/load_rounding.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mixture_contact {
namespace {

/// The rounding error of the largest coordinate [mm].
double rounding_of(const PerSide<SurfaceFields>& fields) {
  double largest = 0;
  for (const Side side : both_sides) largest = std::max(largest, fields[side].position.cwiseAbs().maxCoeff());
  return std::numeric_limits<double>::epsilon() * largest;
}

}  // namespace

double load_rounding_square(const ContactInterface& contact, const PerSide<SurfaceFields>& fields) {
  if (!contact.effects().traction) return 0;
  const double rounding = rounding_of(fields);
  double sum = 0;
  for (std::size_t n = 0; n < contact.passes(); ++n) {
    const ContactPass& pass = contact.pass(n);
    if (pass.space().has_unknown_multipliers()) continue;
    const VectorXd area = pass.nodal_loads(seen_from(both_sides.at(n), fields)).area;
    for (Index node = 0; node < area.size(); ++node)
      sum += 2 * std::pow(pass.laws().traction_penalty(node) * rounding * area[node], 2);
  }
  return sum;
}

}  // namespace mixture_contact
