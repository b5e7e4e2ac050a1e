#include "enforcement/both_parts.h"

#include "base/parallel.h"
#include "mortar/varying_pairs.h"

#include <algorithm>
#include <utility>

namespace mixture_contact {
namespace {

/// Those of the nodes that are in contact, too.
NodeFlags in_contact_among(const NodeFlags& nodes, const NodeFlags& in_contact) {
  NodeFlags both(nodes.count(), false);
  for (Index node = 0; node < nodes.count(); ++node) both[node] = nodes[node] && in_contact[node];
  return both;
}

/// Makes the parts of pairs that have a changed node but none of those given, whose pairs are made already.
void make_others(GeometricParts& parts, const MortarSpace& space, const NodeFlags& changed, const NodeFlags& made,
                 const NodalLoads& carried, const FacingFields& fields) {
  const FacingPairs& facing = space.facing();
  in_parallel(parts.count(), [&](Index index) {
    const FacetPair& pair = facing.pairs()[index];
    if (!facing.has_node_among(pair, changed) || facing.has_node_among(pair, made)) return;
    parts[index].reset();
    if (facing.has_node_among(pair, carried.in_contact))
      parts[index] = geometric_tangent(space, pair, varying_points(space, pair, carried, fields, 1.0));
  });
}

/// The nodes of the pairs that have a changed node.
PerSide<NodeFlags> nodes_of_changed_pairs(const FacingPairs& facing, const NodeFlags& changed, PerSide<Index> nodes) {
  PerSide<NodeFlags> flags{{NodeFlags(nodes[Side::primary], false), NodeFlags(nodes[Side::secondary], false)}};
  for (const FacetPair& pair : facing.pairs()) {
    if (!facing.has_node_among(pair, changed)) continue;
    for (const int node : facing.primary_facet(pair)) flags[Side::primary][node] = true;
    for (const int node : facing.secondary_facet(pair)) flags[Side::secondary][node] = true;
  }
  return flags;
}

/// Those rows that are of none of these nodes.
NodeRows rows_of_others(NodeRows rows, const PerSide<NodeFlags>& nodes) {
  const auto is_one = [&](const TangentBlock& row) {
    const bool is_primary = !row.rows.primary.empty();
    return is_primary ? nodes[Side::primary][row.rows.primary.front()]
                      : nodes[Side::secondary][row.rows.secondary.front()];
  };
  rows.erase(std::remove_if(rows.begin(), rows.end(), is_one), rows.end());
  return rows;
}

/// Sums the pairs at nodes. Of a past part, if there is one, rows are taken over.
void sum_at_nodes(GeometricPart& part, std::optional<PastLinearisation>& past, const MortarSpace& space,
                  const NodeFlags& changed, PerSide<Index> nodes) {
  const PerSide<NodeFlags> summed = nodes_of_changed_pairs(space.facing(), changed, nodes);
  const auto held = [&](NodeRows& rows) { return rows_of_others(std::move(rows), summed); };
  part.tractions = traction_rows(part.pairs, nodes, weak_coupling, past ? held(past->geometric.tractions) : NodeRows());
  for (int field = 0; !space.symmetric() && field < space.effects().scalar_fields(); ++field) {
    part.fluxes.push_back(
        flux_rows(part.pairs, nodes, field, weak_coupling, past ? held(past->geometric.fluxes[field]) : NodeRows()));
  }
}

}  // namespace

NodalLoads geometric_loads(const LinearisationPoint& point) {
  NodalLoads loads = point.loads;
  loads.traction = point.geometric_traction;
  loads.flux = point.geometric_flux;
  loads.friction.traction = point.geometric_friction;
  return loads;
}

GeometricPart linearise_both_parts(LinearisationPoint& point, const MortarSpace& space, const FacingFields& fields,
                                   std::optional<PastLinearisation> past, double same) {
  const FacingPairs& facing = space.facing();
  const LinearisationSource now(point, space);
  const NodeFlags changed = past ? changed_nodes(*past, point, now, space, same) : NodeFlags(space.nodes(), true);
  if (std::all_of(changed.begin(), changed.end(), [](bool is) { return is; })) past.reset();
  GeometricPart geometric{past ? std::move(past->geometric.pairs) : GeometricParts(facing.pairs().count()),
                          {},
                          {},
                          past ? past->geometric.source.replaced_at(changed, now) : now};
  // Both parts are of the same points, whose variations cost more than what is made of them.
  const NodalLoads carried = geometric_loads(point);
  NodalLoads averaged = point.loads;
  averaged.in_contact = in_contact_among(changed, point.loads.in_contact);
  point.nodes = linearise(space, averaged, fields, carried, [&](Index pair, const std::vector<VaryingPoint>& points) {
    geometric.pairs[pair] = geometric_tangent(space, facing.pairs()[pair], points);
  });
  if (past) {
    make_others(geometric.pairs, space, changed, averaged.in_contact, carried, fields);
    for (Index node = 0; node < space.nodes(); ++node) {
      if (point.loads.in_contact[node] && !changed[node]) point.nodes[node] = std::move(past->point.nodes[node]);
    }
  }
  sum_at_nodes(geometric, past, space, changed, {{fields.primary.position.cols(), fields.secondary.position.cols()}});
  return geometric;
}

}  // namespace mixture_contact
