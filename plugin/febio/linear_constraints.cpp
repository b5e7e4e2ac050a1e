#include "linear_constraints.h"

#include "contact/base/indexed_vector.h"

#include <FECore/FELinearConstraintManager.h>
#include <FECore/FEMesh.h>
#include <FECore/FEModel.h>

using mixture_contact::at;

LinearConstraints::LinearConstraints(FEModel& model) {
  const FELinearConstraintManager& all = model.GetLinearConstraintManager();
  FEMesh& mesh = model.GetMesh();
  for (int i = 0; i < all.LinearConstraints(); ++i) {
    const FELinearConstraint& constraint = all.LinearConstraint(i);
    if (!constraint.IsActive()) continue;
    std::vector<Followed>& followed = followed_[{constraint.GetParentNode(), constraint.GetParentDof()}];
    for (int n = 0; n < static_cast<int>(constraint.Size()); ++n) {
      const FELinearConstraintDOF& child = constraint.GetChildDof(n);
      followed.push_back({at(mesh.Node(child.node).m_ID, child.dof), child.val});
    }
  }
}

bool LinearConstraints::bind(int node) const {
  const auto first = followed_.lower_bound({node, -1});
  return first != followed_.end() && first->first.first == node;
}

const std::vector<LinearConstraints::Followed>* LinearConstraints::of(int node, int dof) const {
  const auto found = followed_.find({node, dof});
  return found == followed_.end() ? nullptr : &found->second;
}

bool has_linear_constraints(FEModel& model) { return model.GetLinearConstraintManager().LinearConstraints() > 0; }
