#include "enforcement/contact_geometry.h"

#include "base/parallel.h"

namespace mixture_contact {
namespace {

/// Adds the products of load blocks to the other blocks of a node's tangent.
void multiply_out(const MortarSpace& space, NodeTangent& tangent) {
  ScopedTimer laps(space.effect_times(), space.effects().scalar_fields());
  for (const LoadBlock& load : tangent.loads) {
    tangent.blocks.push_back(load.product());
    if (load.place.field) {
      laps.field(*load.place.field);
    } else {
      laps.traction();
    }
  }
  tangent.loads.clear();
}

/// Calls `use` with each load at a node. `patch`: the nodes and fields of its averages.
void use_loads(const PassNodes& at, Index node, const Patch& patch, const UseLoad& use) {
  const int own = static_cast<int>(node);
  if (patch.displacements) use({own, std::nullopt, patch.of_displacements()});
  for (const int field : patch.fields) use({own, field, flux_columns(at, patch, field)});
}

/// Calls `use` with the couplings of fluxes that depend on other fields than their own.
void use_other_drivers(const PassNodes& at, const Patch& patch, const UsePatch& use) {
  for (const int field : patch.fields) {
    const Patch columns = flux_columns(at, patch, field);
    if (columns.fields.count() > 1) use(columns);
  }
}

}  // namespace

void node_tangents(const PassParts& pass, const IndexedVector<NodeLinearisation>& nodes, const NodalLoads& loads,
                   const VectorXd& weights, double dt, const TangentParts& add) {
  const bool multiplies = !add.load || !pass.has_load_blocks();
  const auto of_node = [&](Index node) {
    NodeTangent tangent;
    if (nodes[node].empty()) return tangent;
    tangent = pass.method->node_tangent(pass, node, nodes[node], loads, weights, dt);
    if (multiplies) multiply_out(pass.space, tangent);
    return tangent;
  };
  in_batches(nodes.count(), of_node, [&](Index /*node*/, const NodeTangent& tangent) {
    for (const TangentBlock& block : tangent.blocks) add.block(block);
    for (const LoadBlock& load : tangent.loads) add.load(load);
  });
}

void use_node(const PassParts& pass, Index node, const Patch& patch, const Couplings& use) {
  if (takes_loads(pass, use)) {
    use_loads(pass, node, patch, use.load);
  } else {
    pass.method->for_each_coupling(patch, [&](const Patch& part) {
      use_effects(pass.space, part, use.patch);
      use_other_drivers(pass, part, use.patch);
    });
  }
}

void use_effects(const MortarSpace& space, const Patch& patch, const UsePatch& use) {
  // The columns of a field's flux include the displacements, unless the tangent is symmetric.
  if (patch.displacements && (patch.fields.empty() || space.symmetric())) use(patch.of_displacements());
  for (const int field : patch.fields) use(space.columns_of(patch, field));
  if (space.symmetric()) return;
  for (int field = 0; field < space.effects().nodal_fields(); ++field) {
    const bool is_used = position_in(patch.fields, field) < patch.fields.count();
    if (!is_used && contains(space.effects().bearing_fields(), field)) use(patch.of_field(field, true));
  }
}

}  // namespace mixture_contact
