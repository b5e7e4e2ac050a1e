#include "law/nodal_laws.h"

#include "law/laws.h"

#include <algorithm>

namespace mixture_contact {

NodalLaws::NodalLaws(const SurfaceMesh& primary, const SurfaceMesh& secondary, const Effects& effects,
                     const Settings& settings)
    : primary_(primary),
      secondary_(secondary),
      effects_(effects),
      settings_(settings),
      penalties_(at_nodes(mixture_contact::penalties(primary, secondary, effects, settings), primary)) {
  multipliers.traction.setZero(primary.nodes);
  multipliers.flux.setZero(effects.scalar_fields(), primary.nodes);
  multipliers.flux_penalty_scale.setOnes(effects.scalar_fields());
}

void NodalLaws::update_penalties() {
  penalties_ = at_nodes(mixture_contact::penalties(primary_, secondary_, effects_, settings_), primary_);
}

void NodalLaws::load(NodalLoads& loads, bool with_penalty) const {
  loads.traction.setZero(nodes());
  loads.flux.setZero(effects_.scalar_fields(), nodes());
  for (Index node = 0; node < nodes(); ++node) {
    if (!loads.in_contact[node]) continue;
    if (effects_.traction) loads.traction[node] = multipliers.traction[node];
    if (effects_.traction && with_penalty) loads.traction[node] += traction_penalty(node) * loads.gap[node];
    for (int field = 0; field < effects_.scalar_fields(); ++field) {
      if (!loads.exchanges(field, node)) continue;
      const double penalty = with_penalty ? flux_penalty(field, node) : 0.0;
      loads.flux(field, node) = normal_flux(multipliers.flux(field, node), penalty, loads.jump(field, node)).value;
    }
  }
}

double NodalLaws::traction_rounding(double surface_size) const {
  return multipliers.traction_penalty_scale * penalties_.traction.maxCoeff() * rounding_fraction * surface_size;
}

VectorXd NodalLaws::field_rounding(const FacingFields& fields, double surface_size) const {
  VectorXd rounding(effects_.scalar_fields());
  for (int field = 0; field < effects_.scalar_fields(); ++field) {
    const bool is_pressure = effects_.solvent && field == 0;
    const double stress = is_pressure ? penalties_.stiffness.maxCoeff() * surface_size : 0.0;
    rounding[field] = rounding_fraction * std::max({fields.primary.scalar.col(field).cwiseAbs().maxCoeff(),
                                                    fields.secondary.scalar.col(field).cwiseAbs().maxCoeff(), stress});
  }
  return rounding;
}

}  // namespace mixture_contact
