#include "hexahedron.h"
#include "reader.h"

#include <algorithm>
#include <set>

namespace standalone {
namespace {

using Ids = std::map<int, int>;  ///< id in the file -> index

/// Corners after in_order() -> element, number of its face.
using Faces = std::map<std::array<int, 4>, std::pair<int, int>>;

/// Indices of the nodes that a tag lists. `count`: required number of nodes; 0 for any number.
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
    if (!ids.emplace(tag.integer_attribute("id"), number_of(ids)).second) tag.fail("this id is used twice");
    positions.insert(positions.end(), x.begin(), x.end());
  }
  const Index known = mesh.nodes.cols();
  mesh.nodes.conservativeResize(3, count_of(ids));
  mesh.nodes.rightCols(mesh.nodes.cols() - known) = Matrix3Xd::Map(positions.data(), 3, mesh.nodes.cols() - known);
}

/// Reads one <Elements> section. Returns the indices of its elements.
std::vector<int> read_elements(const Tag& section, const Ids& nodes, Mesh& mesh, std::set<int>& ids) {
  const std::size_t count = section.attribute("type", {"hex8", "hex20"}) == "hex8" ? 8 : 20;
  std::vector<int> part;
  for (const Tag& tag : section.all("elem")) {
    Element element{tag.integer_attribute("id"), -1, node_indices(tag, nodes, count), tag.line()};
    if (std::set<int>(element.nodes.begin(), element.nodes.end()).size() != count) tag.fail("a node appears twice");
    if (!ids.insert(element.id).second) tag.fail("this id is used twice");
    part.push_back(number_of(mesh.elements));
    mesh.elements.push_back(std::move(element));
  }
  return part;
}

/// Corners in counter-clockwise order, starting with the lowest.
std::array<int, 4> in_order(std::array<int, 4> corners) {
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

Faces element_faces(const Mesh& mesh) {
  Faces faces;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    for (int f = 0; f < 6; ++f) {
      std::array<int, 4> nodes{};
      for (std::size_t k = 0; k < 4; ++k) nodes[k] = at(mesh.elements[e].nodes, hexahedron_faces[f][k]);
      faces.emplace(in_order(nodes), std::pair<int, int>(e, f));
    }
  }
  return faces;
}

SurfaceFacet read_facet(const Tag& tag, mixture_contact::FacetType type, const Ids& ids, const Faces& faces) {
  tag.find_attribute("id");
  SurfaceFacet facet;
  facet.facet.type = type;
  const std::vector<int> nodes = node_indices(tag, ids, entries(node_count(type)));
  std::copy(nodes.begin(), nodes.end(), facet.facet.nodes.begin());
  const auto face = faces.find(in_order({nodes[0], nodes[1], nodes[2], nodes[3]}));
  if (face == faces.end())
    tag.fail("the facet is not a face of any element, with its nodes counter-clockwise seen from outside");
  std::tie(facet.element, facet.face) = face->second;
  return facet;
}

std::vector<SurfaceFacet> read_surface(const Tag& section, const Ids& ids, const Faces& faces) {
  using mixture_contact::FacetType;
  std::vector<SurfaceFacet> surface;
  for (const Tag& tag : section.all("quad4")) surface.push_back(read_facet(tag, FacetType::quad4, ids, faces));
  for (const Tag& tag : section.all("quad8")) surface.push_back(read_facet(tag, FacetType::quad8, ids, faces));
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
  for (const Tag& tag : section.all("Surface")) insert(tag, mesh.surfaces, read_surface(tag, nodes, faces));
  for (const Tag& tag : section.all("SurfacePair")) insert(tag, mesh.pairs, read_pair(tag, mesh));
}

void read_mesh_domains(const Tag& section, Model& model) {
  std::map<std::string, int> materials;
  for (const Material& material : model.materials) materials.emplace(material.name, number_of(materials));
  for (const Tag& tag : section.all("SolidDomain")) {
    const int material = named(tag, "mat", materials);
    for (const int element : named(tag, "name", model.mesh.parts)) at(model.mesh.elements, element).material = material;
  }
  for (const Element& element : model.mesh.elements) {
    if (element.material < 0)
      section.fail("element " + std::to_string(element.id) + " has no material: a SolidDomain is missing");
  }
}

}  // namespace standalone
