/// Linear constraints of FEBio's models: degrees of freedom without equations of their own that depend on others.
#pragma once

#include <map>
#include <utility>
#include <vector>

class FEModel;

/// The active linear constraints of a model.
class LinearConstraints {
 public:
  /// A degree of freedom on which a constrained one depends.
  struct Followed {
    int equation;   ///< equation of the degree of freedom, or the code of a prescribed value
    double factor;  ///< derivative of the constrained degree of freedom by this one
  };

  /// Reads the constraints that are active in the present analysis step.
  explicit LinearConstraints(FEModel& model);

  bool empty() const { return followed_.empty(); }
  /// True if a degree of freedom of this node of the mesh depends on others.
  bool bind(int node) const;
  /// The displacements on which a displacement depends (dof 0, 1 or 2 of its node in the mesh); null if it is
  /// independent.
  const std::vector<Followed>* of(int node, int dof) const;

 private:
  /// Keys: node and degree of freedom of the constrained displacement.
  std::map<std::pair<int, int>, std::vector<Followed>> followed_;
};

/// True if the model has linear constraints, active or not.
bool has_linear_constraints(FEModel& model);
