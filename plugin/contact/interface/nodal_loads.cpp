/// What the laws say at the nodes, from averages around each: a part of ContactPass.
#include "base/parallel.h"
#include "interface/pass.h"

namespace mixture_contact {
namespace {

/// As SeenGaps for the jumps of the fields that a pair exchanges; no fields where it carries no load.
struct JumpSums {
  std::vector<int> fields;
  FacetVector area;  ///< INT psi_a da
  MatrixXd jump;     ///< (fields, nodes): INT psi_a jump da
};

}  // namespace

SeenGaps ContactPass::gap_sums(const FacetPair& pair, const Matrix3Xd& x1, const Matrix3Xd& x2) const {
  SeenGaps sums = SeenGaps::Zero(2, node_count(primary_facet(pair).type));
  for (const IntegrationPoint& place : pair.points) {
    const PointKinematics point = kinematics(pair, place, x1, x2);
    const FacetVector psi = multiplier_shape(pair.primary, place.sub_facet, place.xi).value;
    sums.row(0) += place.weight * point.area * psi;
    sums.row(1) += place.weight * point.area * point.gap * psi;
  }
  return sums;
}

void ContactPass::average_gaps(const Matrix3Xd& x1, const Matrix3Xd& x2, NodalLoads& loads) const {
  loads.area.setZero(primary_.nodes);
  loads.gap.setZero(primary_.nodes);
  const auto sums_of = [&](std::size_t index) { return gap_sums(pairs_[index], x1, x2); };
  in_order(pairs_.size(), sums_of, [&](std::size_t index, const SeenGaps& sums) {
    const Facet& facet = primary_facet(pairs_[index]);
    for (Index a = 0; a < sums.cols(); ++a) {
      const int node = facet.nodes[static_cast<std::size_t>(a)];
      loads.area[node] += sums(0, a);
      loads.gap[node] += sums(1, a);
    }
  });
  loads.gap = (loads.area.array() > 0).select(loads.gap.array() / loads.area.array(), 0.0);
}

void ContactPass::average_jumps(const SurfaceFields& primary, const SurfaceFields& secondary, NodalLoads& loads) const {
  loads.flux_area.setZero(effects_.scalar_fields(), primary_.nodes);
  loads.jump.setZero(effects_.scalar_fields(), primary_.nodes);
  if (effects_.scalar_fields() == 0) return;
  const auto sums_of = [&](std::size_t index) {
    const FacetPair& pair = pairs_[index];
    JumpSums sums;
    if (!carries_load(pair, loads.in_contact)) return sums;
    sums.fields = exchanged_fields(pair);
    sums.area.setZero(node_count(primary_facet(pair).type));
    sums.jump.setZero(static_cast<Index>(sums.fields.size()), sums.area.size());
    for (const IntegrationPoint& place : pair.points) {
      const PointKinematics point = kinematics(pair, place, primary.position, secondary.position);
      const FacetVector share = place.weight * point.area *
                                multiplier_shape(pair.primary, place.sub_facet, place.xi).value;
      const PairVector h = point.jump_weights();
      sums.area += share;
      for (std::size_t k = 0; k < sums.fields.size(); ++k) {
        sums.jump.row(static_cast<Index>(k)) += h.dot(pair_values(pair, sums.fields[k], primary, secondary)) * share;
      }
    }
    return sums;
  };
  in_order(pairs_.size(), sums_of, [&](std::size_t index, const JumpSums& sums) {
    const Facet& facet = primary_facet(pairs_[index]);
    for (std::size_t k = 0; k < sums.fields.size(); ++k) {
      for (Index a = 0; a < sums.area.size(); ++a) {
        const int node = facet.nodes[static_cast<std::size_t>(a)];
        loads.flux_area(sums.fields[k], node) += sums.area[a];
        loads.jump(sums.fields[k], node) += sums.jump(static_cast<Index>(k), a);
      }
    }
  });
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
    if (effects_.traction) loads.traction[node] = multipliers.traction[node];
    if (effects_.traction && penalised) loads.traction[node] += traction_penalty(node) * loads.gap[node];
    for (int field = 0; field < effects_.scalar_fields(); ++field) {
      if (!passes(loads, field, node)) continue;
      const double penalty = penalised ? flux_penalty(field, node) : 0.0;
      loads.flux(field, node) = normal_flux(multipliers.flux(field, node), penalty, loads.jump(field, node)).value;
    }
  }
}

NodalLoads ContactPass::nodal_loads(const SurfaceFields& primary, const SurfaceFields& secondary) const {
  if (frozen_) return frozen_loads(*frozen_, primary, secondary);
  if (held_) return predicted_loads(*held_, primary, secondary);
  const std::vector<bool> status = natural_status(primary.position, secondary.position);
  NodalLoads loads = averages(primary, secondary, status, status);
  apply_laws(loads);
  loads.traction = loads.traction.cwiseMin(0.0);
  return loads;
}

}  // namespace mixture_contact
