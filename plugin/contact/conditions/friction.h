/// Coulomb friction in which the fluid bears a part of the load (Ateshian, Wang and Lai 1998, J Tribol 120:241-248).
/// The bound is linear in the traction and in the fluid pressure.
#pragma once

#include "base/effects.h"
#include "base/settings.h"
#include "base/types.h"

namespace mixture_contact {

/// The result of `frictionless` or of `with_friction`, by the tangential condition of a contact.
template <class Result, class Frictionless, class WithFriction>
Result by_friction(FrictionKind kind, const Frictionless& frictionless, const WithFriction& with_friction) {
  if (kind == FrictionKind::none) return frictionless();
  return with_friction();
}

/// The friction bound T_max and its derivatives.
struct FrictionBound {
  double value;
  double d_traction;  ///< derivative with respect to the normal traction t_n
  double d_pressure;  ///< derivative with respect to the excess pressure p~ - p*
};

/// The bound T_max = mu <-t_n - (1 - phi) (p~ - p*)> [MPa], where <x> = max(0, x). `normal_traction`: t_n, negative in
/// compression [MPa]. `excess_pressure`: p~ - p*, fluid pressure minus ambient pressure [MPa]. mu is the coefficient
/// after the fluid pressure has subsided. The formula has no quotient: T_max tends to 0 with t_n and p~ - p* at first
/// touch.
FrictionBound friction_bound(const FrictionRule& rule, double normal_traction, double excess_pressure);

/// The bound without <>: mu (-t_n - (1 - phi) (p~ - p*)) [MPa]. It is negative if no load presses the solids together.
FrictionBound linear_friction_bound(const FrictionRule& rule, double normal_traction, double excess_pressure);

/// A friction traction and its derivatives.
struct FrictionTraction {
  Vector3d value;
  Eigen::Matrix3d d_trial;  ///< derivative with respect to the trial traction tau
  Vector3d d_bound;         ///< derivative with respect to the friction bound T_max
};

/// The friction of a sticking node: t_T = tau.
FrictionTraction stick(const Vector3d& trial);

/// The friction of a sliding node: t_T = T_max tau/|tau|; zero if tau is zero.
FrictionTraction slip(const Vector3d& trial, double bound);

/// The friction of a sliding node in an iteration that began at the trial traction `reference` with the bound
/// `reference_bound`. The direction of slip varies with the trial to first order and never reverses. Otherwise, with a
/// large penalty, a slip slightly beyond zero would reverse the direction, and Newton's method would alternate between
/// two directions of slip around stick.
FrictionTraction slip(const Vector3d& trial, double bound, const Vector3d& reference, double reference_bound);

/// The excess over the bound of a sliding node's trial, along its direction at the start of the iteration [MPa]. A node
/// without excess sticks, even if it would now slide in the opposite direction.
double slip_excess(const Vector3d& trial, double bound, const Vector3d& reference);

/// The energy per area that slip dissipates [mJ/mm^2]: T_max times the slip without the elastic slip of the penalty,
/// (|tau| - T_max)/eps. It is never negative, and 0 in stick.
double dissipated(const Vector3d& trial, double bound, double penalty);

}  // namespace mixture_contact
