/// Tests that the plugin fits an FEBio of the release for which it was built, with the same virtual table, and no
/// other.
#include "febio/running_febio.h"

#include <boost/test/unit_test.hpp>
#include <map>

namespace {

char release_text[] = "4.11.2";
char* release() { return release_text; }

/// A fake FEBio with the symbols of the release for which the plugin was built.
class FakeFebio {
 public:
  FakeFebio() {
    for (const Hook& hook : hooks()) {
      table_[2 + hook.place] = &functions_[hook.symbol];
      symbols_[hook.symbol] = &functions_[hook.symbol];
    }
    symbols_["_ZTV23FESurfacePairConstraint"] = table_;
    symbols_["_ZN5febio16getVersionStringEv"] = reinterpret_cast<void*>(&release);
  }

  void forget(const std::string& symbol) { symbols_.erase(symbol); }
  void exchange(const Hook& one, const Hook& other) { std::swap(table_[2 + one.place], table_[2 + other.place]); }

  std::string misfit(const std::string& built_for) const {
    return ::misfit(built_for, [this](const char* symbol) -> void* {
      const auto found = symbols_.find(symbol);
      return found == symbols_.end() ? nullptr : found->second;
    });
  }

 private:
  std::map<std::string, char> functions_;
  std::map<std::string, void*> symbols_;
  void* table_[200] = {};
};

bool says(const std::string& sentence, const std::string& words) { return sentence.find(words) != std::string::npos; }

}  // namespace

BOOST_AUTO_TEST_CASE(the_same_release_fits) {
  BOOST_TEST(FakeFebio().misfit("4.11.2") == "");
  BOOST_TEST(FakeFebio().misfit("4.11.0") == "");
}

BOOST_AUTO_TEST_CASE(another_release_does_not_fit_and_both_are_named) {
  for (const std::string built_for : {"4.10.0", "4.12.0", "4.1.0", "5.11.2"}) {
    const std::string sentence = FakeFebio().misfit(built_for);
    BOOST_TEST(says(sentence, "built for FEBio " + built_for));
    BOOST_TEST(says(sentence, "it is release 4.11.2"));
  }
}

BOOST_AUTO_TEST_CASE(where_a_release_is_not_known_the_functions_decide) {
  FakeFebio febio;
  BOOST_TEST(febio.misfit("") == "");
  febio.forget("_ZN5febio16getVersionStringEv");
  BOOST_TEST(febio.misfit("4.10.0") == "");
}

BOOST_AUTO_TEST_CASE(an_febio_without_a_hook_does_not_fit_and_the_hook_is_named) {
  BOOST_TEST(hooks().size() == 4);
  for (const Hook& hook : hooks()) {
    FakeFebio febio;
    febio.forget(hook.symbol);
    BOOST_TEST(says(febio.misfit("4.11.0"), std::string("no ") + hook.name));
  }
}

BOOST_AUTO_TEST_CASE(an_febio_that_calls_hooks_by_other_places_does_not_fit) {
  FakeFebio febio;
  febio.exchange(hooks()[1], hooks()[3]);
  BOOST_TEST(says(febio.misfit("4.11.0"), "a different position of PrepStep"));
}

BOOST_AUTO_TEST_CASE(the_libraries_that_the_build_found_fit) {
  BOOST_TEST(running_symbols()("_ZTV23FESurfacePairConstraint") != nullptr);
  BOOST_TEST(misfit("", running_symbols()) == "");
}
