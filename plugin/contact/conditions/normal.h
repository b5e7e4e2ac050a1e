/// Conditions between the normal traction and the gap: eq (2.7) of Ateshian, Maas and Weiss (2012), and its counterpart
/// for surfaces that bear tension. No other file distinguishes the two conditions.
#pragma once

#include "base/polymorphic.h"
#include "base/settings.h"
#include "base/types.h"
#include "conditions/law_value.h"

#include <algorithm>

namespace mixture_contact {

/// The normal condition at a node: load, next status, and admissible tractions. In all functions, `trial` is the
/// augmented load lambda_n + eps_n g of a node [MPa], negative in compression.
class NormalCondition : public Polymorphic {
 public:
  /// The normal traction t_n [MPa] and its derivative with respect to the gap: the trial in contact, 0 elsewhere.
  static LawValue load(const LawValue& trial, bool in_contact) { return in_contact ? trial : LawValue{0, 0}; }
  /// The admissible traction that is nearest to `traction` [MPa].
  virtual double admissible(double traction) const = 0;

  /// True if a node that faces the other surface is in contact in the initial state. Surfaces count as touching up to a
  /// gap of `touch` [mm].
  virtual bool begins(const LawValue& trial, double touch) const = 0;
  /// True if a node in contact remains in contact. `least`: tractions up to this value do not change the status [MPa].
  virtual bool stays(double traction, double least) const = 0;
  /// True if an open node that faces the other surface comes into contact. `least`: overlap loads up to this value do
  /// not change the status [MPa].
  virtual bool closes(double trial, double least) const = 0;
  /// True if surfaces that face each other may open.
  virtual bool may_part() const = 0;

  /// The error of a node in contact in the condition [mm].
  virtual double residual_gap(double gap, double traction) const = 0;
  /// Default penalty factor on the local stiffness. `both_ways`: both surfaces have conditions of their own.
  virtual double penalty_factor(bool both_ways) const = 0;
};

/// Unilateral contact, eq (2.7): t_n = min(0, lambda_n + eps_n g). The surfaces transmit compression only and may open.
class Unilateral final : public NormalCondition {
 public:
  double admissible(double traction) const override { return std::min(0.0, traction); }
  bool begins(const LawValue& trial, double touch) const override;
  bool stays(double traction, double least) const override { return traction <= least; }
  bool closes(double trial, double least) const override { return trial < -least; }
  bool may_part() const override { return true; }
  /// Zero without traction: surfaces that touch without load meet the condition (g >= 0 and t_n = 0) for any rounding
  /// of the gap.
  double residual_gap(double gap, double traction) const override { return traction < 0 ? gap : 0.0; }
  double penalty_factor(bool both_ways) const override;
};

/// Bilateral contact: t_n = lambda_n + eps_n g wherever the surfaces face each other. They transmit tension and
/// compression, and slide freely.
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

/// The admissible tractions nearest to those given [MPa].
VectorXd admissible(const NormalCondition& condition, const VectorXd& tractions);

/// The condition for the user's gap settings.
const NormalCondition& normal_condition(const GapRule& gap);

}  // namespace mixture_contact
