/// Conditions between the flux of a scalar field (solvent or solute) and its jump at a node.
#pragma once

#include "base/effects.h"
#include "base/polymorphic.h"
#include "conditions/law_value.h"
#include "conditions/nodal_loads.h"

namespace mixture_contact {

/// The multiplier and penalty that enforce a condition at a node.
struct Enforcing {
  double multiplier = 0;  ///< multiplier lambda
  double penalty = 0;     ///< penalty eps
};

/// A flux from the primary to the secondary body, with its derivatives.
struct FluxLaw {
  double value = 0;
  VectorXd d_jump;  ///< derivatives with respect to NodalLoads::jump at the node, per field
  VectorXd d_own;   ///< derivatives with respect to NodalLoads::own at the node, per field
};

/// The condition of one field at nodes. Its flux depends on the jumps around the node and on the values of the fields
/// at the node: p~ of the solvent [MPa], c~ of solutes [mM].
class ScalarCondition : public Polymorphic {
 public:
  explicit ScalarCondition(int field) : field_(field) {}

  /// Index of the field, in the order of Effects.
  int field() const { return field_; }
  /// True if the condition is a zero jump, enforced by penalties and multipliers; false if the flux follows a law, as
  /// that of a membrane.
  virtual bool is_enforced() const = 0;
  /// The fields on which the flux depends, including its own.
  virtual FieldMask drivers() const = 0;
  /// The flux at a node that exchanges the field: [mm/s] for the solvent, [nmol/(mm^2 s)] for solutes. `by`: multiplier
  /// and penalty.
  virtual FluxLaw flux(const NodalLoads& at, Index node, const Enforcing& by) const = 0;
  /// The flux without its derivatives.
  virtual double value(const NodalLoads& at, Index node, const Enforcing& by) const { return flux(at, node, by).value; }

 private:
  int field_;
};

/// Continuity of the field, enforced by w_n = lambda_p + eps_p (p1 - p2), eq (2.8), or j_n = lambda_k + eps_k (c1_k -
/// c2_k), eq (2.9).
class Continuous final : public ScalarCondition {
 public:
  using ScalarCondition::ScalarCondition;

  bool is_enforced() const override { return true; }
  FieldMask drivers() const override { return only(field()); }
  FluxLaw flux(const NodalLoads& at, Index node, const Enforcing& by) const override;
  double value(const NodalLoads& at, Index node, const Enforcing& by) const override;
};

}  // namespace mixture_contact
