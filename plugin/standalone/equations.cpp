#include "equations.h"

#include "error.h"

#include <algorithm>

namespace standalone {
namespace {

constexpr int unnumbered = 0;

void check_rigid(const Model& model, const Eigen::MatrixXi& number) {
  for (const Element& element : model.mesh.elements) {
    const Material& material = model.materials[static_cast<std::size_t>(element.material)];
    for (const int node : element.nodes) {
      if (!material.rigid || (number.col(node).head<3>().array() == Equations::prescribed).all()) continue;
      throw InputError(
          model.file + ": the rigid body \"" + material.name +
          "\" is free to move; all its translations must be given in <Rigid>, free rigid bodies are not supported");
    }
  }
}

}  // namespace

Equations::Equations(const Model& model, const std::vector<Unknown>& others) {
  int rows = model.dofs();
  for (const auto& [row, node] : others) rows = std::max(rows, row + 1);
  number_.setConstant(rows, model.mesh.nodes.cols(), absent);
  for (const auto& [row, node] : others) number_(row, node) = unnumbered;
  for (const Element& element : model.mesh.elements) {
    const Material& material = model.materials[static_cast<std::size_t>(element.material)];
    for (const int node : element.nodes) {
      for (int f = 0; f < material.fields(); ++f) number_(material.dof(f), node) = unnumbered;
    }
  }
  for (const Condition& condition : model.prescribed) {
    for (const int node : condition.nodes) {
      int& number = number_(condition.dof, node);
      if (number != absent) number = prescribed;
    }
  }
  check_rigid(model, number_);
  for (int node = 0; node < number_.cols(); ++node) {
    for (int dof = 0; dof < number_.rows(); ++dof) {
      if (number_(dof, node) != unnumbered) continue;
      number_(dof, node) = count();
      dof_.push_back(dof);
      node_.push_back(node);
    }
  }
  if (count() == 0) throw InputError(model.file + ": nothing is free, so there is nothing to solve");
}

std::vector<int> Equations::of_element(const Element& element, const Material& material) const {
  std::vector<int> numbers;
  for (int f = 0; f < material.fields(); ++f) {
    for (const int node : element.nodes) numbers.push_back(number(material.dof(f), node));
  }
  return numbers;
}

}  // namespace standalone
