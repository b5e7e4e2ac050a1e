/// Memory for objects that live for a short while.
#pragma once

#include <array>
#include <cstddef>
#include <memory_resource>

namespace mixture_contact {

/// Memory for containers that live no longer than it: so many bytes on the stack, then the heap. Returned memory is
/// not used again before it ends.
template <std::size_t Bytes>
class LocalMemory {
 public:
  LocalMemory() : resource_(bytes_.data(), bytes_.size()) {}
  LocalMemory(const LocalMemory&) = delete;
  LocalMemory& operator=(const LocalMemory&) = delete;
  LocalMemory(LocalMemory&&) = delete;
  LocalMemory& operator=(LocalMemory&&) = delete;
  ~LocalMemory() = default;

  std::pmr::memory_resource* resource() { return &resource_; }

 private:
  alignas(std::max_align_t) std::array<std::byte, Bytes> bytes_;
  std::pmr::monotonic_buffer_resource resource_;
};

}  // namespace mixture_contact
