/// Friction with the load that the fluid bears (Ateshian, Wang and Lai 1998, J Tribol 120:241-248), as a bound that is
/// linear in both loads: value and derivatives.
#pragma once

#include "base/settings.h"
#include "base/types.h"

namespace mixture_contact {

/// The largest friction and its derivatives.
struct FrictionBound {
  double value;
  double d_traction;  ///< with t_n
  double d_pressure;  ///< with p~
};

/// T_max = mu <-t_n - (1 - phi) (p~ - p*)>, with the normal traction t_n < 0 in compression and the excess p~ - p* of
/// the fluid pressure over the ambient one [MPa]. mu is the coefficient after the fluid pressure has subsided. The
/// bound has no quotient: it tends to 0 with t_n and p~ - p* at first touch.
FrictionBound friction_bound(const FrictionRule& rule, double normal_traction, double excess_pressure);

/// The bound T_max without <>, mu (-t_n - (1 - phi) (p~ - p*)) [MPa]: linear, and negative if no load presses the
/// solids together.
FrictionBound linear_friction_bound(const FrictionRule& rule, double normal_traction, double excess_pressure);

/// A friction traction and its derivatives.
struct FrictionTraction {
  Vector3d value;
  Eigen::Matrix3d d_trial;  ///< with the trial traction tau
  Vector3d d_bound;         ///< with T_max
};

/// Stick: t_T = tau.
FrictionTraction stick(const Vector3d& trial);

/// Slip: t_T = T_max tau/|tau|; zero where the trial has no direction.
FrictionTraction slip(const Vector3d& trial, double bound);

/// Slip within an iteration that began at the trial traction `reference`: the direction varies with the trial to first
/// order, at the bound `reference_bound`, and never reverses. With a large penalty, a slip slightly beyond zero would
/// reverse it, and Newton's method would alternate between two directions of slip around stick.
FrictionTraction slip(const Vector3d& trial, double bound, const Vector3d& reference, double reference_bound);

/// The excess of a sliding node over the bound along the initial direction of its iteration. A node without excess
/// sticks, even if it would now slide in the opposite direction.
double slip_excess(const Vector3d& trial, double bound, const Vector3d& reference);

/// The dissipation of slip per area: T_max times the part of the slip that is not the compliance of the penalty,
/// (|tau| - T_max)/eps; never negative in slip, 0 in stick [mJ/mm^2].
double dissipated(const Vector3d& trial, double bound, double penalty);

}  // namespace mixture_contact
