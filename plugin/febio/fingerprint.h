/// Tells sequences of lists of numbers apart without keeping them.
#pragma once

#include <cstdint>
#include <vector>

/// A 64-bit hash (FNV-1a): two sequences that differ have the same one with a probability of 2^-64.
class Fingerprint {
 public:
  void add(const std::vector<int>& list) {
    add(static_cast<int>(list.size()));
    for (const int number : list) add(number);
  }
  void add(const std::vector<int>& one, const std::vector<int>& other) {
    add(one);
    add(other);
  }
  /// A number that comes with a list.
  void add(int number, const std::vector<int>& list) {
    add(number);
    add(list);
  }
  bool operator==(const Fingerprint& other) const { return value_ == other.value_; }

 private:
  void add(int number) { value_ = (value_ ^ static_cast<std::uint32_t>(number)) * 1099511628211U; }

  std::uint64_t value_ = 14695981039346656037U;
};
