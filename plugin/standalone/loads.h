/// Dead loads on surfaces.
#pragma once

#include "model.h"

namespace standalone {

/// Nodal forces, shape (dofs, nodes), of a unit load on the reference surface: of a pressure of 1 MPa, INT -N_a n dA
/// [N], or of an outward solvent flux of 1 mm/s, INT N_a dA on the rows of p~ [mm^3/s].
MatrixXd unit_forces(const Model& model, const SurfaceLoad& load);

}  // namespace standalone
