/// Enforcement by penalties with friction, and the choice between penalties with and without friction.
#pragma once

#include "enforcement/penalty_method.h"

namespace mixture_contact {

/// The method of a contact with friction. The load of a node is a vector, whose tangent is no product of two vectors.
class FrictionPenalty final : public PenaltyMethod {
 public:
  bool is_linear() const override { return false; }
  bool has_load_blocks() const override { return false; }

 protected:
  void add_traction_tangent(const PassNodes& at, Index node, const NodeLinearisation& linear, const NodalLoads& loads,
                            ScopedTimer& laps, NodeTangent& tangent) const override;
};

/// The penalty method of a contact.
std::unique_ptr<EnforcementMethod> penalty_method(FrictionKind friction);

}  // namespace mixture_contact
