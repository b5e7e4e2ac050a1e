#include "hexahedron.h"
#include "sections.h"

#include <Eigen/LU>

#include <algorithm>
#include <set>

namespace standalone {
namespace {

using Ids = std::map<int, int>;  ///< id in the file -> index

int index_of(const Tag& tag, const Ids& ids, int id, const char* what) {
  const auto entry = ids.find(id);
  if (entry == ids.end()) tag.fail(std::string(what) + " " + std::to_string(id) + " does not exist");
  return entry->second;
}

std::vector<int> node_indices(const Tag& tag, const Ids& ids) {
  std::vector<int> nodes;
  for (const int id : tag.integers()) nodes.push_back(index_of(tag, ids, id, "node"));
  return nodes;
}

void read_nodes(const Tag& section, std::vector<Vector3d>& positions, Ids& ids) {
  section.allow_attributes({"name"});
  section.allow_children({"node"});
  for (const Tag& tag : section.children()) {
    const std::vector<double> x = tag.numbers(3);
    if (!ids.emplace(tag.integer_attribute("id"), static_cast<int>(positions.size())).second)
      tag.fail("this id is used twice");
    positions.emplace_back(x[0], x[1], x[2]);
  }
}

void check_shape(const Tag& tag, const Mesh& mesh, const Element& element) {
  Matrix3Xd x(3, static_cast<Index>(element.nodes.size()));
  for (Index a = 0; a < x.cols(); ++a) x.col(a) = mesh.nodes.col(element.nodes[static_cast<std::size_t>(a)]);
  for (const HexahedronPoint& point : hexahedron_rule(static_cast<int>(x.cols()))) {
    const Eigen::Matrix4Xd shape = hexahedron_shape(static_cast<int>(x.cols()), point.xi);
    const Matrix3d jacobian = x * shape.bottomRows(3).transpose();
    if (!(jacobian.determinant() > 0)) tag.fail("the element is inverted or has no volume");
  }
}

/// Reads one <Elements> section; returns the indices of its elements.
std::vector<int> read_elements(const Tag& section, const Ids& nodes, Mesh& mesh, std::set<int>& ids) {
  section.allow_attributes({"type", "name"});
  section.allow_children({"elem"});
  const std::string type = section.attribute("type");
  if (type != "hex8" && type != "hex20")
    section.fail(R"(the type ")" + type + R"(" is not supported; allowed: "hex8", "hex20")");
  const std::size_t count = type == "hex8" ? 8 : 20;
  std::vector<int> part;
  for (const Tag& tag : section.children()) {
    Element element{tag.integer_attribute("id"), -1, node_indices(tag, nodes)};
    if (element.nodes.size() != count) tag.fail("a " + type + " needs " + std::to_string(count) + " nodes");
    if (std::set<int>(element.nodes.begin(), element.nodes.end()).size() != count) tag.fail("a node appears twice");
    if (!ids.insert(element.id).second) tag.fail("this id is used twice");
    check_shape(tag, mesh, element);
    part.push_back(static_cast<int>(mesh.elements.size()));
    mesh.elements.push_back(std::move(element));
  }
  return part;
}

/// Elements by the corner nodes, sorted, of each of their faces.
std::map<std::array<int, 4>, int> element_faces(const Mesh& mesh) {
  std::map<std::array<int, 4>, int> faces;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    for (const auto& corners : hexahedron_faces) {
      std::array<int, 4> face{};
      for (std::size_t k = 0; k < 4; ++k) face[k] = mesh.elements[e].nodes[static_cast<std::size_t>(corners[k])];
      std::sort(face.begin(), face.end());
      faces.emplace(face, static_cast<int>(e));
    }
  }
  return faces;
}

std::vector<SurfaceFacet> read_surface(const Tag& section, const Ids& ids,
                                       const std::map<std::array<int, 4>, int>& faces) {
  section.allow_attributes({"name"});
  section.allow_children({"quad4", "quad8"});
  std::vector<SurfaceFacet> surface;
  for (const Tag& tag : section.children()) {
    const std::vector<int> nodes = node_indices(tag, ids);
    SurfaceFacet facet;
    facet.facet.type = tag.name() == "quad4" ? mixture_contact::FacetType::quad4 : mixture_contact::FacetType::quad8;
    const auto count = static_cast<std::size_t>(mixture_contact::node_count(facet.facet.type));
    if (nodes.size() != count)
      tag.fail("expected " + std::to_string(count) + " nodes, found " + std::to_string(nodes.size()));
    std::copy(nodes.begin(), nodes.end(), facet.facet.nodes.begin());
    std::array<int, 4> corners{};
    std::copy_n(nodes.begin(), 4, corners.begin());
    std::sort(corners.begin(), corners.end());
    const auto face = faces.find(corners);
    if (face == faces.end()) tag.fail("the facet is not a face of any element");
    facet.element = face->second;
    surface.push_back(facet);
  }
  if (surface.empty()) section.fail("the surface has no facet");
  return surface;
}

template <class T>
void insert(const Tag& tag, std::map<std::string, T>& into, T value) {
  if (!into.emplace(tag.attribute("name"), std::move(value)).second) tag.fail("the name is used twice");
}

}  // namespace

void read_mesh(const Tag& section, Model& model) {
  section.allow_children({"Nodes", "Elements", "NodeSet", "Surface", "SurfacePair"});
  Mesh& mesh = model.mesh;
  std::vector<Vector3d> positions;
  Ids nodes;
  for (const Tag& tag : section.children("Nodes")) read_nodes(tag, positions, nodes);
  mesh.nodes.resize(3, static_cast<Index>(positions.size()));
  for (std::size_t i = 0; i < positions.size(); ++i) mesh.nodes.col(static_cast<Index>(i)) = positions[i];
  std::set<int> elements;
  for (const Tag& tag : section.children("Elements")) {
    insert(tag, model.mesh.parts, read_elements(tag, nodes, mesh, elements));
  }
  if (mesh.elements.empty()) section.fail("there are no elements");
  for (const Tag& tag : section.children("NodeSet")) {
    tag.allow_attributes({"name"});
    insert(tag, mesh.node_sets, node_indices(tag, nodes));
  }
  const auto faces = element_faces(mesh);
  for (const Tag& tag : section.children("Surface")) insert(tag, mesh.surfaces, read_surface(tag, nodes, faces));
  for (const Tag& tag : section.children("SurfacePair")) {
    tag.allow_children({"primary", "secondary"});
    std::array<std::string, 2> pair{tag.child("primary").text(), tag.child("secondary").text()};
    for (const std::string& name : pair) {
      if (mesh.surfaces.count(name) == 0) tag.fail("the surface \"" + name + "\" does not exist");
    }
    insert(tag, mesh.pairs, std::move(pair));
  }
}

void read_mesh_domains(const Tag& section, Model& model) {
  section.allow_children({"SolidDomain"});
  std::map<std::string, int> materials;
  for (const Material& material : model.materials) materials.emplace(material.name, static_cast<int>(materials.size()));
  for (const Tag& tag : section.children()) {
    tag.allow_attributes({"name", "mat"});
    tag.allow_children({});
    const int material = named(tag, "mat", materials);
    for (const int element : named(tag, "name", model.mesh.parts)) {
      model.mesh.elements[static_cast<std::size_t>(element)].material = material;
    }
  }
}

}  // namespace standalone
