#include "host/mixed_form.h"

MixedForm mixed_form(const mixture_contact::LoadBlock& load) {
  // The unknown is z = load_unknown_scale variation.du/|variation|.
  const double length = load.variation.norm();
  const double of_one = load.factor * length / load_unknown_scale;
  return {of_one * load.work, load.variation / length, -1 / load_unknown_scale, of_one};
}
