/// Conditions between the flux of a scalar field, solvent or solute, and the jumps at a node.
#pragma once

#include "base/effects.h"
#include "conditions/law_value.h"
#include "conditions/nodal_loads.h"

namespace mixture_contact {

/// The enforcement of a condition that is no law of the scene.
struct Enforcing {
  double multiplier = 0;  ///< lambda
  double penalty = 0;     ///< eps
};

/// A flux, positive from the primary to the secondary body, with its derivatives.
struct FluxLaw {
  double value = 0;
  VectorXd d_jump;  ///< with NodalLoads::jump at the node, per field
  VectorXd d_own;   ///< with NodalLoads::own at the node, per field
};

/// The condition of one field. A flux depends on jumps around the node and on the fields' values there: p~ of the
/// solvent [MPa], c~ of solutes [mM].
class ScalarCondition {
 public:
  explicit ScalarCondition(int field) : field_(field) {}
  ScalarCondition(const ScalarCondition&) = delete;
  ScalarCondition& operator=(const ScalarCondition&) = delete;
  ScalarCondition(ScalarCondition&&) = delete;
  ScalarCondition& operator=(ScalarCondition&&) = delete;
  virtual ~ScalarCondition() = default;

  /// Index of the field, in the order of Effects.
  int field() const { return field_; }
  /// Whether the condition is a zero jump, enforced by penalties and multipliers; otherwise the flux is a law of the
  /// scene.
  virtual bool is_enforced() const = 0;
  /// The fields that the flux depends on, its own among them.
  virtual FieldMask drivers() const = 0;
  /// The flux at a node that exchanges the field: [mm/s] for the solvent, [nmol/(mm^2 s)] for solutes.
  virtual FluxLaw flux(const NodalLoads& at, Index node, const Enforcing& by) const = 0;
  /// The flux without its derivatives.
  virtual double value(const NodalLoads& at, Index node, const Enforcing& by) const { return flux(at, node, by).value; }

 private:
  int field_;
};

/// The field is continuous: w_n = lambda_p + eps_p (p1 - p2), eq (2.8), and j_n = lambda_k + eps_k (c1_k - c2_k),
/// eq (2.9).
class Continuous final : public ScalarCondition {
 public:
  using ScalarCondition::ScalarCondition;

  bool is_enforced() const override { return true; }
  FieldMask drivers() const override { return only(field()); }
  FluxLaw flux(const NodalLoads& at, Index node, const Enforcing& by) const override;
  double value(const NodalLoads& at, Index node, const Enforcing& by) const override;
};

}  // namespace mixture_contact
