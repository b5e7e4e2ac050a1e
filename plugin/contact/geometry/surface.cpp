#include "geometry/surface.h"

#include "base/bytes.h"
#include "geometry/quadrature.h"
#include "geometry/sub_facets.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <map>
#include <set>

namespace mixture_contact {

namespace {

/// A point of a quadrature rule that is exact for psi_a on flat facets that are parallelograms or triangles.
struct RulePoint {
  double weight;
  FacetGradient gradient;  ///< gradient of the shape functions
  FacetVector psi;
};

std::vector<RulePoint> rule_for(FacetType type) {
  std::vector<RulePoint> rule;
  for (const QuadraturePoint& q : piecewise_quadrature(type, default_quadrature_order(type))) {
    const FacetVector psi = multiplier_functions(type, sub_facet_at(type, q.xi), q.xi).value;
    rule.push_back({q.weight, shape_functions(type, q.xi).gradient, psi});
  }
  return rule;
}

/// The points of rule_for(), computed once for each facet type.
const std::vector<RulePoint>& nodal_rule(FacetType type) {
  using Type = FacetType;
  static const std::map<FacetType, std::vector<RulePoint>> rules{
      {Type::tri3, rule_for(Type::tri3)},   {Type::tri6, rule_for(Type::tri6)},   {Type::tri7, rule_for(Type::tri7)},
      {Type::quad4, rule_for(Type::quad4)}, {Type::quad8, rule_for(Type::quad8)}, {Type::quad9, rule_for(Type::quad9)}};
  return rules.at(type);
}

}  // namespace

NodeFlags nodes_of_fixed_gap(const SurfaceMesh& primary, const SurfaceMesh& secondary) {
  const auto is_set = [](bool flag) { return flag; };
  const NodeFlags& faced = secondary.immovable;
  const NodeFlags& own = primary.immovable;
  const bool is_fixed = faced.count() > 0 && std::all_of(faced.begin(), faced.end(), is_set) &&
                        std::any_of(own.begin(), own.end(), is_set) && !std::all_of(own.begin(), own.end(), is_set);
  return is_fixed ? primary.immovable : NodeFlags();
}

bool are_all_joined(const SurfaceMesh& mesh) {
  return !mesh.joined.empty() &&
         std::all_of(mesh.joined.begin(), mesh.joined.end(), [](bool joined) { return joined; });
}

void find_joined_nodes(PerSide<SurfaceMesh>& meshes, const PerSide<std::vector<int>>& numbers) {
  for (const Side side : both_sides) {
    const std::set<int> others(numbers[other(side)].begin(), numbers[other(side)].end());
    NodeFlags joined;
    for (const int number : numbers[side]) joined.push_back(others.count(number) > 0);
    meshes[side].joined = any(joined) ? std::move(joined) : NodeFlags();
  }
}

FacetVector areas_of_nodes(const Facet& facet, const Matrix3Xd& position) {
  const FacetCoordinates x = facet_coordinates(facet, position);
  FacetVector areas = FacetVector::Zero(node_count(facet.type));
  for (const RulePoint& point : nodal_rule(facet.type)) {
    const Eigen::Matrix<double, 3, 2> tangents = x * point.gradient;
    areas += point.weight * tangents.col(0).cross(tangents.col(1)).norm() * point.psi;
  }
  return areas;
}

VectorXd nodal_areas(const SurfaceMesh& mesh, const Matrix3Xd& position) {
  VectorXd sum = VectorXd::Zero(mesh.nodes);
  for (const Facet& facet : mesh.facets) {
    const FacetVector areas = areas_of_nodes(facet, position);
    for (Index a = 0; a < areas.size(); ++a) sum[facet.node(a)] += areas[a];
  }
  return sum;
}

double longest_edge(const Facet& facet, const Matrix3Xd& position) {
  const Index corners = corner_count(facet.type);
  double longest = 0;
  for (Index a = 0; a < corners; ++a) {
    const Vector3d edge = position.col(facet.node((a + 1) % corners)) - position.col(facet.node(a));
    longest = std::max(longest, edge.norm());
  }
  return longest;
}

VectorXd longest_edges(const SurfaceMesh& mesh, const Matrix3Xd& position) {
  VectorXd longest = VectorXd::Zero(mesh.nodes);
  for (const Facet& facet : mesh.facets) {
    const double edge = longest_edge(facet, position);
    for (const int node : facet) longest[node] = std::max(longest[node], edge);
  }
  return longest;
}

double half_diagonal(const Matrix3Xd& position) {
  return 0.5 * (position.rowwise().maxCoeff() - position.rowwise().minCoeff()).norm();
}

std::size_t SurfaceFields::memory() const { return bytes(position) + bytes(scalar); }

}  // namespace mixture_contact
