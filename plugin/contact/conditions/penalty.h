/// Penalties of facets and nodes, from the stiffness and conductance of both sides.
#pragma once

#include "base/settings.h"
#include "geometry/surface.h"

namespace mixture_contact {

/// Penalties of a primary surface with the stiffness and conductance on which they are based; one entry or column per
/// facet, or per node after at_nodes().
struct Penalties {
  VectorXd traction;   ///< traction penalties eps_n [N/mm^3]
  MatrixXd flux;       ///< flux penalties eps per (field, facet): [mm^3/(N s)] for the solvent, [mm/s] for solutes
  VectorXd stiffness;  ///< stiffness of the adjoining elements [N/mm^3]; between rigid bodies the penalty
  /// Conductance of the adjoining elements per (field, facet); for the solvent at least the conductance that represents
  /// their storage in a time step (see storage_part).
  MatrixXd conductance;
};

/// Factor of the storage of an element in its conductance.
///
/// In a time step dt, an element of stiffness E/h stores solvent like a conductance of h/(E dt) [mm^3/(N s)]. If steps
/// are far below the time in which the element drains, fluxes fill this storage, and a penalty from the permeability
/// alone would leave a large jump of the pressure. With this factor and the default penalty factor of fluxes, the jump
/// is a thousandth, as for the default traction penalty.
inline constexpr double storage_part = default_traction_factor / default_flux_factor;

/// Stiffness or conductance of two sides in series, times two, such that equal sides give their own value: 2 k1 k2/(k1
/// + k2). If one side is infinite, twice the other; if one side is zero, zero.
double in_series(double one, double other);

/// Penalties of the facets of `primary` in contact with `secondary`. The properties of `secondary` enter by their
/// harmonic mean over all its facets, such that the penalty does not jump when a point slides from facet to facet.
Penalties penalties(const SurfaceMesh& primary, const SurfaceMesh& secondary, const Effects& effects,
                    const Settings& settings);

/// Penalties per node of the primary surface: means over the facets around each node.
Penalties at_nodes(const Penalties& facets, const SurfaceMesh& primary);

/// Limits the traction penalties of these nodes to the stiffness of the elements; `fixed`: nodes_of_fixed_gap().
///
/// An overlap that no solution can change is no measure of a traction. Times a large penalty it would push the
/// neighbours of the node away, far beyond the surfaces.
void soften(Penalties& nodes, const NodeFlags& fixed);

}  // namespace mixture_contact
