#include "hexahedron.h"
#include "sections.h"

#include <algorithm>
#include <set>

namespace standalone {
namespace {

using mixture_contact::Side;

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
  const auto node = [&](const Tag& tag) {
    tag.read({"id"});
    const std::vector<double> x = tag.numbers(3);
    if (!ids.emplace(tag.integer_attribute("id"), static_cast<int>(ids.size())).second)
      tag.fail("this id is used twice");
    positions.insert(positions.end(), x.begin(), x.end());
  };
  section.read({"name"}, {each("node", node)});
  const Index known = mesh.nodes.cols();
  mesh.nodes.conservativeResize(3, static_cast<Index>(ids.size()));
  mesh.nodes.rightCols(mesh.nodes.cols() - known) = Matrix3Xd::Map(positions.data(), 3, mesh.nodes.cols() - known);
}

/// Reads one <Elements> section; returns the indices of its elements.
std::vector<int> read_elements(const Tag& section, const Ids& nodes, Mesh& mesh, std::set<int>& ids) {
  const std::size_t count = section.attribute("type", {"hex8", "hex20"}) == "hex8" ? 8 : 20;
  std::vector<int> part;
  const auto add = [&](const Tag& tag) {
    tag.read({"id"});
    Element element{tag.integer_attribute("id"), -1, node_indices(tag, nodes, count), tag.line()};
    if (std::set<int>(element.nodes.begin(), element.nodes.end()).size() != count) tag.fail("a node appears twice");
    if (!ids.insert(element.id).second) tag.fail("this id is used twice");
    part.push_back(static_cast<int>(mesh.elements.size()));
    mesh.elements.push_back(std::move(element));
  };
  section.read({"type", "name"}, {each("elem", add)});
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

std::vector<SurfaceFacet> read_surface(const Tag& section, const Ids& ids, const Faces& faces, const Mesh& mesh) {
  std::vector<SurfaceFacet> surface;
  const auto add = [&](const Tag& tag) {
    tag.read({"id"});
    SurfaceFacet facet;
    facet.facet.type = tag.name() == "quad4" ? mixture_contact::FacetType::quad4 : mixture_contact::FacetType::quad8;
    const auto count = static_cast<std::size_t>(mixture_contact::node_count(facet.facet.type));
    const std::vector<int> nodes = node_indices(tag, ids, count);
    std::copy(nodes.begin(), nodes.end(), facet.facet.nodes.begin());
    const auto face = faces.find(corners_of(nodes));
    if (face == faces.end()) tag.fail("the facet is not a face of any element");
    std::tie(facet.element, facet.face) = face->second;
    if (!is_outward(nodes, mesh.elements[static_cast<std::size_t>(facet.element)], facet.face))
      tag.fail("the nodes of the facet must run counter-clockwise seen from outside the body");
    surface.push_back(facet);
  };
  section.read({"name"}, {each("quad4", add), each("quad8", add)});
  if (surface.empty()) section.fail("the surface has no facet");
  return surface;
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
  Faces faces;
  const auto pair = [&](const Tag& tag) {
    mixture_contact::PerSide<std::string> names;
    tag.read({"name"}, {one("primary", into(names[Side::primary])), one("secondary", into(names[Side::secondary]))});
    for (const std::string& name : names) {
      if (mesh.surfaces.count(name) == 0) tag.fail("the surface \"" + name + "\" does not exist");
    }
    insert(tag, mesh.pairs, std::move(names));
  };
  const auto part = [&](const Tag& tag) { insert(tag, mesh.parts, read_elements(tag, nodes, mesh, elements)); };
  const auto node_set = [&](const Tag& tag) {
    tag.read({"name"});
    insert(tag, mesh.node_sets, node_indices(tag, nodes, 0));
  };
  const auto surface = [&](const Tag& tag) {
    if (faces.empty()) faces = element_faces(mesh);
    insert(tag, mesh.surfaces, read_surface(tag, nodes, faces, mesh));
  };
  section.read({}, {each("Nodes", [&](const Tag& tag) { read_nodes(tag, mesh, nodes); }), each("Elements", part),
                    each("NodeSet", node_set), each("Surface", surface), each("SurfacePair", pair)});
  if (mesh.elements.empty()) section.fail("there are no elements");
}

void read_mesh_domains(const Tag& section, Model& model) {
  std::map<std::string, int> materials;
  for (const Material& material : model.materials) materials.emplace(material.name, static_cast<int>(materials.size()));
  const auto domain = [&](const Tag& tag) {
    tag.read({"name", "mat"});
    const int material = named(tag, "mat", materials);
    for (const int element : named(tag, "name", model.mesh.parts))
      model.mesh.elements[static_cast<std::size_t>(element)].material = material;
  };
  section.read({}, {each("SolidDomain", domain)});
  for (const Element& element : model.mesh.elements) {
    if (element.material < 0)
      section.fail("element " + std::to_string(element.id) + " has no material: a SolidDomain is missing");
  }
}

}  // namespace standalone
