/// Memory on the stack for short-lived containers.
#pragma once

#include <array>
#include <cstddef>
#include <memory_resource>

namespace mixture_contact {

/// A memory resource for containers that do not outlive it: first `Bytes` bytes on the stack, then the heap. Memory
/// that containers return is not reused before the resource is destroyed.
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
