#include "conditions/penalty.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mixture_contact {
namespace {

/// Harmonic mean of the positive entries, in which infinite entries have no resistance; 0 if no entry is positive.
double harmonic_mean(const Eigen::Ref<const VectorXd>& values) {
  double resistance = 0;
  int count = 0;
  for (const double value : values) {
    if (!(value > 0)) continue;
    resistance += 1 / value;
    ++count;
  }
  if (count == 0) return 0;
  return resistance > 0 ? count / resistance : std::numeric_limits<double>::infinity();
}

/// The conductance that represents the solvent storage of a facet's elements in a time step. `primary`, `secondary`:
/// stiffness of both sides.
double storage(double primary, double secondary, double time_step) {
  return time_step > 0 ? in_series(1 / primary, 1 / secondary) / time_step : 0.0;
}

/// The penalty rule of a field. A membrane's conductance or permeance takes the place of a penalty; it is the scale for
/// the rounding of the membrane's flux.
PenaltyRule rule_of(int field, const Effects& effects, const Settings& settings) {
  const bool is_solvent = effects.solvent && field == 0;
  const MembraneRule& film = settings.membrane;
  if (is_solvent) return film.conductance ? PenaltyRule{false, *film.conductance} : settings.solvent;
  const auto own = film.solutes.find(at(effects.solutes, effects.solvent ? field - 1 : field));
  return own != film.solutes.end() ? PenaltyRule{false, own->second.permeance} : settings.solute;
}

double apply(const PenaltyRule& rule, double base) { return rule.automatic ? rule.value * base : rule.value; }

}  // namespace

double in_series(double one, double other) {
  if (!(one > 0) || !(other > 0)) return 0;
  const double resistance = 0.5 * (1 / one + 1 / other);
  return resistance > 0 ? 1 / resistance : std::numeric_limits<double>::infinity();
}

Penalties penalties(const SurfaceMesh& primary, const SurfaceMesh& secondary, const Effects& effects,
                    const Settings& settings) {
  const auto facets = primary.facets.count();
  const Index fields = effects.scalar_fields();
  Penalties result{VectorXd(facets), MatrixXd(fields, facets), VectorXd(facets), MatrixXd(fields, facets)};
  const double secondary_stiffness = harmonic_mean(secondary.stiffness);
  for (Index f = 0; f < facets; ++f) {
    result.stiffness[f] = in_series(primary.stiffness[f], secondary_stiffness);
    result.traction[f] = apply(settings.traction, result.stiffness[f]) / settings.reduced_traction.divisor;
    // Two rigid sides have no elements whose stiffness could be the scale of gaps; an explicit penalty replaces it.
    if (std::isinf(result.stiffness[f])) result.stiffness[f] = result.traction[f];
  }
  for (Index k = 0; k < fields; ++k) {
    const double secondary_conductance = harmonic_mean(secondary.conductance.row(k).transpose());
    const bool is_solvent = effects.solvent && k == 0;
    const PenaltyRule rule = rule_of(indexing::as_int(k), effects, settings);
    for (Index f = 0; f < facets; ++f) {
      double& conductance = result.conductance(k, f);
      conductance = in_series(primary.conductance(k, f), secondary_conductance);
      if (is_solvent && conductance > 0) {
        const double stored = storage(primary.stiffness[f], secondary_stiffness, settings.solvent.time_step);
        conductance = std::max(conductance, storage_part * stored);
      }
      result.flux(k, f) = apply(rule, result.conductance(k, f));
    }
  }
  return result;
}

Penalties at_nodes(const Penalties& facets, const SurfaceMesh& primary) {
  const Index fields = facets.flux.rows();
  Penalties nodes{VectorXd::Zero(primary.nodes), MatrixXd::Zero(fields, primary.nodes), VectorXd::Zero(primary.nodes),
                  MatrixXd::Zero(fields, primary.nodes)};
  VectorXd count = VectorXd::Zero(primary.nodes);
  for (Index f = 0; f < primary.facets.count(); ++f) {
    const Facet& facet = primary.facets[f];
    for (const int node : facet) {
      count[node] += 1;
      nodes.traction[node] += facets.traction[f];
      nodes.stiffness[node] += facets.stiffness[f];
      nodes.flux.col(node) += facets.flux.col(f);
      nodes.conductance.col(node) += facets.conductance.col(f);
    }
  }
  for (Index node = 0; node < primary.nodes; ++node) {
    const double share = 1 / std::max(1.0, count[node]);
    nodes.traction[node] *= share;
    nodes.stiffness[node] *= share;
    nodes.flux.col(node) *= share;
    nodes.conductance.col(node) *= share;
  }
  return nodes;
}

void soften(Penalties& nodes, const NodeFlags& fixed) {
  for (Index node = 0; node < fixed.count(); ++node) {
    if (fixed[node]) nodes.traction[node] = std::min(nodes.traction[node], nodes.stiffness[node]);
  }
}

}  // namespace mixture_contact
