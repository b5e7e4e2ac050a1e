#include "conditions/scalar.h"

namespace mixture_contact {

FluxLaw Continuous::flux(const NodalLoads& at, Index node, const Enforcing& by) const {
  const LawValue law = augmented(by.multiplier, by.penalty, at.jump(field(), node));
  const VectorXd none = VectorXd::Zero(at.jump.rows());
  FluxLaw flux{law.value, none, none};
  flux.d_jump[field()] = law.derivative;
  return flux;
}

double Continuous::value(const NodalLoads& at, Index node, const Enforcing& by) const {
  return augmented(by.multiplier, by.penalty, at.jump(field(), node)).value;
}

}  // namespace mixture_contact
