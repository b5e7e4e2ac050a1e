#include "interface/residual_ahead.h"

#include "enforcement/virtual_work.h"

#include <utility>

namespace mixture_contact {
namespace {

/// Tractions of these nodes alone.
NodalLoads of_nodes(const NodeFlags& nodes, NodalLoads loads) {
  for (Index node = 0; node < nodes.count(); ++node) {
    if (nodes[node]) continue;
    loads.in_contact[node] = false;
    loads.traction[node] = 0;
    if (!loads.friction.empty()) loads.friction.traction.col(node).setZero();
  }
  return loads;
}

}  // namespace

void residual_ahead(const ContactInterface& contact, const PerSide<SurfaceFields>& fields, double dt,
                    const ContactInterface::AddResidual& add) {
  if (!contact.effects().traction) return;
  for (std::size_t index = 0; index < contact.passes(); ++index) {
    const ContactPass& pass = contact.pass(index);
    if (!pass.active_set().can_expect()) continue;
    const Side side = index == 0 ? Side::primary : Side::secondary;
    NodalLoads now = pass.nodal_loads(seen_from(side, fields));
    const NodeFlags closed = pass.active_set().initial(now);
    NodeFlags ahead;
    for (Index node = 0; node < closed.count(); ++node) ahead.push_back(now.in_contact[node] && !closed[node]);
    nodal_residual(pass.space(), of_nodes(ahead, std::move(now)), seen_from(side, fields), dt,
                   [&](const Patch& patch, const VectorXd& values) { add({side, patch}, values); });
  }
}

}  // namespace mixture_contact
