/// Small models for tests: columns of hexahedra along z.
#pragma once

#include "standalone/model.h"

#include <random>

namespace test {

using namespace standalone;

inline Material gel(int fields) {
  Material material;
  material.name = "gel";
  material.modulus = 1.2;
  material.poisson = 0.3;
  material.porous = fields > 3;
  material.solid_fraction = 0.2;
  material.permeability = 1e-3;
  material.osmotic = 0.9;
  if (fields > 4) material.solute = Solute{0, 4e-4, 1e-3, 0.7};
  return material;
}

/// Nodes of a column of unit cross-section from z = 0 to `height`, `count` elements high. Node 4 k + c is corner c at
/// level k.
inline Model column(int fields, int count, double height) {
  Model model;
  model.control.module = "solute";
  model.control.step_size = model.control.end = 1;
  model.gas_constant = 8.314e-6;
  model.temperature = 298;
  if (fields > 4) model.solutes = {"s1"};
  model.materials.push_back(gel(fields));
  model.mesh.nodes.resize(3, 4 * (count + 1));
  for (int k = 0; k <= count; ++k) {
    const double z = height * k / count;
    model.mesh.nodes.middleCols<4>(4 * k) << 0, 1, 1, 0, 0, 0, 1, 1, z, z, z, z;
  }
  for (int k = 0; k < count; ++k) {
    Element element{k + 1, 0, {}};
    for (int a = 0; a < 8; ++a) element.nodes.push_back(4 * k + a);
    model.mesh.elements.push_back(element);
  }
  return model;
}

/// Prescribes a value of a degree of freedom at some nodes.
inline void hold(Model& model, int dof, std::vector<int> nodes, double value) {
  model.prescribed.push_back({dof, std::move(nodes), {value, -1}});
}

inline std::vector<int> level(int k) { return {4 * k, 4 * k + 1, 4 * k + 2, 4 * k + 3}; }

/// Prescribes zero displacements across the column, and along it at its lower end.
inline void confine(Model& model) {
  std::vector<int> all;
  for (int node = 0; node < model.mesh.nodes.cols(); ++node) all.push_back(node);
  hold(model, 0, all, 0);
  hold(model, 1, all, 0);
  hold(model, 2, level(0), 0);
}

/// Random nodal values: small displacements, pressures and positive concentrations.
inline MatrixXd random_values(const Model& model, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  MatrixXd values(model.dofs(), model.mesh.nodes.cols());
  for (double& value : values.topRows(3).reshaped()) value = 0.1 * unit(random);
  for (double& value : values.bottomRows(values.rows() - 3).reshaped()) value = 1 + 0.5 * unit(random);
  return values;
}

}  // namespace test
