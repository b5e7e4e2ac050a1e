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

/// T_max = mu <-t_n - (1 - phi) (p~ - p*)>, with the normal traction t_n < 0 in compression and what the pressure of
/// the fluid exceeds the ambient one by [MPa]. mu is the coefficient after the fluid pressure has subsided. No
/// quotient: at first touch, where t_n and p~ - p* tend to 0 together, so does the bound.
FrictionBound friction_bound(const FrictionRule& rule, double normal_traction, double excess_pressure);

/// The bound T_max without <>, mu (-t_n - (1 - phi) (p~ - p*)) [MPa]: linear, and negative where nothing presses the
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

/// Slip within an iteration that began at the trial traction `reference`: the direction varies with the trial as it
/// does there to first order, at the bound `reference_bound`, and never turns round. A large penalty would have it turn
/// where the slip comes out a little beyond zero, and Newton's method alternate between two directions of slip around
/// stick.
FrictionTraction slip(const Vector3d& trial, double bound, const Vector3d& reference, double reference_bound);

/// How far a node that slides is beyond the bound along the direction that its iteration began with: where it is not,
/// the node sticks, also where it would now slide the other way.
double slip_excess(const Vector3d& trial, double bound, const Vector3d& reference);

/// The dissipation of slip per area: T_max times the part of the slip that is not the compliance of the penalty,
/// (|tau| - T_max)/eps; never negative in slip, 0 in stick [mJ/mm^2].
double dissipated(const Vector3d& trial, double bound, double penalty);

}  // namespace mixture_contact
