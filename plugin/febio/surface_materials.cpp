#include "surface_materials.h"

#include "contact/base/indexed_vector.h"
#include "material_properties.h"

#include <algorithm>
#include <cmath>

using namespace mixture_contact;

namespace {

/// The first facet of a type that the core does not support; null if there is none.
const FESurfaceElement* unknown_facet(FESurface& surface) {
  for (int i = 0; i < surface.Elements(); ++i) {
    if (!facet_type(surface.Element(i))) return &surface.Element(i);
  }
  return nullptr;
}

/// True if all elements behind a surface are shells; if false, one of the others is logged.
bool are_shells(FEMixtureSurface& surface, Side side, const ContactLog& log) {
  for (int i = 0; i < surface.Elements(); ++i) {
    const FEElement* const element = surface.Element(i).m_elem[0].pe;
    if (element == nullptr || element->Class() == FE_ELEM_SHELL) continue;
    log.error("<shell_bottom_" + std::string(side == Side::primary ? "primary" : "secondary") +
              "> is set, but element " + std::to_string(element->GetID()) + " behind surface \"" + surface.GetName() +
              "\" is not a shell. Delete this parameter, or give the shells their own contact.");
    return false;
  }
  return true;
}

bool is_rigid(const FacetMaterial& material) { return std::isinf(material.stiffness); }

}  // namespace

bool have_known_facets(ContactSurfaces& surfaces, const ContactLog& log) {
  for (const Side side : both_sides) {
    const FESurfaceElement* unknown = unknown_facet(surfaces[side]);
    if (unknown == nullptr) continue;
    log.error(
        "surface \"" + surfaces.names()[side] + "\" has a facet with " + std::to_string(unknown->Nodes()) +
        " nodes, which is not supported. The contact supports facets with 3, 6 or 7 (triangles) and 4, 8 or 9 nodes "
        "(quadrilaterals).");
    return false;
  }
  return true;
}

bool take_shell_bottoms(ContactSurfaces& surfaces, const ContactParameters& parameters, const ContactLog& log) {
  for (const Side side : both_sides) {
    if (!parameters.surfaces[side].shell_bottom) continue;
    if (!are_shells(surfaces[side], side, log)) return false;
    surfaces[side].take_shell_bottoms();
  }
  return true;
}

std::optional<FacetMaterials> facet_materials(FEModel& fem, ContactSurfaces& surfaces, const ContactLog& log) {
  FacetMaterials materials;
  MaterialReader reader;
  for (const Side side : both_sides) {
    FEMixtureSurface& surface = surfaces[side];
    for (int i = 0; i < surface.Elements(); ++i) {
      std::string problem;
      const auto material = reader.behind(fem, surface, surface.Element(i), problem);
      if (!material) {
        log.error("surface \"" + surface.GetName() + "\": " + problem + ".");
        return std::nullopt;
      }
      materials[side].push_back(*material);
    }
  }
  return materials;
}

bool lack_stiffness(const std::vector<FacetMaterial>& primary, const std::vector<FacetMaterial>& secondary) {
  return std::any_of(primary.begin(), primary.end(), is_rigid) &&
         std::all_of(secondary.begin(), secondary.end(), is_rigid);
}

void stand_in_for_rigid_bodies(FEModel& fem, FacetMaterials& materials) {
  const double modulus = modulus_of_rigid_bodies(fem);
  for (std::vector<FacetMaterial>& of_side : materials) {
    for (FacetMaterial& material : of_side) {
      if (is_rigid(material) && modulus > 0) material.stiffness = modulus / material.thickness;
    }
  }
}

SurfaceMesh surface_mesh(FESurface& surface, const std::vector<FacetMaterial>& materials, const Effects& effects) {
  SurfaceMesh mesh;
  mesh.nodes = surface.Nodes();
  for (int i = 0; i < surface.Elements(); ++i) {
    const FESurfaceElement& element = surface.Element(i);
    Facet facet;
    facet.type = facet_type(element).value_or(FacetType::quad4);
    std::copy_n(element.m_lnode.begin(), element.Nodes(), facet.nodes.begin());
    mesh.facets.push_back(facet);
  }
  set_materials(mesh, materials, effects);
  return mesh;
}
