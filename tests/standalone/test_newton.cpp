#include "standalone/newton.h"

#include "small_models.h"

#include <boost/test/unit_test.hpp>

using namespace test;

namespace {

/// Number of terms of the Fourier series below.
constexpr int terms = 400;

/// Solves equal steps up to `end`. Returns the final nodal values.
MatrixXd solve(const Model& model, double end, int steps) {
  Log quiet(false);
  Problem problem(model);
  Newton newton(problem, quiet);
  for (int k = 1; k <= steps; ++k) newton.solve_step(end * k / steps, end / steps);
  return problem.values();
}

/// Settlement u(H)/h of a layer after a step load P0 with an impermeable base: (P0/H_A) [1 - 2/pi^2 SUM (n+1/2)^-2
/// exp(-(n+1/2)^2 pi^2 tau)].
double consolidation(double tau) {
  double sum = 0;
  for (int n = 0; n < terms; ++n) sum += std::pow(n + 0.5, -2) * std::exp(-std::pow((n + 0.5) * M_PI, 2) * tau);
  return 1 - 2 / (M_PI * M_PI) * sum;
}

/// Concentration c/c* at height z of a layer of height 1 that is impermeable at z = 1 and has c* at z = 0, at tau = d
/// t/h^2.
double diffusion(double z, double tau) {
  double sum = 0;
  for (int n = 0; n < terms; ++n)
    sum += std::sin((n + 0.5) * M_PI * z) / (n + 0.5) * std::exp(-std::pow((n + 0.5) * M_PI, 2) * tau);
  return 1 - 2 / M_PI * sum;
}

Model consolidation_model(int elements, double load) {
  Model model = column(4, elements, 1);
  model.control.module = "biphasic";
  model.materials[0].poisson = 0;
  confine(model);
  hold(model, pressure_dof, level(elements), 0);
  SurfaceFacet top;
  top.facet.type = mixture_contact::FacetType::quad4;
  const std::vector<int> nodes = level(elements);
  std::copy(nodes.begin(), nodes.end(), top.facet.nodes.begin());
  model.loads.push_back({false, {top}, {load, -1}});
  return model;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_loaded_layer_consolidates_as_mow_and_others_1980_say) {
  const double load = 1e-5;  // small strains
  const int elements = 20;
  const Model model = consolidation_model(elements, load);
  const double modulus = model.materials[0].modulus;
  const double tau = 0.2;
  const double end = tau / (modulus * model.materials[0].permeability);
  const MatrixXd values = solve(model, end, 100);
  BOOST_TEST(values(2, 4 * elements) == -load / modulus * consolidation(tau), boost::test_tools::tolerance(1e-2));
  const double drained = solve(model, 1e4 * end, 5)(2, 4 * elements);
  BOOST_TEST(drained == -load / modulus, boost::test_tools::tolerance(2 * load / modulus));
}

BOOST_AUTO_TEST_CASE(a_solute_diffuses_as_ficks_law_says) {
  const int elements = 20;
  Model model = column(5, elements, 1);
  confine(model);
  hold(model, 2, level(elements), 0);
  model.materials[0].modulus = 1e4;  // keeps the solid in place while the osmotic pressure changes
  model.materials[0].solute->diffusivity = model.materials[0].solute->free_diffusivity;
  hold(model, pressure_dof, level(0), -model.gas_constant * model.temperature * 0.9 * 0.7);
  hold(model, concentration_dof(0), level(0), 1);
  const double tau = 0.15;
  const double end = tau / model.materials[0].solute->diffusivity;
  const MatrixXd values = solve(model, end, 100);
  for (int k = 0; k <= elements; k += 5) {
    BOOST_TEST(std::abs(values(4, 4 * k) - diffusion(1.0 * k / elements, tau)) < 3e-3);
  }
}

BOOST_AUTO_TEST_CASE(newton_converges_quadratically) {
  // Large confined compression of an elastic column in one step.
  Model model = column(3, 4, 1);
  model.control.module = "biphasic";
  confine(model);
  hold(model, 2, level(4), -0.3);
  model.control.displacement_tolerance = 1e-9;
  Log quiet(false);
  Problem problem(model);
  Newton newton(problem, quiet);
  newton.solve_step(1, 1);
  BOOST_TEST(newton.effort().iterations <= 6);
  for (int k = 0; k <= 4; ++k)
    BOOST_TEST(problem.values()(2, 4 * k) == -0.3 * k / 4, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(a_step_that_inverts_elements_fails_and_leaves_the_state_to_be_restored) {
  Model model = column(3, 2, 1);
  confine(model);
  hold(model, 2, level(2), -1.5);
  Log quiet(false);
  Problem problem(model);
  Newton newton(problem, quiet);
  const Problem::State before = problem.save();
  BOOST_CHECK_THROW(newton.solve_step(1, 1), StepFailure);
  problem.restore(before);
  BOOST_TEST((problem.values().array() == 0).all());
}
