#include "enforcement/enforcement_method.h"

#include "enforcement/penalty_method.h"
#include "enforcement/unknown_multipliers.h"

#include <utility>

namespace mixture_contact {

std::unique_ptr<EnforcementMethod> enforcement_method(Enforcement enforcement, const MortarSpace& space,
                                                      const NodalLaws& laws) {
  if (enforcement == Enforcement::lagrange_multipliers) return std::make_unique<UnknownMultipliers>(space, laws);
  return std::make_unique<PenaltyMethod>(space, laws);
}

TangentBlock traction_block(const MortarSpace& space, const Patch& patch, MatrixXd values) {
  if (space.symmetric()) values = 0.5 * (values + values.transpose()).eval();
  Patch rows = patch.of_displacements();
  Patch columns = rows;
  return {std::move(rows), std::move(columns), std::move(values)};
}

}  // namespace mixture_contact
