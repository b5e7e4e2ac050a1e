#include "load_equations.h"

#include "contact/base/indexed_vector.h"

using mixture_contact::both_sides;
using mixture_contact::ContactInterface;
using mixture_contact::LoadPlace;
using mixture_contact::MultiplierLayout;
using mixture_contact::PerSide;

namespace {

/// The order of the loads of a surface's nodes.
MultiplierLayout layout(const ContactInterface& core, LoadEquations::Side surface) {
  return {core.mesh(surface).nodes, core.effects()};
}

}  // namespace

int LoadEquations::number(int first, const ContactInterface& core, PerSide<bool> surfaces) {
  first_ = first;
  count_ = 0;
  for (const Side side : both_sides) {
    start_[side] = surfaces[side] ? first_ + count_ : -1;
    if (surfaces[side]) count_ += indexing::as_int(layout(core, side).size());
  }
  return count_;
}

int LoadEquations::of(const NodeEquations& equations, const ContactInterface& core, Side surface,
                      const LoadPlace& load) const {
  const int start = start_[surface];
  if (start < 0 || equations.are_rigid({surface, load.columns})) return -1;
  const MultiplierLayout order = layout(core, surface);
  return start + indexing::as_int(load.field ? order.flux(load.node, *load.field) : order.traction(load.node));
}

UnknownLoad LoadEquations::unknown(const NodeEquations& equations, const ContactInterface& core, Side surface,
                                   const LoadPlace& load) const {
  const int equation = of(equations, core, surface, load);
  if (equation < 0) return {};
  return {equation, equations.unknowns(surface, load.node)};
}

void LoadEquations::serialize(DumpStream& ar) {
  ar & first_ & count_;
  for (int& start : start_) ar & start;
}
