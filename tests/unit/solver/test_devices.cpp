#include "solver/devices.h"

#include <boost/test/unit_test.hpp>

using newton::Device;
using newton::has;
using newton::named_devices;

BOOST_AUTO_TEST_CASE(all_none_and_names_with_commas_between_them_are_read) {
  BOOST_TEST(named_devices("all").set.all());
  BOOST_TEST(named_devices("none").set.none());
  const newton::NamedDevices two = named_devices(" kept_matrix,\tline_search_guard ");
  BOOST_TEST(two.unknown.empty());
  BOOST_TEST(two.set.count() == 2U);
  BOOST_TEST(has(two.set, Device::kept_matrix));
  BOOST_TEST(has(two.set, Device::line_search_guard));
}

BOOST_AUTO_TEST_CASE(a_word_that_names_no_device_is_reported) {
  const newton::NamedDevices found = named_devices("kept_matrix, magic");
  BOOST_TEST(found.unknown.size() == 1U);
  BOOST_TEST(found.unknown.front() == "magic");
}

BOOST_AUTO_TEST_CASE(what_names_print_can_be_read_again) {
  for (const char* const list : {"all", "none", "kept_matrix, predictor"}) {
    const newton::DeviceSet set = named_devices(list).set;
    BOOST_TEST((named_devices(newton::names(set)).set == set));
  }
}

BOOST_AUTO_TEST_CASE(a_record_counts_what_acts_and_is_suspended_for_the_first_time_once) {
  newton::DeviceRecord record;
  BOOST_TEST(record.summary().empty());
  record.acted(Device::kept_matrix);
  record.acted(Device::kept_matrix);
  BOOST_TEST(record.summary().find(" kept_matrix 2.") != std::string::npos);
  BOOST_TEST(record.suspend());
  BOOST_TEST(record.is_suspended());
  record.resume();
  BOOST_TEST(!record.is_suspended());
  BOOST_TEST(!record.suspend());
}
