#include "hexahedron.h"
#include "reader.h"

#include <algorithm>
#include <set>

namespace standalone {
namespace {

using Ids = std::map<int, int>;  ///< id in the file -> index

using Faces = std::map<std::array<int, 4>, std::pair<int, int>>;  ///< corner nodes, sorted -> element, its face

/// Indices of the nodes that a tag lists; `count`: how many these must be, 0 for any number.
std::vector<int> node_indices(const Tag& tag, const Ids& ids, std::size_t count) {
  std::vector<int> nodes;
  for (const int id : tag.integers()) {
    const auto entry = ids.find(id);
    if (entry == ids.end()) tag.fail("node " + std::to_string(id) + " does not exist");
    nodes.push_back(entry->second);
  }
  if (count > 0 && nodes.size() != count) tag.fail("it needs " + std::to_string(count) + " nodes");
  return nodes;
}

void read_nodes(const Tag& section, Mesh& mesh, Ids& ids) {
  std::vector<double> positions;
  for (const Tag& tag : section.all("node")) {
    const std::vector<double> x = tag.numbers(3);
    if (!ids.emplace(tag.integer_attribute("id"), static_cast<int>(ids.size())).second)
      tag.fail("this id is used twice");
    positions.insert(positions.end(), x.begin(), x.end());
  }
  const Index known = mesh.nodes.cols();
  mesh.nodes.conservativeResize(3, static_cast<Index>(ids.size()));
  mesh.nodes.rightCols(mesh.nodes.cols() - known) = Matrix3Xd::Map(positions.data(), 3, mesh.nodes.cols() - known);
}

/// Reads one <Elements> section; returns the indices of its elements.
std::vector<int> read_elements(const Tag& section, const Ids& nodes, Mesh& mesh, std::set<int>& ids) {
  const std::size_t count = section.attribute("type", {"hex8", "hex20"}) == "hex8" ? 8 : 20;
  std::vector<int> part;
  for (const Tag& tag : section.all("elem")) {
    Element element{tag.integer_attribute("id"), -1, node_indices(tag, nodes, count), tag.line()};
    if (std::set<int>(element.nodes.begin(), element.nodes.end()).size() != count) tag.fail("a node appears twice");
    if (!ids.insert(element.id).second) tag.fail("this id is used twice");
    part.push_back(static_cast<int>(mesh.elements.size()));
    mesh.elements.push_back(std::move(element));
  }
  return part;
}

template <class Nodes>
std::array<int, 4> corners_of(const Nodes& nodes) {
  std::array<int, 4> corners{nodes[0], nodes[1], nodes[2], nodes[3]};
  std::sort(corners.begin(), corners.end());
  return corners;
}

Faces element_faces(const Mesh& mesh) {
  Faces faces;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    for (int f = 0; f < 6; ++f) {
      std::array<int, 4> nodes{};
      for (std::size_t k = 0; k < 4; ++k)
        nodes[k] = mesh.elements[e].nodes[static_cast<std::size_t>(hexahedron_faces[f][k])];
      faces.emplace(corners_of(nodes), std::pair<int, int>(e, f));
    }
  }
  return faces;
}

/// Whether the corners of a facet follow each other as those of an element's face do.
bool is_outward(const std::vector<int>& facet, const Element& element, int face) {
  for (std::size_t k = 0; k < 4; ++k) {
    const int now = hexahedron_faces[face][k];
    const int next = hexahedron_faces[face][(k + 1) % 4];
    if (element.nodes[static_cast<std::size_t>(now)] == facet[0])
      return element.nodes[static_cast<std::size_t>(next)] == facet[1];
  }
  return false;
}

SurfaceFacet read_facet(const Tag& tag, mixture_contact::FacetType type, const Ids& ids, const Faces& faces,
                        const Mesh& mesh) {
  tag.find_attribute("id");
  SurfaceFacet facet;
  facet.facet.type = type;
  const std::vector<int> nodes = node_indices(tag, ids, static_cast<std::size_t>(node_count(type)));
  std::copy(nodes.begin(), nodes.end(), facet.facet.nodes.begin());
  const auto face = faces.find(corners_of(nodes));
  if (face == faces.end()) tag.fail("the facet is not a face of any element");
  std::tie(facet.element, facet.face) = face->second;
  if (!is_outward(nodes, mesh.elements[static_cast<std::size_t>(facet.element)], facet.face))
    tag.fail("the nodes of the facet must run counter-clockwise seen from outside the body");
  return facet;
}

std::vector<SurfaceFacet> read_surface(const Tag& section, const Ids& ids, const Faces& faces, const Mesh& mesh) {
  using mixture_contact::FacetType;
  std::vector<SurfaceFacet> surface;
  for (const Tag& tag : section.all("quad4")) surface.push_back(read_facet(tag, FacetType::quad4, ids, faces, mesh));
  for (const Tag& tag : section.all("quad8")) surface.push_back(read_facet(tag, FacetType::quad8, ids, faces, mesh));
  if (surface.empty()) section.fail("the surface has no facet");
  return surface;
}

mixture_contact::PerSide<std::string> read_pair(const Tag& tag, const Mesh& mesh) {
  mixture_contact::PerSide<std::string> names{{tag.one("primary").text(), tag.one("secondary").text()}};
  for (const std::string& name : names) {
    if (mesh.surfaces.count(name) == 0) tag.fail("the surface \"" + name + "\" does not exist");
  }
  return names;
}

template <class T>
void insert(const Tag& tag, std::map<std::string, T>& into, T value) {
  if (!into.emplace(tag.attribute("name"), std::move(value)).second) tag.fail("the name is used twice");
}

}  // namespace

void read_mesh(const Tag& section, Model& model) {
  Mesh& mesh = model.mesh;
  Ids nodes;
  std::set<int> elements;
  for (const Tag& tag : section.all("Nodes")) read_nodes(tag, mesh, nodes);
  for (const Tag& tag : section.all("Elements")) insert(tag, mesh.parts, read_elements(tag, nodes, mesh, elements));
  if (mesh.elements.empty()) section.fail("there are no elements");
  for (const Tag& tag : section.all("NodeSet")) insert(tag, mesh.node_sets, node_indices(tag, nodes, 0));
  const Faces faces = element_faces(mesh);
  for (const Tag& tag : section.all("Surface")) insert(tag, mesh.surfaces, read_surface(tag, nodes, faces, mesh));
  for (const Tag& tag : section.all("SurfacePair")) insert(tag, mesh.pairs, read_pair(tag, mesh));
}

void read_mesh_domains(const Tag& section, Model& model) {
  std::map<std::string, int> materials;
  for (const Material& material : model.materials) materials.emplace(material.name, static_cast<int>(materials.size()));
  for (const Tag& tag : section.all("SolidDomain")) {
    const int material = named(tag, "mat", materials);
    for (const int element : named(tag, "name", model.mesh.parts))
      model.mesh.elements[static_cast<std::size_t>(element)].material = material;
  }
  for (const Element& element : model.mesh.elements) {
    if (element.material < 0)
      section.fail("element " + std::to_string(element.id) + " has no material: a SolidDomain is missing");
  }
}

}  // namespace standalone
