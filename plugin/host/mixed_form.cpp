#include "host/mixed_form.h"

MixedForm mixed_form(const mixture_contact::LoadBlock& load) {
  // z = scale variation.du/|variation|
  const double length = load.variation.norm();
  return {(load.factor * length / load_unknown_scale) * load.work, load.variation / length, -1 / load_unknown_scale};
}
