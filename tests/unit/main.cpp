// The test runner. It is compiled once for all test_*.cpp, because the header-only Boost.Test takes ten seconds to
// compile.
#define BOOST_TEST_MODULE contact_core
#include <boost/test/included/unit_test.hpp>
