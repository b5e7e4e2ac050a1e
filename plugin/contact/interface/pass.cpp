#include "interface/pass.h"

#include "base/bytes.h"
#include "enforcement/fixed_geometry.h"
#include "enforcement/moving_geometry.h"

namespace mixture_contact {
namespace {

/// The given nodes without the joined nodes of a surface.
NodeFlags apart(const SurfaceMesh& mesh, NodeFlags nodes) {
  for (Index node = 0; node < nodes.count(); ++node) nodes[node] = nodes[node] && !mesh.is_joined(node);
  return nodes;
}

}  // namespace

ContactPass::ContactPass(const SurfaceMesh& primary, const SurfaceMesh& secondary, const Effects& effects,
                         const Settings& settings)
    : parts_(primary, secondary, effects, settings), geometry_(make_geometry()) {
  if (primary.joined.count() > 0) parts_.active_set.restrict_to(apart(primary, NodeFlags(primary.nodes, true)));
  if (!settings.gap.may_touch) restrict_active_set(NodeFlags(primary.nodes, false));
}

std::unique_ptr<ContactGeometry> ContactPass::make_geometry() {
  if (parts_.space.effects().traction) return std::make_unique<MovingGeometry>(parts_);
  return std::make_unique<FixedGeometry>(parts_);
}

void ContactPass::project(const FacingPositions& x, const Reach& reach) {
  parts_.space.change_facing().search(x, reach);
  geometry_->update(x);
}

void ContactPass::project_on_same_facets(const FacingPositions& x) {
  parts_.space.change_facing().project_on_same_facets(x);
  geometry_->update(x);
}

void ContactPass::restrict_active_set(const NodeFlags& nodes) {
  const NodeFlags free = apart(parts_.space.facing().primary(), nodes);
  parts_.active_set.restrict_to(free);
  parts_.space.change_facing().restrict_to(free);
}

void ContactPass::augment(const FacingFields& fields) {
  parts_.laws.augment(nodal_loads(fields));
  geometry_->take_multipliers();
}

bool ContactPass::accept_step(const FacingFields& fields) {
  NodalLoads loads = nodal_loads(fields);
  const bool changes_averages = slips().accept(parts_.space, positions(fields), loads);
  parts_.laws.accept(loads);
  return changes_averages;
}

void ContactPass::forget() {
  geometry_->end_iterations();
  parts_.space.change_facing().clear();
  geometry_ = make_geometry();
}

std::size_t ContactPass::memory() const {
  return parts_.space.memory() + bytes(parts_.laws.multipliers.traction) +
         bytes(parts_.laws.multipliers.accepted_traction) + bytes(parts_.laws.multipliers.flux) +
         bytes(parts_.laws.penalties().traction) + bytes(parts_.laws.penalties().flux) + geometry_->memory();
}

}  // namespace mixture_contact
