#include "enforcement/augmentation.h"

#include <algorithm>
#include <cmath>

namespace mixture_contact {
namespace {

/// The traction penalties that augmentations may increase, without their factor; 0 at nodes that they leave out.
VectorXd growing_penalties(const NodalLaws& laws) {
  VectorXd growing = laws.penalties().traction;
  for (Index node = 0; node < growing.size(); ++node) {
    if (laws.has_soft_gap(node)) growing[node] = 0;
  }
  return growing;
}

}  // namespace

GapReport measure_gaps(const NodalLaws& laws, const NodalLoads& loads, const FacingFields& fields) {
  GapSums traction;
  IndexedVector<GapSums> slip(laws.tangential().count());
  IndexedVector<GapSums> flux(laws.effects().scalar_fields());
  const Penalties& base = laws.penalties();
  const VectorXd rounding = laws.field_rounding(fields, loads.size);
  for (Index node = 0; node < loads.area.size(); ++node) {
    if (!loads.in_contact[node]) continue;
    if (!laws.has_soft_gap(node)) {
      const double gap = laws.normal().residual_gap(loads.gap[node], loads.traction[node]);
      traction.add(loads.area[node], base.stiffness[node], gap, loads.traction[node], std::sqrt(loads.area[node]));
      for (GapSums& sums : slip) {
        const ElasticSlip elastic = elastic_slip(loads, node);
        sums.add(loads.area[node], base.stiffness[node], elastic.slip, elastic.traction, std::sqrt(loads.area[node]));
      }
    }
    if (!loads.flux_coupled[node]) continue;
    for (Index k = 0; k < flux.count(); ++k) {
      if (!laws.scalar(k).is_enforced()) continue;
      const bool is_rounding = std::abs(loads.jump(k, node)) <= rounding[k];
      flux[k].add(loads.flux_area(k, node), base.conductance(k, node), is_rounding ? 0.0 : loads.jump(k, node),
                  loads.flux(k, node), fields.primary.scalar(node, k));
    }
  }
  GapReport report{traction.field_gap(), {}, {}};
  for (const GapSums& sums : slip) report.slip.push_back(sums.field_gap());
  for (const GapSums& sums : flux) report.flux.push_back(sums.field_gap());
  return report;
}

bool grow_penalties(NodalLaws& laws, const GapReport& report, const Tolerances& tolerances) {
  const Penalties& penalty = laws.penalties();
  Multipliers& state = laws.multipliers;
  const VectorXd growing = growing_penalties(laws);
  bool any = grow(state.traction_penalty_scale, report.traction, tolerances.traction, growing, penalty.stiffness,
                  laws.largest_traction_factor());
  for (const FieldGap& slip : report.slip) {
    any = grow(state.friction_penalty_scale, slip, tolerances.traction, laws.friction_factor() * growing,
               penalty.stiffness, laws.largest_traction_factor()) ||
          any;
  }
  const double largest_flux_factor = laws.has_twin() ? two_pass_flux_factor : default_flux_factor;
  for (Index k = 0; k < report.flux.count(); ++k) {
    if (!laws.scalar(k).is_enforced()) continue;
    any = grow(state.flux_penalty_scale[k], report.flux[k], tolerance_of_flux(tolerances, laws.effects(), k),
               penalty.flux.row(k).transpose(), penalty.conductance.row(k).transpose(), largest_flux_factor) ||
          any;
  }
  return any;
}

}  // namespace mixture_contact
