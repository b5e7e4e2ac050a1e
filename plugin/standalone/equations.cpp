#include "equations.h"

#include "error.h"

#include <algorithm>

namespace standalone {

Equations::Equations(const Model& model, const std::vector<Unknown>& others) {
  enum Status { free, prescribed };
  int rows = model.dofs();
  for (const auto& [row, node] : others) rows = std::max(rows, row + 1);
  number_.setConstant(rows, model.mesh.nodes.cols(), absent);
  for (const auto& [row, node] : others) number_(row, node) = free;
  for (const Element& element : model.mesh.elements) {
    const Material& material = model.material(element);
    for (const int node : element.nodes) {
      for (int f = 0; f < material.fields(); ++f) number_(material.dof(f), node) = free;
    }
  }
  for (const Condition& condition : model.prescribed) {
    for (const int node : condition.nodes) {
      int& number = number_(condition.dof, node);
      if (number != absent) number = prescribed;
    }
  }
  for (const Element& element : model.mesh.elements) {
    for (const int node : element.nodes) {
      if (!model.material(element).rigid || (number_.col(node).head<3>().array() == prescribed).all()) continue;
      throw InputError(
          model.file + ": the rigid body \"" + model.material(element).name +
          "\" is free to move; all its translations must be given in <Rigid>, free rigid bodies are not supported");
    }
  }
  const Eigen::MatrixXi status = number_;
  for (const Status wanted : {free, prescribed}) {
    for (int node = 0; node < status.cols(); ++node) {
      for (int dof = 0; dof < status.rows(); ++dof) {
        if (status(dof, node) != wanted) continue;
        number_(dof, node) = size();
        unknowns_.emplace_back(dof, node);
      }
    }
    if (wanted == free) free_ = size();
  }
  if (free_ == 0) throw InputError(model.file + ": nothing is free, so there is nothing to solve");
}

std::vector<int> Equations::of_element(const Element& element, const Material& material) const {
  std::vector<int> numbers;
  for (int f = 0; f < material.fields() && !material.rigid; ++f) {
    for (const int node : element.nodes) numbers.push_back(number(material.dof(f), node));
  }
  return numbers;
}

}  // namespace standalone
