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
    : effects_(effects),
      space_(primary, secondary, effects, settings),
      laws_(primary, secondary, effects, settings),
      active_set_(laws_),
      method_(enforcement_method(settings.enforcement, space_, laws_)),
      geometry_(make_geometry()) {
  if (primary.joined.count() > 0) active_set_.restrict_to(apart(primary, NodeFlags(primary.nodes, true)));
  if (!settings.gap.may_touch) restrict_active_set(NodeFlags(primary.nodes, false));
}

std::unique_ptr<ContactGeometry> ContactPass::make_geometry() {
  if (effects_.traction) return std::make_unique<MovingGeometry>(space_, laws_, active_set_, *method_);
  return std::make_unique<FixedGeometry>(space_, active_set_, *method_);
}

void ContactPass::project(const FacingPositions& x, const Reach& reach) {
  space_.change_facing().search(x, reach);
  geometry_->update(x);
}

void ContactPass::project_on_same_facets(const FacingPositions& x) {
  space_.change_facing().project_on_same_facets(x);
  geometry_->update(x);
}

void ContactPass::restrict_active_set(const NodeFlags& nodes) {
  const NodeFlags free = apart(space_.facing().primary(), nodes);
  active_set_.restrict_to(free);
  space_.change_facing().restrict_to(free);
}

void ContactPass::augment(const FacingFields& fields) {
  laws_.augment(nodal_loads(fields));
  geometry_->take_multipliers();
}

bool ContactPass::accept_step(const FacingFields& fields) {
  NodalLoads loads = nodal_loads(fields);
  const bool changes_averages = space_.kept_slips().measure_from(positions(fields));
  space_.slips().convect(loads.friction, space_, loads.in_contact, fields.primary.position);
  laws_.accept(loads);
  return changes_averages;
}

void ContactPass::update(const Settings& settings) {
  space_.measure_gaps_from(settings.gap.offset);
  space_.kept_slips().measure_pressure_from(settings.friction.ambient_pressure);
}

void ContactPass::forget() {
  geometry_->end_iterations();
  space_.change_facing().clear();
  geometry_ = make_geometry();
}

std::size_t ContactPass::memory() const {
  return space_.memory() + bytes(laws_.multipliers.traction) + bytes(laws_.multipliers.accepted_traction) +
         bytes(laws_.multipliers.flux) + bytes(laws_.penalties().traction) + bytes(laws_.penalties().flux) +
         geometry_->memory();
}

}  // namespace mixture_contact
