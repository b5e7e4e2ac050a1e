/// The unknowns of a model: which degree of freedom exists, which is prescribed, and which equation it has.
#pragma once

#include "model.h"

namespace standalone {

/// Numbers of the degrees of freedom that exist: first the free ones, whose equations are solved, then the prescribed
/// ones.
class Equations {
 public:
  /// An unknown beside the fields: its row of nodal values, from Model::dofs() on, and its node.
  using Unknown = std::pair<int, int>;

  /// Throws InputError where a rigid body is not held, or nothing is free. Conditions where no element has the field
  /// are void.
  Equations(const Model& model, const std::vector<Unknown>& others);

  int rows() const { return static_cast<int>(number_.rows()); }       ///< of nodal values
  int free() const { return free_; }                                  ///< numbers below are free
  int size() const { return static_cast<int>(unknowns_.size()); }     ///< free and prescribed ones
  int number(int dof, int node) const { return number_(dof, node); }  ///< `absent` where there is none
  int dof(int number) const { return unknowns_[static_cast<std::size_t>(number)].first; }
  int node(int number) const { return unknowns_[static_cast<std::size_t>(number)].second; }

  /// Numbers of the fields of an element, field by field as in Bodies; none for a rigid one.
  std::vector<int> of_element(const Element& element, const Material& material) const;

  static constexpr int absent = -1;

 private:
  /// Gives numbers to what has this status.
  void take_numbers(int status);

  Eigen::MatrixXi number_;  ///< shape (rows, nodes)
  int free_ = 0;
  std::vector<Unknown> unknowns_;  ///< row of nodal values and node, by number
};

}  // namespace standalone
