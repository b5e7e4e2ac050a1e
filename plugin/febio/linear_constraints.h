/// Linear constraints of FEBio's models: degrees of freedom without equations of their own, because they depend on
/// others.
#pragma once

#include <map>
#include <utility>
#include <vector>

class FEModel;

class LinearConstraints {
 public:
  /// A degree of freedom that another one follows.
  struct Followed {
    int equation;   ///< its own, or the code of a prescribed value
    double factor;  ///< by which the other one changes with it
  };

  /// Takes the constraints that are active in the present analysis step.
  explicit LinearConstraints(FEModel& model);

  bool empty() const { return followed_.empty(); }
  /// Whether any degree of freedom of a node of the mesh follows others.
  bool bind(int node) const;
  /// The displacements that determine a displacement (dof 0, 1 or 2 of its node in the mesh); null if it is
  /// independent.
  const std::vector<Followed>* of(int node, int dof) const;

 private:
  std::map<std::pair<int, int>, std::vector<Followed>> followed_;  ///< by node and degree of freedom
};

/// Whether a model has any, active or not.
bool has_linear_constraints(FEModel& model);
