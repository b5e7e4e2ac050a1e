#include "geometry/sub_facets.h"

#include <Eigen/LU>

#include <algorithm>
#include <cstdlib>

namespace mixture_contact {
namespace {

/// A point on a linear piece of a facet.
struct SubPlace {
  Vector2d xi;            ///< in the parametric coordinates of the piece
  Eigen::Matrix2d slope;  ///< derivatives of these coordinates with those of the facet
};

SubPlace place_on(const SubFacet& piece, FacetType type, const Vector2d& xi) {
  const auto corner = [&](std::size_t a) { return parametric_node(type, piece.nodes[a]); };
  const bool triangle = is_triangle(piece.type);
  Eigen::Matrix2d edges;
  edges << corner(1) - corner(0), corner(triangle ? 2 : 3) - corner(0);
  const double size = triangle ? 1 : 2;  // side length of the piece's parametric domain
  const Eigen::Matrix2d slope = size * edges.inverse();
  return {parametric_node(piece.type, 0) + slope * (xi - corner(0)), slope};
}

/// True if two nodes are the ends of an edge of a linear piece of the facet.
bool adjacent(FacetType type, int one, int two) {
  const auto ends_with_both = [&](const SubFacet& piece) {
    const auto last = piece.nodes.end();
    const auto a = std::find(piece.nodes.begin(), last, one);
    const auto b = std::find(piece.nodes.begin(), last, two);
    if (a == last || b == last) return false;
    const auto apart = std::abs(a - b);
    return apart == 1 || apart == node_count(piece.type) - 1;
  };
  return std::any_of(sub_facets(type).begin(), sub_facets(type).end(), ends_with_both);
}

}  // namespace

const std::vector<SubFacet>& sub_facets(FacetType type) {
  using Type = FacetType;
  static const std::vector<SubFacet> triangle{{Type::tri3, {0, 1, 2}}};
  static const std::vector<SubFacet> four_triangles{
      {Type::tri3, {0, 3, 5}}, {Type::tri3, {3, 1, 4}}, {Type::tri3, {5, 4, 2}}, {Type::tri3, {3, 4, 5}}};
  static const std::vector<SubFacet> six_triangles{{Type::tri3, {0, 3, 6}}, {Type::tri3, {3, 1, 6}},
                                                   {Type::tri3, {1, 4, 6}}, {Type::tri3, {4, 2, 6}},
                                                   {Type::tri3, {2, 5, 6}}, {Type::tri3, {5, 0, 6}}};
  static const std::vector<SubFacet> quadrilateral{{Type::quad4, {0, 1, 2, 3}}};
  static const std::vector<SubFacet> four_quadrilaterals{{Type::quad4, {0, 4, 8, 7}},
                                                         {Type::quad4, {4, 1, 5, 8}},
                                                         {Type::quad4, {8, 5, 2, 6}},
                                                         {Type::quad4, {7, 8, 6, 3}}};
  if (edge_degree(type) == 1) return is_triangle(type) ? triangle : quadrilateral;
  if (!is_triangle(type)) return four_quadrilaterals;
  return type == Type::tri6 ? four_triangles : six_triangles;
}

const std::vector<int>& outline(FacetType type) {
  static const std::vector<int> triangle{0, 1, 2};
  static const std::vector<int> triangle_with_middles{0, 3, 1, 4, 2, 5};
  static const std::vector<int> quadrilateral{0, 1, 2, 3};
  static const std::vector<int> quadrilateral_with_middles{0, 4, 1, 5, 2, 6, 3, 7};
  switch (type) {
    case FacetType::tri3:
      return triangle;
    case FacetType::quad4:
      return quadrilateral;
    default:
      return is_triangle(type) ? triangle_with_middles : quadrilateral_with_middles;
  }
}

int sub_facet_at(FacetType type, const Vector2d& xi) {
  const std::vector<SubFacet>& pieces = sub_facets(type);
  const auto outside = [&](const SubFacet& piece) {
    return distance_outside(piece.type, place_on(piece, type, xi).xi);
  };
  const auto nearest = std::min_element(
      pieces.begin(), pieces.end(),
      [&](const SubFacet& one, const SubFacet& another) { return outside(one) < outside(another); });
  return static_cast<int>(nearest - pieces.begin());
}

ShapeFunctions multiplier_functions(FacetType type, int sub_facet, const Vector2d& xi) {
  if (edge_degree(type) == 1) return shape_functions(type, xi);
  const SubFacet& own = at(sub_facets(type), sub_facet);
  const SubPlace place = place_on(own, type, xi);
  const ShapeFunctions linear = shape_functions(own.type, place.xi);
  const Index nodes = node_count(type);
  ShapeFunctions psi{FacetVector::Zero(nodes), FacetGradient::Zero(nodes, 2)};
  const auto add = [&](Index node, Index corner, double share) {
    psi.value[node] += share * linear.value[corner];
    psi.gradient.row(node) += share * linear.gradient.row(corner) * place.slope;
  };
  for (Index corner = 0; corner < linear.value.size(); ++corner) {
    const Index node = at(own.nodes, corner);
    if (node < nodes) {
      add(node, corner, 1);
    } else {
      for (Index mid = 4; mid < 8; ++mid) add(mid, corner, 0.25);
    }
  }
  return psi;
}

FacetVector heirs_of(FacetType type, int node, const FacetVector& counts) {
  if (counts[node] > 0) return FacetVector::Unit(counts.size(), node);
  const FacetVector beside = FacetVector::NullaryExpr(
      counts.size(), [&](Index a) { return adjacent(type, node, static_cast<int>(a)) ? counts[a] : 0.0; });
  const FacetVector& heirs = beside.sum() > 0 ? beside : counts;
  return heirs / heirs.sum();
}

ShapeFunctions redistributed(FacetType type, const ShapeFunctions& psi, const FacetVector& counts) {
  ShapeFunctions shared{FacetVector::Zero(psi.value.size()), FacetGradient::Zero(psi.value.size(), 2)};
  for (Index node = 0; node < psi.value.size(); ++node) {
    const FacetVector heirs = heirs_of(type, static_cast<int>(node), counts);
    shared.value += heirs * psi.value[node];
    shared.gradient += heirs * psi.gradient.row(node);
  }
  return shared;
}

}  // namespace mixture_contact
