#include "reducible_penalties.h"

#include <utility>

std::string ReduciblePenalties::fail(double time, double dt) {
  const bool says = reduction_.fail(dt) && !std::exchange(said_, true);
  return says ? reduction_line(time) : "";
}

void ReduciblePenalties::note(const std::string& contact, const mixture_contact::Overlap& overlap, double time) {
  if (overlap.share > accepted_.overlap.share) accepted_ = {contact, overlap, time};
}

std::string ReduciblePenalties::summary() const {
  return accepted_.overlap.depth > 0 ? accepted_overlap_line(accepted_, reduction_.divisor()) : "";
}
