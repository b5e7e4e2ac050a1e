/// Penalty factors per facet from the stiffness and conductance of both sides.
#pragma once

#include "base/settings.h"
#include "geometry/surface.h"

namespace mixture_contact {

/// Penalties of a primary surface, per facet or per node, with their stiffness and conductance.
struct Penalties {
  VectorXd traction;     ///< eps_n per facet [N/mm^3]
  MatrixXd flux;         ///< eps per (field, facet): [mm^3/(N s)] for the solvent, [mm/s] for solutes
  VectorXd stiffness;    ///< stiffness of the adjoining elements per facet (between rigid bodies: the penalty) [N/mm^3]
  MatrixXd conductance;  ///< conductance of the adjoining elements per (field, facet), units of flux; of the solvent at
                         ///< least a part of the flux that fills their storage in a time step (see storage_part)
};

/// An element of stiffness E/h takes up solvent in a time step dt like a conductance of h/(E dt) [mm^3/(N s)]: in steps
/// far below the time in which it drains, fluxes fill this storage, and a penalty from the permeability alone would
/// leave a jump as large as a part of the pressure. This part of the storage, times the default factor, leaves a jump
/// of a thousandth, as the default does for the traction.
inline constexpr double storage_part = default_traction_factor / default_flux_factor;

/// Stiffness or conductance of two sides in series, doubled so that equal sides give their own value: 2 k1 k2 / (k1 +
/// k2). An infinite side leaves twice the other; a zero side leaves zero.
double in_series(double one, double other);

/// Penalties of the facets of `primary` against `secondary`, whose properties enter by their harmonic mean over its
/// facets: the penalty then does not jump while a point slides from facet to facet.
Penalties penalties(const SurfaceMesh& primary, const SurfaceMesh& secondary, const Effects& effects,
                    const Settings& settings);

/// Penalties per node of the primary surface: the mean over the facets around each node.
Penalties at_nodes(const Penalties& facets, const SurfaceMesh& primary);

}  // namespace mixture_contact
