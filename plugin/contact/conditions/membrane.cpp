#include "conditions/membrane.h"

#include <algorithm>
#include <cmath>

namespace mixture_contact {
namespace {

/// B(x) = x/(e^x - 1) and its derivative. For |x| below `small`, the series up to the term before x^4/720.
LawValue bernoulli(double x) {
  constexpr double small = 1e-3;
  if (std::abs(x) < small) return {1 - x / 2 + x * x / 12, -0.5 + x / 6 - x * x * x / 180};
  const double growth = std::expm1(x);
  if (std::isinf(growth)) return {0, 0};
  const double value = x / growth;
  return {value, (1 - value * (growth + 1)) / growth};
}

/// Coefficients of the jumps of all fields in the pressure that drives the solvent.
VectorXd drive(const Effects& effects, const MembraneRule& rule) {
  VectorXd drive = VectorXd::Zero(effects.scalar_fields());
  drive[0] = 1;
  for (int k = 0; k < number_of(effects.solutes); ++k) {
    const auto film = rule.solutes.find(at(effects.solutes, k));
    if (film != rule.solutes.end()) drive[1 + k] = rule.thermal_energy * (1 - film->second.reflection);
  }
  return drive;
}

}  // namespace

LawValue against_flow(double permeance, double flow) {
  if (permeance == 0) return flow < 0 ? LawValue{-flow, -1} : LawValue{0, flow > 0 ? 0.0 : -0.5};
  const LawValue b = bernoulli(flow / permeance);
  return {permeance * b.value, b.derivative};
}

FieldMask SolventMembrane::drivers() const {
  FieldMask mask = 0;
  for (int k = 0; k < drive_.size(); ++k) mask |= drive_[k] == 0 ? FieldMask{0} : only(k);
  return mask;
}

FluxLaw SolventMembrane::flux(const NodalLoads& at, Index node, const Enforcing& /*by*/) const {
  return {conductance_ * drive_.dot(at.jump.col(node)), conductance_ * drive_, VectorXd::Zero(drive_.size())};
}

FieldMask SoluteMembrane::drivers() const {
  const bool is_carried = solvent_ != nullptr && film_.reflection < 1;
  return only(field()) | (is_carried ? solvent_->drivers() : FieldMask{0});
}

FluxLaw SoluteMembrane::carrying_flow(const NodalLoads& at, Index node) const {
  const VectorXd none = VectorXd::Zero(at.jump.rows());
  if (solvent_ == nullptr || !at.exchanges(solvent_->field(), node)) return {0, none, none};
  FluxLaw flow = solvent_->flux(at, node, {});
  flow.value *= 1 - film_.reflection;
  flow.d_jump *= 1 - film_.reflection;
  return flow;
}

FluxLaw SoluteMembrane::flux(const NodalLoads& at, Index node, const Enforcing& /*by*/) const {
  FluxLaw flux = carrying_flow(at, node);
  const double flow = flux.value;
  const LawValue spread = against_flow(film_.permeance, flow);
  const double jump = at.jump(field(), node);
  const double own = at.own(field(), node);
  flux.value = flow * own + spread.value * jump;
  flux.d_jump *= own + spread.derivative * jump;
  flux.d_jump[field()] += spread.value;
  flux.d_own[field()] = flow;
  return flux;
}

IndexedVector<std::unique_ptr<ScalarCondition>> scalar_conditions(const Effects& effects, const MembraneRule& rule,
                                                                  double share) {
  IndexedVector<std::unique_ptr<ScalarCondition>> conditions;
  const SolventMembrane* film = nullptr;
  if (effects.solvent && rule.conductance) {
    auto solvent = std::make_unique<SolventMembrane>(0, share * *rule.conductance, drive(effects, rule));
    film = solvent.get();
    conditions.push_back(std::move(solvent));
  } else if (effects.solvent) {
    conditions.push_back(std::make_unique<Continuous>(0));
  }
  for (const int solute : effects.solutes) {
    const int field = indexing::as_int(conditions.count());
    const auto own = rule.solutes.find(solute);
    if (own == rule.solutes.end()) {
      conditions.push_back(std::make_unique<Continuous>(field));
    } else {
      const SoluteFilm of_pass{share * own->second.permeance, own->second.reflection};
      conditions.push_back(std::make_unique<SoluteMembrane>(field, of_pass, film));
    }
  }
  return conditions;
}

}  // namespace mixture_contact
