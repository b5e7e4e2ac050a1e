/// The equations of a contact's unknowns at the time of construction. FEBio renumbers equations between steps, and
/// ambient values remove unknowns within a step.
#pragma once

#include "dof_map.h"
#include "linear_constraints.h"
#include "solver/border.h"

#include <array>
#include <functional>
#include <vector>

class BoundContact;

/// Looks up equations of local vectors.
class NodeEquations {
 public:
  using Side = mixture_contact::Side;
  using Location = mixture_contact::ContactInterface::Location;

  /// Sets the equations of a node's multipliers at their entries in the layout of a patch.
  using FillMultipliers = std::function<void(const mixture_contact::Patch& patch, int node, std::vector<int>& ids)>;

  /// Keeps a reference. `fill_multipliers`: used for patches with multipliers.
  NodeEquations(const DofMap& dofs, mixture_contact::Effects effects, FillMultipliers fill_multipliers);
  explicit NodeEquations(const BoundContact& contact);

  /// The nodes of the mesh to which the blocks of a local vector belong.
  std::vector<int> nodes(const Location& at) const;
  /// The equation of each entry of a local vector; -1 for entries without an equation.
  std::vector<int> equations(const Location& at) const;
  /// All equations that a block of the matrix couples, including those of prescribed values and of rigid bodies'
  /// rotations.
  std::vector<int> coupled(const Location& at) const;
  /// The entries of a local vector with their equations. A displacement component that depends on others by a linear
  /// constraint is distributed to their equations.
  std::vector<newton::Condition::Entry> entries(const Location& at, const mixture_contact::VectorXd& values) const;
  /// The equations of all degrees of freedom of a node, exchanged or not, that have equations of their own.
  std::vector<int> unknowns(Side surface, int node) const;
  /// The displacements of the surfaces' nodes that follow from an increment of the unknowns [mm]; zero for nodes
  /// without equations of their own.
  mixture_contact::PerSide<mixture_contact::Matrix3Xd> displacements(const std::vector<double>& increment) const;
  /// True if a node of a local vector belongs to a rigid body, which then provides its equations.
  bool are_rigid(const Location& at) const;
  /// True if the n-th node of a local vector belongs to a rigid body.
  bool is_rigid(const Location& at, mixture_contact::Index n) const;

 private:
  /// Equations of the nodes of one surface.
  struct Surface {
    FEMixtureSurface* febio = nullptr;
    Eigen::MatrixXi equations;  ///< shape (displacements and fields, nodes)

    bool is_rigid(int node) const { return febio->Node(node).m_rid >= 0; }
    int mesh_node(int node) const { return febio->NodeIndex(node); }
    int displacement(int node, mixture_contact::Index i) const { return equations(i, node); }
    int field(int node, int field) const { return equations(displacements + field, node); }

    static constexpr int displacements = 3;
  };
  Surface of_surface(FEMixtureSurface& surface, Side side) const;
  /// Calls use(surface, node) for the nodes of a local vector in order.
  template <class Use>
  void for_each_node(const Location& at, const Use& use) const;
  /// Adds the equations of displacements on which these nodes depend by linear constraints.
  void add_followed(const Location& at, std::vector<int>& ids) const;
  /// The change of a displacement component by an increment.
  double change(const Surface& surface, int node, int i, const std::vector<double>& increment) const;

  const DofMap& dofs_;
  LinearConstraints constraints_;
  mixture_contact::Effects effects_;
  FillMultipliers fill_multipliers_;
  mixture_contact::PerSide<Surface> of_;
};
