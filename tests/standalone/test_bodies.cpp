#include "standalone/bodies.h"

#include "small_models.h"

#include <boost/test/unit_test.hpp>

using namespace test;

namespace {

constexpr double dt = 0.25;

/// A model of one distorted hexahedron with 8 or 20 nodes.
Model twisted(int fields, int nodes, std::mt19937& random) {
  Model model = column(fields, 1, 1);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (double& x : model.mesh.nodes.reshaped()) x += 0.1 * unit(random);
  if (nodes == 8) return model;
  constexpr int edges[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  model.mesh.nodes.conservativeResize(3, 20);
  for (int k = 0; k < 12; ++k) {
    model.mesh.nodes.col(8 + k) = (model.mesh.nodes.col(edges[k][0]) + model.mesh.nodes.col(edges[k][1])) / 2;
    for (int i = 0; i < 3; ++i) model.mesh.nodes(i, 8 + k) += 0.03 * unit(random);
    model.mesh.elements[0].nodes.push_back(8 + k);
  }
  return model;
}

/// Largest difference between the tangent and central differences of the residual, relative to the largest entry of its
/// column.
double tangent_error(const Model& model, const Bodies& bodies, const MatrixXd& values) {
  const MatrixXd tangent = bodies.tangent(0, values, dt);
  const int nodes = static_cast<int>(model.mesh.nodes.cols());
  double worst = 0;
  for (int column = 0; column < tangent.cols(); ++column) {
    const int dof = model.materials[0].dof(column / nodes);
    const double h = 1e-5;
    MatrixXd up = values;
    MatrixXd down = values;
    up(dof, column % nodes) += h;
    down(dof, column % nodes) -= h;
    const VectorXd slope = (bodies.residual(0, up, dt) - bodies.residual(0, down, dt)) / (2 * h);
    worst = std::max(
        worst, (slope - tangent.col(column)).lpNorm<Eigen::Infinity>() / tangent.col(column).lpNorm<Eigen::Infinity>());
  }
  return worst;
}

}  // namespace

BOOST_AUTO_TEST_CASE(tangents_are_the_derivatives_of_residuals) {
  std::mt19937 random(4);
  for (const int fields : {3, 4, 5}) {
    for (const int nodes : {8, 20}) {
      const Model model = twisted(fields, nodes, random);
      Bodies bodies(model);
      bodies.accept_step(0.5 * random_values(model, random));
      BOOST_TEST(tangent_error(model, bodies, random_values(model, random)) < 1e-7);
    }
  }
}

BOOST_AUTO_TEST_CASE(patch_test_linear_fields_are_in_equilibrium) {
  // A cube of eight distorted elements has one free node inside. Constant stress and fluxes cause no force on this
  // node.
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  Model model = column(4, 1, 1);
  model.mesh = {};
  model.mesh.nodes.resize(3, 27);
  for (int n = 0; n < 27; ++n) model.mesh.nodes.col(n) = Vector3d(n % 3, n / 3 % 3, n / 9) / 2;
  for (int i = 0; i < 3; ++i) model.mesh.nodes(i, 13) += 0.1 * unit(random);
  for (int e = 0; e < 8; ++e) {
    const int n = e % 2 + 3 * (e / 2 % 2) + 9 * (e / 4);
    model.mesh.elements.push_back({e + 1, 0, {n, n + 1, n + 4, n + 3, n + 9, n + 10, n + 13, n + 12}});
  }
  const Matrix3d gradient = 0.2 * Matrix3d::Random();
  MatrixXd values(4, 27);
  values.topRows(3) = gradient * model.mesh.nodes;
  values.row(3) = Eigen::RowVector3d(1, -2, 3) * model.mesh.nodes;
  Bodies bodies(model);
  bodies.accept_step(values);
  MatrixXd forces = MatrixXd::Zero(4, 27);
  for (std::size_t e = 0; e < bodies.elements(); ++e) {
    const VectorXd local = bodies.residual(e, values, dt);
    for (int k = 0; k < 32; ++k) forces(k / 8, bodies.element(e).nodes[static_cast<std::size_t>(k % 8)]) += local[k];
  }
  BOOST_TEST(forces.rowwise().sum().norm() < 1e-15 + 1e-13 * forces.norm());  // forces are in equilibrium
  BOOST_TEST(std::abs(forces(3, 13)) < 1e-14 * forces.row(3).norm());
  // The pressure p varies, so that only the solid's part of the stress is constant. The force is the gradient of p
  // integrated over the volume of the node.
  values.row(3).setConstant(0.7);
  forces.setZero();
  for (std::size_t e = 0; e < bodies.elements(); ++e) {
    const VectorXd local = bodies.residual(e, values, dt);
    for (int k = 0; k < 32; ++k) forces(k / 8, bodies.element(e).nodes[static_cast<std::size_t>(k % 8)]) += local[k];
  }
  BOOST_TEST(forces.col(13).norm() < 1e-13 * forces.norm());
}

BOOST_AUTO_TEST_CASE(storage_terms_count_what_enters) {
  std::mt19937 random(6);
  const Model model = twisted(5, 8, random);
  Bodies bodies(model);
  MatrixXd values = MatrixXd::Zero(5, 8);
  values.row(4).setConstant(0.5);
  bodies.accept_step(values);
  values.row(4).setConstant(1.5);
  const VectorXd residual = bodies.residual(0, values, dt);
  const double gained = 0.8 * model.materials[0].solute->solubility * 1.0 * bodies.volume(0);
  BOOST_TEST(residual.tail(8).sum() == -gained, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(std::abs(residual.segment(24, 8).sum()) < 1e-15);
  values.topRows(3) = 0.1 * model.mesh.nodes;
  const double grown = (std::pow(1.1, 3) - 1) * bodies.volume(0);
  BOOST_TEST(bodies.residual(0, values, dt).segment(24, 8).sum() == -grown, boost::test_tools::tolerance(1e-12));
}
