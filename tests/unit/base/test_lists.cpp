#include "contact/base/lists.h"

#include <boost/test/unit_test.hpp>

using namespace mixture_contact;

namespace {

using Numbers = std::vector<int>;

Numbers entries_of(const Lists<int>& lists, Index list) {
  const Span<int> entries = lists[list];
  return {entries.begin(), entries.end()};
}

/// Entries of several lists in mixed order.
const std::vector<std::pair<Index, int>> unordered{{2, 20}, {0, 1}, {2, 21}, {0, 2}, {2, 22}};

}  // namespace

BOOST_AUTO_TEST_CASE(lists_that_are_filled_in_any_order_have_their_entries_as_they_came) {
  const Lists<int> lists(4, [](const auto& add) {
    for (const auto& [list, entry] : unordered) add(list, entry);
  });
  BOOST_TEST(lists.count() == 4);
  BOOST_TEST(entries_of(lists, 0) == Numbers({1, 2}));
  BOOST_TEST(lists[1].empty());
  BOOST_TEST(entries_of(lists, 2) == Numbers({20, 21, 22}));
  BOOST_TEST(lists[2].front() == 20);
  BOOST_TEST(lists[2][1] == 21);
  BOOST_TEST(lists[3].count() == 0);
}

BOOST_AUTO_TEST_CASE(lists_are_added_behind_the_others) {
  Lists<int> lists;
  BOOST_TEST(lists.count() == 0);
  lists.add(Numbers{1, 2});
  lists.add(Numbers{});
  lists.add_to_next(5);
  lists.add_to_next(6);
  lists.end_next();
  BOOST_TEST(lists.count() == 3);
  BOOST_TEST(entries_of(lists, 0) == Numbers({1, 2}));
  BOOST_TEST(lists[1].empty());
  BOOST_TEST(entries_of(lists, 2) == Numbers({5, 6}));
  lists.clear();
  BOOST_TEST(lists.count() == 0);
  lists.add(Numbers{7});
  BOOST_TEST(entries_of(lists, 0) == Numbers({7}));
}
