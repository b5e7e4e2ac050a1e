/// The equations of the unknowns of a contact's nodes at the time of construction. FEBio renumbers equations between
/// steps, and ambient values remove unknowns within one.
#pragma once

#include "dof_map.h"
#include "linear_constraints.h"
#include "solver/border.h"

#include <array>
#include <functional>
#include <vector>

class NodeEquations {
 public:
  using Side = mixture_contact::Side;
  using Location = mixture_contact::ContactInterface::Location;

  /// Fills in the equations of the multipliers of a patch, those of a node, at their entries of its layout.
  using FillMultipliers = std::function<void(const mixture_contact::Patch& patch, int node, std::vector<int>& ids)>;

  /// Keeps references.
  NodeEquations(const DofMap& dofs, ContactSurfaces& surfaces, const mixture_contact::Effects& effects,
                FillMultipliers fill_multipliers);
  NodeEquations(const DofMap& dofs, ContactSurfaces& surfaces, const mixture_contact::ContactInterface& core);

  /// The nodes of the mesh whose blocks make up a local vector.
  std::vector<int> nodes(const Location& at) const;
  /// The equation of each entry of a local vector; -1 where it has none.
  std::vector<int> equations(const Location& at) const;
  /// Equations in one block of the matrix, those of prescribed values and of rigid bodies' rotations, too.
  std::vector<int> coupled(const Location& at) const;
  /// A local vector at its equations; a component of a displacement that follows others goes to theirs.
  std::vector<newton::Condition::Entry> entries(const Location& at, const mixture_contact::VectorXd& values) const;
  /// The equations of all degrees of freedom of a node that have one of their own, exchanged or not.
  std::vector<int> unknowns(Side surface, int node) const;
  /// The displacements of nodes of the surfaces by an increment [mm]; zero where they have no equations of their own.
  mixture_contact::PerSide<mixture_contact::Matrix3Xd> displacements(const std::vector<double>& increment) const;
  /// Whether some nodes belong to rigid bodies, from which they have their equations.
  bool are_rigid(const Location& at) const;
  /// Whether the n-th node of a local vector does.
  bool is_rigid(const Location& at, mixture_contact::Index n) const;
  /// The nodes that belong to rigid bodies.
  mixture_contact::PerSide<mixture_contact::NodeFlags> rigid() const;

 private:
  /// Equations of the nodes of one surface.
  struct Surface {
    FEMixtureSurface* febio = nullptr;
    mixture_contact::IndexedVector<int> body;  ///< the rigid one that each node belongs to; negative for none
    Eigen::MatrixXi equations;                 ///< shape (displacements and fields, nodes)

    bool is_rigid(int node) const { return body[node] >= 0; }
    int mesh_node(int node) const { return febio->NodeIndex(node); }
    int displacement(int node, mixture_contact::Index i) const { return equations(i, node); }
    int field(int node, int field) const { return equations(displacements + field, node); }

    static constexpr int displacements = 3;
  };
  Surface of_surface(FEMixtureSurface& surface, Side side) const;
  /// Calls use(surface, node) for the nodes of a local vector in their order.
  template <class Use>
  void for_each_node(const Location& at, const Use& use) const;
  /// Adds the displacements that determine those of these nodes by linear constraints.
  void add_followed(const Location& at, std::vector<int>& ids) const;
  /// The change of a displacement by an increment.
  double change(const Surface& surface, int node, int i, const std::vector<double>& increment) const;

  const DofMap& dofs_;
  LinearConstraints constraints_;
  const mixture_contact::Effects& effects_;
  FillMultipliers fill_multipliers_;
  mixture_contact::PerSide<Surface> of_;
};
