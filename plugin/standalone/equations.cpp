#include "equations.h"

#include "error.h"

#include <algorithm>

namespace standalone {
namespace {

// What stands in place of a number until it is given.
constexpr int is_free = -2;
constexpr int is_prescribed = -3;

void check_rigid(const Model& model, const Eigen::MatrixXi& number) {
  for (const Element& element : model.mesh.elements) {
    for (const int node : element.nodes) {
      if (!model.material(element).rigid || (number.col(node).head<3>().array() == is_prescribed).all()) continue;
      throw InputError(
          model.file + ": the rigid body \"" + model.material(element).name +
          "\" is free to move; all its translations must be given in <Rigid>, free rigid bodies are not supported");
    }
  }
}

}  // namespace

Equations::Equations(const Model& model, const std::vector<Unknown>& others) {
  int rows = model.dofs();
  for (const auto& [row, node] : others) rows = std::max(rows, row + 1);
  number_.setConstant(rows, model.mesh.nodes.cols(), absent);
  for (const auto& [row, node] : others) number_(row, node) = is_free;
  for (const Element& element : model.mesh.elements) {
    const Material& material = model.material(element);
    for (const int node : element.nodes) {
      for (int f = 0; f < material.fields(); ++f) number_(material.dof(f), node) = is_free;
    }
  }
  for (const Condition& condition : model.prescribed) {
    for (const int node : condition.nodes) {
      int& number = number_(condition.dof, node);
      if (number != absent) number = is_prescribed;
    }
  }
  check_rigid(model, number_);
  take_numbers(is_free);
  free_ = size();
  take_numbers(is_prescribed);
  if (free_ == 0) throw InputError(model.file + ": nothing is free, so there is nothing to solve");
}

void Equations::take_numbers(int status) {
  for (int node = 0; node < number_.cols(); ++node) {
    for (int dof = 0; dof < number_.rows(); ++dof) {
      if (number_(dof, node) != status) continue;
      number_(dof, node) = size();
      unknowns_.emplace_back(dof, node);
    }
  }
}

std::vector<int> Equations::of_element(const Element& element, const Material& material) const {
  std::vector<int> numbers;
  for (int f = 0; f < material.fields() && !material.rigid; ++f) {
    for (const int node : element.nodes) numbers.push_back(number(material.dof(f), node));
  }
  return numbers;
}

}  // namespace standalone
