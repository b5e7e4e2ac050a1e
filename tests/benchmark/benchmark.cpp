/// Times of the contact core per Newton iteration, for several numbers of threads, of facets (both integrations) and of
/// effects.
#include "surfaces.h"

#ifdef _OPENMP
#include <omp.h>
#endif

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

namespace {

using namespace test;

/// Times of the parts of a Newton iteration [s].
struct Times {
  double search = 0;
  double status = 0;
  double profile = 0;
  double stiffness = 0;
  double residual = 0;

  double total() const { return search + status + profile + stiffness + residual; }
};

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// The time that a call takes [s].
template <class Call>
double timed(const Call& call) {
  const double start = seconds();
  call();
  return seconds() - start;
}

/// A contact of two non-matching squares in full contact, which move a little before each iteration.
class Case {
 public:
  Case(std::string name, int facets, const Effects& effects, Integration integration = Integration::gauss)
      : name_(std::move(name)), scene_(grids(facets), effects) {
    scene_.settings.integration = integration;
    if (effects.friction_kind != FrictionKind::none) scene_.settings.friction.coefficient = 0.3;
    std::mt19937 random(1);
    const double size = 1 / std::sqrt(facets);
    scene_.disturb(0.05 * size, random);
    contact_ = scene_.contact();
    contact_->begin_iteration(scene_.fields);
    step_ = 1e-6 * size;
  }

  const std::string& name() const { return name_; }
  std::size_t facets() const { return scene_.mesh[Side::primary].facets.size(); }
  const std::vector<Times>& times() const { return times_; }

  /// Performs one Newton iteration as a host does: trial, status, profile, tangent.
  void iterate() {
    move();
    Times times;
    double sum = 0;
    times.search = timed([&] { contact_->project(scene_.position()); });
    times.residual = timed(
        [&] { contact_->residual(scene_.fields, 1, [&](const auto&, const VectorXd& r) { sum += r[0]; }); });
    times.status = timed([&] { contact_->begin_iteration(scene_.fields); });
    times.profile = timed(
        [&] { contact_->for_each_coupling([&](const auto& at) { sum += 1.0 * at.patch.primary.front(); }); });
    times.stiffness = timed([&] {
      contact_->tangent(scene_.fields, 1, [&](const auto&, const auto&, const MatrixXd& k) { sum += k(0, 0); });
    });
    if (!std::isfinite(sum)) throw std::runtime_error(name_ + ": not a number");
    times_.push_back(times);
  }

 private:
  static PerSide<Grid> grids(int facets) {
    const int cells = static_cast<int>(std::lround(std::sqrt(facets)));
    return facing_grids(FacetType::quad4, FacetType::quad4, 0.1 / cells, cells, std::max(1, 3 * cells / 4));
  }

  /// Moves the surface, if it can move, and changes the fields.
  void move() {
    if (scene_.effects.traction) scene_.fields[Side::primary].position.row(0).array() += step_;
    scene_.fields[Side::primary].scalar.array() += step_;
  }

  std::string name_;
  Scene scene_;
  std::unique_ptr<ContactInterface> contact_;
  double step_ = 0;
  std::vector<Times> times_;
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double median(const std::vector<Times>& all, double Times::* part) {
  std::vector<double> values;
  for (const Times& times : all) values.push_back(times.*part);
  return median(values);
}

/// Prints one line of JSON: medians over the iterations [s].
void print(const Case& measured, int threads) {
  const auto& all = measured.times();
  std::vector<double> totals;
  for (const Times& times : all) totals.push_back(times.total());
  std::cout << "{\"case\": \"" << measured.name() << "\", \"facets\": " << measured.facets()
            << ", \"threads\": " << threads << ", \"iterations\": " << all.size()
            << ", \"search\": " << median(all, &Times::search) << ", \"status\": " << median(all, &Times::status)
            << ", \"profile\": " << median(all, &Times::profile)
            << ", \"stiffness\": " << median(all, &Times::stiffness)
            << ", \"residual\": " << median(all, &Times::residual) << ", \"total\": " << median(totals) << "}\n"
            << std::flush;
}

void use_threads([[maybe_unused]] int threads) {
#ifdef _OPENMP
  omp_set_num_threads(threads);
#endif
}

int threads_in_use() {
#ifdef _OPENMP
  return omp_get_max_threads();
#else
  return 1;
#endif
}

/// Measures the iterations of all cases in turn, such that other load on the machine affects all cases alike.
void measure_in_turn(std::vector<Case>& cases, int iterations) {
  for (int i = 0; i < iterations; ++i) {
    for (Case& one : cases) one.iterate();
  }
  for (const Case& one : cases) print(one, threads_in_use());
}

Effects with_friction(Effects effects) {
  effects.friction_kind = effects.solvent ? FrictionKind::on_solid_part : FrictionKind::on_traction;
  return effects;
}

void effects(int facets, int iterations) {
  std::vector<Case> cases;
  for (const bool solvent : {false, true}) {
    const Effects smooth = effects_of(solvent, 0);
    const std::string name = solvent ? "solid, solvent" : "solid";
    cases.emplace_back(name, facets, smooth);
    cases.emplace_back(name + ", friction", facets, with_friction(smooth));
  }
  for (const int solutes : {1, 2, 4}) {
    cases.emplace_back("solid, solvent, solutes " + std::to_string(solutes), facets, effects_of(true, solutes));
  }
  for (const int solutes : {1, 2, 4}) {
    Effects transport = effects_of(true, solutes);
    transport.traction = false;
    cases.emplace_back("fixed geometry, solvent, solutes " + std::to_string(solutes), facets, transport);
  }
  measure_in_turn(cases, iterations);
}

void sizes(int most, int iterations) {
  for (int facets = 1000; facets <= most; facets *= 10) {
    std::vector<Case> cases;
    cases.emplace_back("solid, solvent, solutes 1, Gauss points", facets, effects_of(true, 1));
    cases.emplace_back("solid, solvent, solutes 1, segments", facets, effects_of(true, 1), Integration::segments);
    measure_in_turn(cases, iterations);
  }
}

void threads(int facets, int iterations) {
  Case one("one thread", facets, effects_of(true, 1));
  Case two("two threads", facets, effects_of(true, 1));
  std::vector<double> ratios;
  for (int i = 0; i < iterations; ++i) {
    use_threads(1);
    one.iterate();
    use_threads(2);
    two.iterate();
    ratios.push_back(one.times().back().total() / two.times().back().total());
  }
  print(one, 1);
  print(two, 2);
  std::cout << "{\"case\": \"speed-up of pairs of iterations\", \"median\": " << median(ratios)
            << ", \"best\": " << *std::max_element(ratios.begin(), ratios.end()) << "}\n";
}

}  // namespace

int main(int count, char** arguments) {
  const std::string what = count > 1 ? arguments[1] : "";
  const int facets = count > 2 ? std::atoi(arguments[2]) : 10000;
  const int iterations = count > 3 ? std::atoi(arguments[3]) : 7;
  if (facets >= 4 && iterations >= 1) {
    if (what == "effects") return effects(facets, iterations), 0;
    if (what == "facets") return sizes(facets, iterations), 0;
    if (what == "threads") return threads(facets, iterations), 0;
  }
  std::cerr << "usage: contact-benchmark effects|facets|threads [facets, at least 4: 10000] [iterations: 7]\n"
               "Prints one line of JSON per case: medians of the seconds per Newton iteration.\n";
  return 1;
}
