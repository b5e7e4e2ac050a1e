/// The facets of a contact's surfaces and the materials behind them, in the form of the core.
#pragma once

#include "contact_log.h"
#include "contact_surfaces.h"
#include "host/contact_parameters.h"
#include "host/facet_material.h"

#include <optional>
#include <vector>

/// True if the core supports the types of all facets; if false, one of the others is logged.
bool have_known_facets(ContactSurfaces& surfaces, const ContactLog& log);

/// Moves surfaces to the back faces of their shells if the parameters require it. Returns true if all elements behind
/// these surfaces are shells; if false, one of the others is logged.
bool take_shell_bottoms(ContactSurfaces& surfaces, const ContactParameters& parameters, const ContactLog& log);

/// Reads the materials behind all facets. Empty if contact cannot act on one of them; the reason is logged.
std::optional<FacetMaterials> facet_materials(FEModel& fem, ContactSurfaces& surfaces, const ContactLog& log);

/// True if there are rigid facets that face only rigid facets.
bool lack_stiffness(const std::vector<FacetMaterial>& primary, const std::vector<FacetMaterial>& secondary);

/// Sets the stiffness of rigid materials to modulus_of_rigid_bodies(), if that is positive.
void stand_in_for_rigid_bodies(FEModel& fem, FacetMaterials& materials);

/// The mesh of a surface, of which the core supports all facets.
mixture_contact::SurfaceMesh surface_mesh(FESurface& surface, const std::vector<FacetMaterial>& materials,
                                          const mixture_contact::Effects& effects);
