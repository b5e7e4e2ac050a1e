/// Nodal loads as additional unknowns of the linear system.
///
/// A load couples all nodes around its own node: its part of the tangent is a product of two vectors, work factor
/// variation^T. The same equations with the change of the load as an additional unknown z
/// have the mixed form
///
///     | T       column   | | du |   | r |
///     | row^T   diagonal | | z  | = | 0 |
///
/// The matrix then contains two vectors instead of their product. Elimination of z gives T + work factor variation^T,
/// and therefore the same du.
#pragma once

#include "contact/base/patch.h"

/// The terms of a load in the mixed form.
struct MixedForm {
  mixture_contact::VectorXd column;  ///< entries in the column of z, of the size of LoadBlock::work
  /// Entries in the equation of z, of the size of LoadBlock::variation; the vector has norm 1.
  mixture_contact::VectorXd row;
  /// Diagonal entry of z.
  double diagonal = 0;
  double load = 0;  ///< load for z = 1
};

/// The size of z relative to du. Solvers test the norms of increments, to which z must not contribute: its square is
/// below the rounding of theirs.
inline constexpr double load_unknown_scale = 1e-9;

/// True if a load has a mixed form, that is, if it depends on any unknown.
inline bool has_mixed_form(const mixture_contact::LoadBlock& load) { return load.variation.squaredNorm() != 0; }

/// The mixed form of a load, for which has_mixed_form() is true.
MixedForm mixed_form(const mixture_contact::LoadBlock& load);
