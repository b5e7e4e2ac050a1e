/// Loads at nodes as unknowns of the linear system alone.
///
/// A load couples all nodes around its own with each other: its part of the tangent is a product of two vectors, work
/// factor variation^T. The change of the load as one more unknown z gives the same equations in mixed form,
///
///     | T       column   | | du |   | r |
///     | row^T   diagonal | | z  | = | 0 |
///
/// and hold two vectors in place of their product. Eliminating z gives T + work factor variation^T, so that du is the
/// same.
#pragma once

#include "contact/base/patch.h"

/// The terms that a load adds to the tangent in mixed form.
struct MixedForm {
  mixture_contact::VectorXd column;  ///< by z, of the size of LoadBlock::work
  mixture_contact::VectorXd row;     ///< of the equation of z, of the size of LoadBlock::variation; of length 1
  double diagonal = 0;
  double load = 0;  ///< of z = 1
};

/// z is in units of du, and so small compared with it that the norms of increments which a solver tests are
/// those without z: its square is lost in the rounding of theirs.
inline constexpr double load_unknown_scale = 1e-9;

/// Whether a load has a mixed form: a load without variables has none.
inline bool has_mixed_form(const mixture_contact::LoadBlock& load) { return load.variation.squaredNorm() != 0; }

/// The mixed form of a load that has one.
MixedForm mixed_form(const mixture_contact::LoadBlock& load);
