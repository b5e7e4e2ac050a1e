/// What a pass of a contact keeps in memory: a part of ContactPass.
#include "interface/pass.h"

namespace mixture_contact {
namespace {

template <class Matrix>
std::size_t bytes(const Eigen::PlainObjectBase<Matrix>& matrix) {
  return static_cast<std::size_t>(matrix.size()) * sizeof(typename Matrix::Scalar);
}

template <class Entry>
std::size_t bytes(const std::vector<Entry>& entries) {
  return entries.capacity() * sizeof(Entry);
}

std::size_t bytes(const NodalLoads& loads) {
  return bytes(loads.area) + bytes(loads.gap) + bytes(loads.traction) + bytes(loads.flux_area) + bytes(loads.jump) +
         bytes(loads.flux);
}

std::size_t bytes(const Patch& patch) { return bytes(patch.primary) + bytes(patch.secondary) + bytes(patch.fields); }

std::size_t bytes(const SurfaceFields& fields) { return bytes(fields.position) + bytes(fields.scalar); }

}  // namespace

std::size_t ContactPass::memory() const {
  std::size_t sum = points_->memory() + bytes(pairs_) + bytes(multipliers.traction) + bytes(multipliers.flux) +
                    bytes(penalties_.traction) + bytes(penalties_.flux) + bytes(bearing_);
  for (const FacetPair& pair : pairs_) sum += bytes(pair.points);
  if (!held_) return sum;
  sum += bytes(held_->loads) + bytes(held_->primary) + bytes(held_->secondary) + bytes(held_->geometric_traction) +
         bytes(held_->geometric_flux) + bytes(held_->changes) + bytes(held_->multiplier_weights) + bytes(held_->nodes);
  for (const NodeLinearisation& node : held_->nodes) {
    sum += bytes(node.patch) + bytes(node.gap_variation) + bytes(node.traction_work) + bytes(node.jumps);
    for (const NodeLinearisation::Jump& jump : node.jumps) sum += bytes(jump.drift) + bytes(jump.weights);
  }
  return sum;
}

std::size_t ContactPass::points() const {
  std::size_t count = 0;
  for (const FacetPair& pair : pairs_) count += pair.points.size();
  return count;
}

}  // namespace mixture_contact
