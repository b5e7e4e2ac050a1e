/// The unknowns of a model: which degree of freedom exists, which is prescribed, and which equation it has.
#pragma once

#include "model.h"

namespace standalone {

/// Equation numbers of the degrees of freedom that exist and are not prescribed.
class Equations {
 public:
  /// An unknown beside the fields: its row of nodal values, from Model::dofs() on, and its node.
  using Unknown = std::pair<int, int>;

  /// Throws InputError where a rigid body is not held, or nothing is free. Conditions where no element has the field
  /// are void.
  Equations(const Model& model, const std::vector<Unknown>& others);

  int rows() const { return static_cast<int>(number_.rows()); }  ///< of nodal values

  int count() const { return static_cast<int>(dof_.size()); }
  /// Equation of a degree of freedom; `prescribed` or `absent` if it has none.
  int number(int dof, int node) const { return number_(dof, node); }
  int dof(int equation) const { return dof_[static_cast<std::size_t>(equation)]; }
  int node(int equation) const { return node_[static_cast<std::size_t>(equation)]; }

  /// Equations of the fields of an element, field by field as in Bodies.
  std::vector<int> of_element(const Element& element, const Material& material) const;

  static constexpr int prescribed = -1;
  static constexpr int absent = -2;

 private:
  Eigen::MatrixXi number_;  ///< shape (rows, nodes)
  std::vector<int> dof_, node_;
};

}  // namespace standalone
