/// Conditions between the normal traction and the gap: eq (2.7) of Ateshian, Maas and Weiss (2012), and its counterpart
/// for surfaces that may pull. No other file distinguishes the two.
#pragma once

#include "base/settings.h"
#include "base/types.h"
#include "conditions/law_value.h"

#include <algorithm>

namespace mixture_contact {

/// A condition at a node: its load, its next status, and its admissible tractions. `trial` is the augmented load
/// lambda_n + eps_n g of a node [MPa], negative in compression.
class NormalCondition {
 public:
  NormalCondition() = default;
  NormalCondition(const NormalCondition&) = delete;
  NormalCondition& operator=(const NormalCondition&) = delete;
  NormalCondition(NormalCondition&&) = delete;
  NormalCondition& operator=(NormalCondition&&) = delete;
  virtual ~NormalCondition() = default;

  /// t_n [MPa] and its derivative with the gap, for a status: the trial in contact, 0 elsewhere.
  static LawValue load(const LawValue& trial, bool in_contact) { return in_contact ? trial : LawValue{0, 0}; }
  /// The nearest traction that the condition allows [MPa].
  virtual double admissible(double traction) const = 0;

  /// Whether a node that faces the other surface begins in contact. Surfaces no farther apart than `touch` [mm] act on
  /// each other.
  virtual bool begins(const LawValue& trial, double touch) const = 0;
  /// Whether a node in contact stays so; tractions up to `least` [MPa] do not decide.
  virtual bool stays(double traction, double least) const = 0;
  /// Whether a node that faces the other surface comes into contact; overlap loads up to `least` [MPa] do not decide.
  virtual bool closes(double trial, double least) const = 0;
  /// Whether surfaces that face each other may open.
  virtual bool may_part() const = 0;

  /// The residual of the condition at a node in contact [mm].
  virtual double residual_gap(double gap, double traction) const = 0;
  /// Default multiple of the local stiffness. `both_ways`: each side has conditions of its own.
  virtual double penalty_factor(bool both_ways) const = 0;
};

/// t_n = min(0, lambda_n + eps_n g), eq (2.7): surfaces push and open.
class Unilateral final : public NormalCondition {
 public:
  double admissible(double traction) const override { return std::min(0.0, traction); }
  bool begins(const LawValue& trial, double touch) const override;
  bool stays(double traction, double least) const override { return traction <= least; }
  bool closes(double trial, double least) const override { return trial < -least; }
  bool may_part() const override { return true; }
  /// Surfaces that touch without a load meet the condition, g >= 0 and t_n = 0, for any rounding of the gap.
  double residual_gap(double gap, double traction) const override { return traction < 0 ? gap : 0.0; }
  double penalty_factor(bool both_ways) const override;
};

/// t_n = lambda_n + eps_n g wherever the surfaces face each other: they pull as well as push, and slide freely.
class Bilateral final : public NormalCondition {
 public:
  double admissible(double traction) const override { return traction; }
  bool begins(const LawValue& trial, double /*touch*/) const override { return trial.derivative > 0; }
  bool stays(double /*traction*/, double /*least*/) const override { return true; }
  bool closes(double /*trial*/, double /*least*/) const override { return true; }
  bool may_part() const override { return false; }
  double residual_gap(double gap, double /*traction*/) const override { return gap; }
  double penalty_factor(bool both_ways) const override;
};

/// The nearest tractions of nodes that a condition allows [MPa].
VectorXd admissible(const NormalCondition& condition, const VectorXd& tractions);

/// The condition by a user's settings of gaps.
const NormalCondition& normal_condition(const GapRule& gap);

}  // namespace mixture_contact
