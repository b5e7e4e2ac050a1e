/// What the laws say at the nodes, from averages around each: a part of ContactPass.
#include "pass.h"

#include <cmath>

namespace mixture_contact {

void ContactPass::average_gaps(const Matrix3Xd& x1, const Matrix3Xd& x2, NodalLoads& loads) const {
  loads.area.setZero(primary_.nodes);
  loads.absolute_area.setZero(primary_.nodes);
  loads.gap.setZero(primary_.nodes);
  for (const FacetPair& pair : pairs_) {
    const Facet& facet = primary_facet(pair);
    for (const IntegrationPoint& place : pair.points) {
      const PointKinematics point = kinematics(pair, place, x1, x2);
      const FacetVector share = place.weight * point.area * multiplier_shape(pair, point);
      for (Index a = 0; a < share.size(); ++a) {
        const int node = facet.nodes[static_cast<std::size_t>(a)];
        loads.area[node] += share[a];
        loads.absolute_area[node] += std::abs(share[a]);
        loads.gap[node] += share[a] * point.gap;
      }
    }
  }
  loads.gap = (loads.area.array() > 0).select(loads.gap.array() / loads.area.array(), 0.0);
}

void ContactPass::average_jumps(const SurfaceFields& primary, const SurfaceFields& secondary, NodalLoads& loads) const {
  loads.flux_area.setZero(effects_.scalar_fields(), primary_.nodes);
  loads.jump.setZero(effects_.scalar_fields(), primary_.nodes);
  for (const FacetPair& pair : pairs_) {
    if (effects_.scalar_fields() == 0 || !carries_load(pair, loads.in_contact)) continue;
    const Facet& facet = primary_facet(pair);
    const std::vector<int> fields = exchanged_fields(pair);
    for (const IntegrationPoint& place : pair.points) {
      const PointKinematics point = kinematics(pair, place, primary.position, secondary.position);
      const FacetVector share = place.weight * point.area * multiplier_shape(pair, point);
      const PairVector h = point.jump_weights();
      for (const int field : fields) {
        const double jump = h.dot(pair_values(pair, field, primary, secondary));
        for (Index a = 0; a < share.size(); ++a) {
          const int node = facet.nodes[static_cast<std::size_t>(a)];
          loads.flux_area(field, node) += share[a];
          loads.jump(field, node) += share[a] * jump;
        }
      }
    }
  }
  loads.jump = (loads.flux_area.array() > 0).select(loads.jump.array() / loads.flux_area.array(), 0.0);
}

NodalLoads ContactPass::averages(const SurfaceFields& primary, const SurfaceFields& secondary,
                                 std::vector<bool> in_contact, std::vector<bool> sealed) const {
  NodalLoads loads;
  loads.in_contact = std::move(in_contact);
  loads.sealed = std::move(sealed);
  average_gaps(primary.position, secondary.position, loads);
  average_jumps(primary, secondary, loads);
  return loads;
}

void ContactPass::apply_laws(NodalLoads& loads) const {
  loads.traction.setZero(primary_.nodes);
  loads.flux.setZero(effects_.scalar_fields(), primary_.nodes);
  const bool penalised = !has_unknown_multipliers();  // multipliers that are unknowns are the loads
  for (Index node = 0; node < primary_.nodes; ++node) {
    if (!loads.in_contact[static_cast<std::size_t>(node)]) continue;
    loads.traction[node] = multipliers.traction[node];
    if (penalised) loads.traction[node] += traction_penalty(node) * loads.gap[node];
    for (int field = 0; field < effects_.scalar_fields(); ++field) {
      if (!passes(loads, field, node)) continue;
      const double penalty = penalised ? flux_penalty(field, node) : 0.0;
      loads.flux(field, node) = normal_flux(multipliers.flux(field, node), penalty, loads.jump(field, node)).value;
    }
  }
}

NodalLoads ContactPass::nodal_loads(const SurfaceFields& primary, const SurfaceFields& secondary) const {
  if (held_) return predicted_loads(*held_, primary, secondary);
  const std::vector<bool> status = natural_status(primary.position, secondary.position);
  NodalLoads loads = averages(primary, secondary, status, status);
  apply_laws(loads);
  loads.traction = loads.traction.cwiseMin(0.0);
  return loads;
}

}  // namespace mixture_contact
