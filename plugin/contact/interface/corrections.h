/// Functions of a contact for a host that keeps its matrix for several iterations.
#pragma once

#include "enforcement/moving_geometry.h"
#include "interface/interface.h"

namespace mixture_contact {

/// True if the next iteration can use the corrected linearisation of the last matrix (see HeldLinearisation::serves()).
/// If no pass can be corrected, true if the state is a solution.
bool serves_again(const ContactInterface& contact, const PerSide<SurfaceFields>& fields);

/// Begins an iteration with the corrected linearisation of the last one (see HeldLinearisation::correct()). Returns
/// true if loads change.
bool correct(const ContactInterface& contact, const PerSide<SurfaceFields>& fields);

/// Adds the residual of the change of the loads at the start of the iteration (see
/// HeldLinearisation::residual_change()). Returns false if the change is unknown.
bool residual_change(const ContactInterface& contact, const PerSide<SurfaceFields>& fields, double dt,
                     const ContactInterface::AddResidual& add);

/// Notes that the host has assembled a matrix with the present linearisations. `has_loads`: per side, true if load
/// blocks are unknowns of the matrix, such that nodes can be released and added.
void has_matrix(const ContactInterface& contact, const PerSide<bool>& has_loads);

/// Calls use(side, linearisation) for each pass whose linearisation can be corrected. `side`: the surface over which it
/// integrates.
template <class Use>
void for_each_correctable(const ContactInterface& contact, const Use& use) {
  for_each_moving(contact, [&](Side side, MovingGeometry& moving) {
    if (moving.held().is_correctable()) use(side, moving.held());
  });
}

}  // namespace mixture_contact
