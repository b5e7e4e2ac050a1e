#include "facet_material.h"

#include <algorithm>

using namespace mixture_contact;

namespace {

/// Conductance for a solute, or for the solvent (-1); empty if the material is impermeable to it.
std::optional<double> conductance(const FacetMaterial& material, int solute) {
  if (solute < 0) return material.permeable ? std::optional<double>(material.permeability) : std::nullopt;
  const auto entry = material.solutes.find(solute);
  return entry == material.solutes.end() ? std::nullopt : std::optional<double>(entry->second);
}

}  // namespace

std::vector<FieldAtContact> fields_at_contact(const FacetMaterials& materials, const PerSide<std::string>& surfaces,
                                              const std::vector<std::string>& solutes) {
  std::vector<FieldAtContact> fields{{-1, "", {}}};
  for (const std::string& name : solutes) fields.push_back({static_cast<int>(fields.size()) - 1, name, {}});
  for (FieldAtContact& field : fields) {
    const auto has_it = [&](const FacetMaterial& material) { return conductance(material, field.solute).has_value(); };
    for (const Side side : both_sides) {
      if (std::any_of(materials[side].begin(), materials[side].end(), has_it)) continue;
      field.obstacles.push_back("\"" + surfaces[side] +
                                (field.solute < 0 ? "\" is impermeable" : "\" does not have it"));
    }
  }
  return fields;
}

bool has_fluid(const FacetMaterials& materials) {
  return std::any_of(materials.begin(), materials.end(), [](const std::vector<FacetMaterial>& facets) {
    return std::any_of(facets.begin(), facets.end(), [](const FacetMaterial& facet) { return facet.permeable; });
  });
}

double longest_crossing(const FacetMaterials& materials) {
  double longest = 0;
  for (const std::vector<FacetMaterial>& of_side : materials) {
    for (const FacetMaterial& each : of_side) longest = std::max(longest, each.crossing);
  }
  return longest;
}

void set_materials(SurfaceMesh& mesh, const std::vector<FacetMaterial>& materials, const Effects& effects) {
  const auto facets = static_cast<Index>(materials.size());
  mesh.thickness.resize(facets);
  mesh.stiffness.resize(facets);
  mesh.conductance.setZero(effects.scalar_fields(), facets);
  mesh.permeable.assign(materials.size(), 0);
  for (Index f = 0; f < facets; ++f) {
    const FacetMaterial& material = at(materials, f);
    mesh.thickness[f] = material.thickness;
    mesh.stiffness[f] = material.stiffness;
    for (int field = 0; field < effects.scalar_fields(); ++field) {
      const std::optional<double> found = conductance(material, solute_of(effects, field));
      if (!found) continue;
      mesh.permeable[f] |= only(field);
      mesh.conductance(field, f) = *found;
    }
    if (effects.reads_fluid() && material.permeable) mesh.permeable[f] |= only(effects.pressure_field());
  }
}

void update_materials(ContactInterface& core, const FacetMaterials& materials) {
  PerSide<SurfaceMesh> meshes;
  for (const Side side : both_sides) set_materials(meshes[side], materials[side], core.effects());
  core.update_properties({{meshes[Side::primary].stiffness, meshes[Side::secondary].stiffness}},
                         {{meshes[Side::primary].conductance, meshes[Side::secondary].conductance}});
}

int solute_of(const Effects& effects, int field) {
  if (field == effects.pressure_field()) return -1;
  return at(effects.solutes, field - (effects.solvent ? 1 : 0));
}

std::vector<int> exchanged_solutes(const Effects& effects) {
  std::vector<int> solutes;
  for (int field = 0; field < effects.scalar_fields(); ++field) solutes.push_back(solute_of(effects, field));
  return solutes;
}
