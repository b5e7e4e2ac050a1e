// Tests that results are the same to the bit for any number of threads.
#include "contact/base/in_order.h"
#include "surfaces.h"

#include <boost/test/unit_test.hpp>

#ifdef _OPENMP
#include <omp.h>
#endif

#include <numeric>
#include <set>
#include <stdexcept>
#include <thread>

namespace {

using namespace test;

void use_threads([[maybe_unused]] int threads) {
#ifdef _OPENMP
  omp_set_num_threads(threads);
#endif
}

/// All results of a step of a contact: search, status, residual, tangent and output.
VectorXd answers(const Scene& scene, int threads) {
  use_threads(threads);
  const GlobalLayout layout(scene);
  const auto contact = scene.contact();
  contact->begin_iteration(scene.fields);
  PerSide<SurfaceFields> trial = scene.fields;
  trial[Side::primary].position.row(2).array() += 1e-3;
  const NodalOutput out = output(*contact, trial).nodes[Side::primary];
  std::vector<VectorXd> parts{assembled_residual(*contact, layout, trial, 0.5), out.gap, out.pressure,
                              assembled_tangent(*contact, layout, scene.fields, 0.5).reshaped()};
  for (const std::vector<bool>& nodes : contact->nodes_in_contact()) {
    for (const bool in_contact : nodes) parts.push_back(VectorXd::Constant(1, in_contact ? 1.0 : 0.0));
  }
  const Index size = std::accumulate(parts.begin(), parts.end(), Index{0},
                                     [](Index sum, const VectorXd& part) { return sum + part.size(); });
  VectorXd all(size);
  Index begin = 0;
  for (const VectorXd& part : parts) {
    all.segment(begin, part.size()) = part;
    begin += part.size();
  }
  return all;
}

}  // namespace

BOOST_AUTO_TEST_CASE(results_come_in_order) {
  for (const int threads : {1, 2, 3}) {
    use_threads(threads);
    for (const Index count : {Index{0}, Index{1}, Index{8}, 2 * batch_size + 7}) {
      Index next = 0;
      const auto twice = [](Index i) { return 2 * i; };
      const auto check = [&](Index i, Index made) {
        BOOST_TEST(i == next++);
        BOOST_TEST(made == 2 * i);
      };
      in_order(count, twice, check);
      BOOST_TEST(next == count);
      next = 0;
      in_batches(count, twice, check);
      BOOST_TEST(next == count);
    }
  }
}

BOOST_AUTO_TEST_CASE(results_are_used_on_the_calling_thread) {
  use_threads(3);
  const std::thread::id caller = std::this_thread::get_id();
  in_order(
      1000, [](Index i) { return i; },
      [&](Index /*i*/, Index /*made*/) { BOOST_TEST((std::this_thread::get_id() == caller)); });
}

BOOST_AUTO_TEST_CASE(each_thread_has_a_workspace_of_its_own) {
  for (const int threads : {1, 2}) {
    use_threads(threads);
    IndexedVector<Index> found(1000);
    in_parallel_with(std::vector<Index>(2, 7), 1000, [&](Index i, std::vector<Index>& workspace) {
      workspace[0] = i;
      std::this_thread::yield();
      found[i] = workspace[0] + workspace[1];
      workspace[0] = 7;
    });
    for (Index i = 0; i < found.count(); ++i) BOOST_TEST(found[i] == i + 7);
  }
}

BOOST_AUTO_TEST_CASE(results_that_are_filled_come_in_order_in_the_memory_of_others) {
  for (const int threads : {1, 2, 3}) {
    use_threads(threads);
    Index next = 0;
    std::set<const Index*> places;
    in_order_with(
        Index{7}, std::vector<Index>(2, 1), 10000,
        [](Index i, std::vector<Index>& result, Index& workspace) {
          workspace = i;
          std::this_thread::yield();
          result.assign(2, workspace);
        },
        [&](Index i, const std::vector<Index>& result) {
          BOOST_TEST(i == next++);
          BOOST_TEST((result == std::vector<Index>{i, i}));
          places.insert(result.data());
        });
    BOOST_TEST(next == 10000);
    BOOST_TEST(number_of(places) <= 256 * threads);  // four groups of 64 for each thread
  }
}

BOOST_AUTO_TEST_CASE(an_exception_reaches_the_caller) {
  use_threads(2);
  const auto fail = [](Index i) {
    if (i == 5) throw std::runtime_error("five");
    return i;
  };
  const auto pass = [](Index i) { return i; };
  BOOST_CHECK_THROW(in_parallel(10, fail), std::runtime_error);
  BOOST_CHECK_THROW(in_parallel_with(0, 10, [&](Index i, int& /*workspace*/) { fail(i); }), std::runtime_error);
  BOOST_CHECK_THROW(in_order(1000, fail, [](Index, Index) {}), std::runtime_error);
  BOOST_CHECK_THROW(in_order(1000, pass, [&](Index i, Index) { fail(i); }), std::runtime_error);
}

BOOST_AUTO_TEST_CASE(any_number_of_threads_gives_the_same_bits) {
  for (const Integration integration : {Integration::gauss, Integration::segments}) {
    std::mt19937 random(1);
    Settings settings;
    settings.integration = integration;
    Scene scene(facing_grids(FacetType::quad4, FacetType::tri3, 0.02, 6, 5), effects_of(true, 2), settings);
    scene.disturb(0.02, random);
    const VectorXd one = answers(scene, 1);
    BOOST_TEST(one.norm() > 0);
    for (const int threads : {2, 3}) BOOST_TEST((answers(scene, threads) == one));
  }
}
