/// The surfaces of a contact as the core takes them: facets, and the materials behind them.
#pragma once

#include "contact_log.h"
#include "contact_surfaces.h"
#include "host/contact_parameters.h"
#include "host/facet_material.h"

#include <optional>
#include <vector>

/// Whether the core knows the types of all facets; the log names one that it does not know.
bool have_known_facets(ContactSurfaces& surfaces, const ContactLog& log);

/// Moves surfaces to the back faces of their shells if the parameters require it. Returns whether all elements behind
/// these surfaces are shells; the log names one that is not.
bool take_shell_bottoms(ContactSurfaces& surfaces, const ContactParameters& parameters, const ContactLog& log);

/// Reads the materials behind all facets. Empty if contact cannot act on one of them; the log gives the reason.
std::optional<FacetMaterials> facet_materials(FEModel& fem, ContactSurfaces& surfaces, const ContactLog& log);

/// Whether some rigid facets face rigid facets alone.
bool lack_stiffness(const std::vector<FacetMaterial>& primary, const std::vector<FacetMaterial>& secondary);

/// Gives rigid materials a stiffness from modulus_of_rigid_bodies(), if it returns one.
void stand_in_for_rigid_bodies(FEModel& fem, FacetMaterials& materials);

/// The mesh of a surface whose facets are all known.
mixture_contact::SurfaceMesh surface_mesh(FESurface& surface, const std::vector<FacetMaterial>& materials,
                                          const mixture_contact::Effects& effects);
