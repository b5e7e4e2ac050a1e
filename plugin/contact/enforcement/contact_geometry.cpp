#include "enforcement/contact_geometry.h"

#include "base/parallel.h"

#include <algorithm>

namespace mixture_contact {

void node_tangents(const EnforcementMethod& method, const IndexedVector<NodeLinearisation>& nodes,
                   const NodalLoads& loads, const VectorXd& weights, double dt, const AddBlock& add) {
  const auto of_node = [&](Index node) {
    if (nodes[node].empty()) return std::vector<TangentBlock>();
    return method.node_tangent(node, nodes[node], loads, weights, dt);
  };
  in_order(nodes.count(), of_node, [&](Index /*node*/, const std::vector<TangentBlock>& blocks) {
    for (const TangentBlock& block : blocks) add(block);
  });
}

void use_effects(const MortarSpace& space, const Patch& patch, const UsePatch& use) {
  // A field whose flux depends on the displacements couples these, too.
  if (space.effects().traction && (patch.fields.empty() || space.symmetric())) use(patch.of_displacements());
  for (const int field : patch.fields) use(space.columns_of(patch, field));
  if (!space.effects().has_bearing_fluid() || space.symmetric()) return;
  const int pressure = space.effects().pressure_field();
  const bool is_exchanged = std::find(patch.fields.begin(), patch.fields.end(), pressure) != patch.fields.end();
  if (!is_exchanged) use(patch.of_field(pressure, true));
}

}  // namespace mixture_contact
