/// Memory of containers [bytes].
#pragma once

#include "base/patch.h"

#include <vector>

namespace mixture_contact {

template <class Matrix>
std::size_t bytes(const Eigen::PlainObjectBase<Matrix>& matrix) {
  return static_cast<std::size_t>(matrix.size()) * sizeof(typename Matrix::Scalar);
}

template <class Entry>
std::size_t bytes(const std::vector<Entry>& entries) {
  return entries.capacity() * sizeof(Entry);
}

inline std::size_t bytes(const Patch& patch) {
  return bytes(patch.primary) + bytes(patch.secondary) + bytes(patch.fields);
}

}  // namespace mixture_contact
