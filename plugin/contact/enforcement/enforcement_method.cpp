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
  TangentBlock block{patch, {}, std::move(values)};
  set_traction_block(space, block);
  return block;
}

void set_traction_block(const MortarSpace& space, TangentBlock& block) {
  if (space.symmetric()) block.values = 0.5 * (block.values + block.values.transpose()).eval();
  block.rows.fields.clear();
  block.rows.displacements = true;
  block.columns = block.rows;
}

}  // namespace mixture_contact
