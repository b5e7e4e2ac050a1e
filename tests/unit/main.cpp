// The test runner, compiled once for all test_*.cpp: Boost.Test header-only takes ten seconds to compile.
#define BOOST_TEST_MODULE contact_core
#include <boost/test/included/unit_test.hpp>
