#include "contact/base/timings.h"

#include "surfaces.h"

#include <boost/test/unit_test.hpp>

#include <thread>

using namespace test;

namespace {

void wait() { std::this_thread::sleep_for(std::chrono::milliseconds(2)); }

}  // namespace

BOOST_AUTO_TEST_CASE(a_clock_within_another_of_the_same_task_counts_once) {
  TimingBreakdown spent;
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

BOOST_AUTO_TEST_CASE(what_the_host_does_for_an_effect_is_charged_to_it) {
  TimingBreakdown spent(2);
  const Stopwatch watch;
  {
    TaskClock clock(spent);
    clock.in_host(Patch{{0}, {0}, {1}}, wait);
    clock.in_host(Patch{{0}, {0}, {}}, wait);
    clock.in_host(wait);
  }
  for (const double seconds : {spent.fields[1], spent.traction, spent.shared}) BOOST_TEST(seconds >= 2e-3);
  BOOST_TEST(spent.fields[0] == 0);
  BOOST_TEST(spent.host >= 6e-3);
  BOOST_TEST(spent.total() <= watch.peek());
}

BOOST_AUTO_TEST_CASE(what_threads_charge_is_taken_over_once) {
  EffectTimings times(1);
  {
    ScopedTimer laps(times, 1);
    laps.shared();
    wait();
    laps.field(0);
  }
  TimingBreakdown spent(1);
  TaskClock(spent).take(times, 2);
  BOOST_TEST(spent.fields[0] >= 1e-3);
  BOOST_TEST(spent.traction == 0);
  BOOST_TEST(times.take().total() == 0);
}

BOOST_AUTO_TEST_CASE(of_many_pairs_some_stand_for_the_others) {
  for (const Index count : {1, 255, 256, 1000, 100000}) {
    Index all = 0;
    Index timed = 0;
    Index most = 0;
    for (Index number = 0; number < count; ++number) {
      const Index each = stands_for(number, count);
      all += each;
      timed += each > 0 ? 1 : 0;
      most = std::max(most, each);
    }
    BOOST_TEST(all >= count);
    BOOST_TEST(all < count + most);
    BOOST_TEST(timed <= 256);
    BOOST_TEST((timed == count || timed >= 128));
  }
}

BOOST_AUTO_TEST_CASE(the_time_of_one_that_stands_for_others_counts_for_each) {
  const auto charged = [](Index stands_for) {
    EffectTimings times(0);
    {
      ScopedTimer laps(times, 0, stands_for);
      wait();
      laps.traction();
    }
    return times.take().traction;
  };
  BOOST_TEST(charged(0) == 0);
  BOOST_TEST(charged(3) >= 6e-3);
}

BOOST_AUTO_TEST_CASE(every_task_of_a_contact_is_timed) {
  const Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, 0.05, 2, 3), effects_of(true, 1),
                    explicit_settings(3, 2, 5));
  const auto contact = scene.contact();  // projects
  contact->begin_iteration(scene.fields);
  contact->residual(scene.fields, 1, [](const auto&...) { wait(); });
  contact->augment(scene.fields);
  output(*contact, scene.fields).balance;
  for (const Task task : all_tasks) BOOST_TEST(contact->measurements().timings[task].total() > 0);
  BOOST_TEST(contact->measurements().timings[Task::residual].host >= 2e-3);
  const TimingBreakdown& stiffness = contact->measurements().timings[Task::stiffness];
  for (const double seconds : {stiffness.shared, stiffness.traction, stiffness.fields[0], stiffness.fields[1]})
    BOOST_TEST(seconds > 0);
  BOOST_TEST(contact->measurements().timings.sum().total() >= contact->measurements().timings[Task::residual].total());
}
