#include "enforcement/enforcement_method.h"

#include "enforcement/friction_penalty.h"
#include "enforcement/unknown_multipliers.h"

#include <utility>

namespace mixture_contact {

std::unique_ptr<EnforcementMethod> enforcement_method(Enforcement enforcement, FrictionKind friction) {
  if (enforcement == Enforcement::lagrange_multipliers) return std::make_unique<UnknownMultipliers>();
  return penalty_method(friction);
}

Patch flux_columns(const PassNodes& at, const Patch& patch, int field) {
  Patch columns = at.space.columns_of(patch, field);
  if (at.space.symmetric()) return columns;
  const FieldMask drivers = at.laws.scalar(field).drivers();
  for (const int other : patch.fields) {
    if (other != field && contains(drivers, other)) columns.fields.push_back(other);
  }
  return columns;
}

VectorXd flux_row(const FluxLaw& law, Index node, const NodeLinearisation& linear, const Patch& columns,
                  bool symmetric) {
  const LocalLayout layout = columns.layout();
  VectorXd row = VectorXd::Zero(layout.size());
  for (Index k = 0; k < columns.fields.count(); ++k) {
    const int field = columns.fields[k];
    const NodeLinearisation::Jump& jump = linear.jumps[position_in(linear.patch.fields, field)];
    for (Index n = 0; n < layout.nodes(); ++n) {
      row[layout.scalar(n, k)] += law.d_jump[field] * jump.weights[n];
      if (layout.has_displacements())
        row.segment<3>(layout.displacement(n, 0)) += law.d_jump[field] * jump.projection_variation.segment<3>(3 * n);
    }
    const bool has_own = law.d_own[field] != 0 && !symmetric;
    if (has_own) row[layout.scalar(position_in(columns.primary, static_cast<int>(node)), k)] += law.d_own[field];
  }
  return row;
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
