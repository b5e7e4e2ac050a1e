#include "contact/base/local_memory.h"

#include <boost/test/unit_test.hpp>

#include <cstdint>
#include <vector>

using namespace mixture_contact;

namespace {

constexpr std::size_t bytes = 64 * sizeof(double);

/// True if a number is stored within an object.
template <class Object>
bool is_within(const double& number, const Object& object) {
  const auto address = reinterpret_cast<std::uintptr_t>(&number);
  const auto first = reinterpret_cast<std::uintptr_t>(&object);
  return address >= first && address < first + sizeof(object);
}

}  // namespace

BOOST_AUTO_TEST_CASE(what_fits_takes_nothing_from_the_heap_and_what_does_not_does) {
  LocalMemory<bytes> memory;
  std::pmr::vector<double> small(16, 1.5, memory.resource());
  std::pmr::vector<double> large(64, 2.5, memory.resource());
  BOOST_TEST(is_within(small.front(), memory));
  BOOST_TEST(!is_within(large.front(), memory));
  BOOST_TEST(small.back() == 1.5);
  BOOST_TEST(large.back() == 2.5);
}
