#include "enforcement/both_parts.h"

#include "base/parallel.h"

#include <algorithm>
#include <utility>

namespace mixture_contact {
namespace {

/// The nodes that are in contact, among the given ones.
NodeFlags in_contact_among(const NodeFlags& nodes, const NodeFlags& in_contact) {
  NodeFlags both(nodes.count(), false);
  for (Index node = 0; node < nodes.count(); ++node) both[node] = nodes[node] && in_contact[node];
  return both;
}

/// Resizes `parts` to one entry per pair, and removes the entries of pairs without a node in contact.
void keep_loaded(GeometricParts& parts, const FacingPairs& facing, const NodeFlags& in_contact) {
  parts.resize(facing.pairs().size());
  for (Index pair = 0; pair < parts.count(); ++pair) {
    if (!facing.has_node_among(facing.pairs()[pair], in_contact)) parts[pair].reset();
  }
}

/// Computes the parts of pairs that have a node in `changed` and none in `made`, whose pairs have been computed
/// already.
void make_others(GeometricParts& parts, const MortarSpace& space, const NodeFlags& changed, const NodeFlags& made,
                 const NodalLoads& carried, const FacingFields& fields) {
  const FacingPairs& facing = space.facing();
  in_parallel(parts.count(), [&](Index index) {
    const FacetPair& pair = facing.pairs()[index];
    if (!facing.has_node_among(pair, changed) || facing.has_node_among(pair, made)) return;
    parts[index].reset();
    if (facing.has_node_among(pair, carried.in_contact))
      parts[index] = geometric_tangent(space, pair, varying_pair(space, pair, carried, fields, 1.0));
  });
}

/// The nodes of all pairs that have a changed node.
PerSide<NodeFlags> nodes_of_changed_pairs(const FacingPairs& facing, const NodeFlags& changed, PerSide<Index> nodes) {
  PerSide<NodeFlags> flags{{NodeFlags(nodes[Side::primary], false), NodeFlags(nodes[Side::secondary], false)}};
  for (const FacetPair& pair : facing.pairs()) {
    if (!facing.has_node_among(pair, changed)) continue;
    for (const int node : facing.primary_facet(pair)) flags[Side::primary][node] = true;
    for (const int node : facing.secondary_facet(pair)) flags[Side::secondary][node] = true;
  }
  return flags;
}

/// Removes the rows of these nodes.
void remove_rows(NodeRows& rows, const PerSide<NodeFlags>& nodes) {
  const auto is_one = [&](const TangentBlock& row) {
    const bool is_primary = !row.rows.primary.empty();
    return is_primary ? nodes[Side::primary][row.rows.primary.front()]
                      : nodes[Side::secondary][row.rows.secondary.front()];
  };
  rows.erase(std::remove_if(rows.begin(), rows.end(), is_one), rows.end());
}

/// The reusable part of a past linearisation. Pairs that have a changed node are still to be computed.
GeometricPart taken_over(GeometricPart past, const NodeFlags& changed, const LinearisationSource& now,
                         const FacingPairs& facing, PerSide<Index> nodes) {
  const PerSide<NodeFlags> summed_anew = nodes_of_changed_pairs(facing, changed, nodes);
  remove_rows(past.tractions, summed_anew);
  for (NodeRows& flux : past.fluxes) remove_rows(flux, summed_anew);
  past.source.replace_at(changed, now);
  return past;
}

/// Adds the sums over pairs at nodes that have no rows yet.
void sum_at_nodes(GeometricPart& part, const MortarSpace& space, PerSide<Index> nodes) {
  part.tractions = traction_rows(part.pairs, nodes, weak_coupling, std::move(part.tractions));
  part.fluxes.resize(space.symmetric() ? 0 : indexing::entries(space.effects().scalar_fields()));
  for (int field = 0; field < part.fluxes.count(); ++field)
    part.fluxes[field] = flux_rows(part.pairs, nodes, field, weak_coupling, std::move(part.fluxes[field]));
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
                                   std::optional<PastLinearisation> past, double same, GeometricParts memory) {
  const FacingPairs& facing = space.facing();
  const LinearisationSource now(point, space);
  const NodeFlags changed = past ? changed_nodes(*past, now, space, same) : NodeFlags(space.nodes(), true);
  if (past && std::all_of(changed.begin(), changed.end(), [](bool is) { return is; })) {
    memory = std::move(past->geometric.pairs);
    past.reset();
  }
  const PerSide<Index> nodes{{fields.primary.position.cols(), fields.secondary.position.cols()}};
  GeometricPart geometric = past ? taken_over(std::move(past->geometric), changed, now, facing, nodes)
                                 : GeometricPart{std::move(memory), {}, {}, now};
  // Both parts are computed from the same points, because the variations of the points take most of the time.
  const NodalLoads carried = geometric_loads(point);
  NodalLoads averaged = point.loads;
  averaged.in_contact = in_contact_among(changed, point.loads.in_contact);
  if (!past) keep_loaded(geometric.pairs, facing, averaged.in_contact);
  point.nodes = linearise(space, averaged, fields, carried, [&](Index pair, const VaryingPair& varying) {
    std::optional<GeometricTangent>& part = geometric.pairs[pair];
    if (!part) part.emplace();
    set_geometric_tangent(space, facing.pairs()[pair], varying, *part);
  });
  if (past) {
    make_others(geometric.pairs, space, changed, averaged.in_contact, carried, fields);
    for (Index node = 0; node < space.nodes(); ++node) {
      if (point.loads.in_contact[node] && !changed[node]) point.nodes[node] = std::move(past->point.nodes[node]);
    }
  }
  sum_at_nodes(geometric, space, nodes);
  return geometric;
}

}  // namespace mixture_contact
