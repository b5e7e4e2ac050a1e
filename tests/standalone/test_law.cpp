#include "standalone/law.h"

#include "small_models.h"

#include <boost/test/unit_test.hpp>

using namespace test;

namespace {

constexpr double gas_energy = 8.314e-6 * 298;

PointFields<double> random_fields(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  PointFields<double> q;
  for (double& value : q.reshaped()) value = 0.2 * unit(random);
  q.row(0).tail<2>().array() += 1;
  return q;
}

}  // namespace

BOOST_AUTO_TEST_CASE(uniaxial_strain_has_the_closed_form_stress) {
  const Material material = gel(3);
  const double stretch = 1.3;
  PointFields<double> q = PointFields<double>::Zero();
  q(3, 2) = stretch - 1;
  const auto state = deform<double>(material, q);
  const double mu = material.modulus / (2 * (1 + material.poisson));
  const double lambda = 2 * mu * material.poisson / (1 - 2 * material.poisson);
  BOOST_TEST(state.volume_ratio == stretch, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(state.stress(2, 2) == mu * (stretch - 1 / stretch) + lambda * std::log(stretch) / stretch,
             boost::test_tools::tolerance(1e-13));
  BOOST_TEST(state.stress(0, 0) == lambda * std::log(stretch), boost::test_tools::tolerance(1e-13));
}

BOOST_AUTO_TEST_CASE(small_strain_has_the_given_modulus_and_poisson_ratio) {
  const Material material = gel(3);
  const double strain = 1e-7;
  PointFields<double> q = PointFields<double>::Zero();
  q(1, 0) = q(2, 1) = -material.poisson * strain;
  q(3, 2) = strain;
  const auto stress = deform<double>(material, q).stress;
  BOOST_TEST(stress(2, 2) == material.modulus * strain, boost::test_tools::tolerance(1e-6));
  BOOST_TEST(std::abs(stress(0, 0)) < 1e-6 * stress(2, 2));
}

BOOST_AUTO_TEST_CASE(rotations_turn_stress_and_fluxes_and_change_nothing_else) {
  std::mt19937 random(3);
  const Material material = gel(5);
  const auto q = random_fields(random);
  const Matrix3d rotation = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  auto turned = q;
  const Matrix3d gradient = q.block<3, 3>(1, 0).transpose();
  turned.block<3, 3>(1, 0) = (rotation * (gradient + Matrix3d::Identity()) - Matrix3d::Identity()).transpose();
  auto one = deform<double>(material, q);
  auto two = deform<double>(material, turned);
  flow<double>(material, gas_energy, q, one);
  flow<double>(material, gas_energy, turned, two);
  BOOST_TEST((two.stress - rotation * one.stress).norm() < 1e-12);
  BOOST_TEST((two.solvent_flux - rotation * one.solvent_flux).norm() < 1e-15);
  BOOST_TEST((two.solute_flux - rotation * one.solute_flux).norm() < 1e-15);
  BOOST_TEST(two.content == one.content, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(without_deformation_flow_follows_darcy_and_fick) {
  const Material material = gel(5);
  const Solute& solute = *material.solute;
  PointFields<double> q = PointFields<double>::Zero();
  q(0, 4) = 2.0;
  q(1, 3) = 0.5;
  auto state = deform<double>(material, q);
  flow<double>(material, gas_energy, q, state);
  const double hindrance = solute.diffusivity / solute.free_diffusivity;
  const double friction = gas_energy * solute.solubility * 2.0 * (1 - hindrance) / (0.8 * solute.free_diffusivity);
  BOOST_TEST(state.solvent_flux[0] == -0.5 / (1 / material.permeability + friction),
             boost::test_tools::tolerance(1e-13));
  BOOST_TEST(state.solute_flux[0] == solute.solubility * hindrance * 2.0 * state.solvent_flux[0],
             boost::test_tools::tolerance(1e-13));
  BOOST_TEST(state.stress(0, 0) == -gas_energy * material.osmotic * solute.solubility * 2.0,
             boost::test_tools::tolerance(1e-13));
  BOOST_TEST(state.content == 0.8 * solute.solubility * 2.0, boost::test_tools::tolerance(1e-13));
  q(1, 3) = -gas_energy * solute.solubility * hindrance;  // keeps the solvent at rest while the solute diffuses
  q(1, 4) = 1.0;
  flow<double>(material, gas_energy, q, state);
  BOOST_TEST(std::abs(state.solvent_flux[0]) < 1e-18);
  BOOST_TEST(state.solute_flux[0] == -0.8 * solute.solubility * solute.diffusivity,
             boost::test_tools::tolerance(1e-13));
}

BOOST_AUTO_TEST_CASE(an_inverted_point_fails_the_step) {
  PointFields<double> q = PointFields<double>::Zero();
  q(3, 2) = -1.5;
  BOOST_CHECK_THROW(deform<double>(gel(3), q), StepFailure);
}
