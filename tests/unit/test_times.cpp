#include "contact/times.h"

#include "surfaces.h"

#include <boost/test/unit_test.hpp>

#include <thread>

using namespace test;

namespace {

void wait() { std::this_thread::sleep_for(std::chrono::milliseconds(2)); }

}  // namespace

BOOST_AUTO_TEST_CASE(a_clock_within_another_of_the_same_task_counts_once) {
  Spent spent;
  const Stopwatch watch;
  {
    const TaskClock outer(spent);
    wait();
    {
      const TaskClock inner(spent);
      wait();
    }
  }
  BOOST_TEST(spent.total() >= 4e-3);
  BOOST_TEST(spent.total() <= watch.peek());
}

BOOST_AUTO_TEST_CASE(what_the_host_does_is_not_shared) {
  Spent spent;
  const Stopwatch watch;
  {
    TaskClock clock(spent);
    clock.in_host(wait);
  }
  BOOST_TEST(spent.host >= 2e-3);
  BOOST_TEST(spent.shared >= 0);
  BOOST_TEST(spent.total() <= watch.peek());
}

BOOST_AUTO_TEST_CASE(every_task_of_a_contact_is_timed) {
  const Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, 0.05, 2, 3), effects_of(true, 1),
                    explicit_settings(3, 2, 5));
  const auto contact = scene.contact();  // projects
  contact->begin_iteration(scene.fields);
  contact->residual(scene.fields, 1, [](const auto&...) { wait(); });
  contact->augment(scene.fields);
  contact->balance(scene.fields);
  for (const Task task : all_tasks) BOOST_TEST(contact->times()[task].total() > 0);
  BOOST_TEST(contact->times()[Task::residual].host >= 2e-3);
  BOOST_TEST(contact->times().sum().total() >= contact->times()[Task::residual].total());
}
