/// Lists of equations are told apart by their fingerprint.
#include "febio/fingerprint.h"

#include <boost/test/unit_test.hpp>

namespace {

Fingerprint of(const std::vector<std::vector<int>>& lists) {
  Fingerprint found;
  for (const std::vector<int>& list : lists) found.add(list);
  return found;
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_same_lists_in_the_same_order_have_the_same_one) {
  BOOST_TEST((of({{1, 2}, {3}}) == of({{1, 2}, {3}})));
  BOOST_TEST((of({}) == Fingerprint()));
}

BOOST_AUTO_TEST_CASE(numbers_their_order_and_the_ends_of_lists_tell_them_apart) {
  const Fingerprint reference = of({{1, 2}, {3}});
  for (const auto& other : {of({{1, 2}, {4}}), of({{2, 1}, {3}}), of({{1}, {2, 3}}), of({{1, 2, 3}}),
                            of({{1, 2}, {3}, {}}), of({{1, 2}})}) {
    BOOST_TEST(!(other == reference));
  }
}
