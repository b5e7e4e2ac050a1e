/// The degrees of freedom and equations in FEBio of a contact's unknowns.
#pragma once

#include "contact_surfaces.h"

#include <FECore/DumpStream.h>

#include <array>

/// Finds the degrees of freedom at the nodes of the surfaces.
class DofMap {
 public:
  explicit DofMap(ContactSurfaces& surfaces) : surfaces_(surfaces) {}

  ContactSurfaces& surfaces() const { return surfaces_; }
  FEModel& fem() const { return surfaces_.fem(); }

  /// Looks up the degrees of freedom of the module.
  void init();
  /// Assigns equations to unknown multipliers, from this number on.
  void number_multipliers(int first);
  void serialize(DumpStream& ar);

  using Side = mixture_contact::Side;
  const std::array<int, 3>& displacements(Side side) const { return of_face(side).displacements; }
  /// Degree of freedom of the pressure; -1 if the module has none.
  int pressure(Side side) const { return of_face(side).pressure; }
  int concentration(Side side, int solute) const { return of_face(side).concentration + solute; }
  /// Degree of freedom of the pressure at a node, or on the back face of its shell; -1 if the module has none.
  int pressure(bool is_back) const { return (is_back ? back_ : front_).pressure; }
  /// Degree of freedom of a concentration at a node, or on the back face of its shell.
  int concentration(bool is_back, int solute) const { return (is_back ? back_ : front_).concentration + solute; }
  /// The number of solutes in the model.
  int concentrations() const { return concentrations_; }
  /// The degree of freedom of an exchanged field.
  int field(Side side, const mixture_contact::Effects& effects, int field) const;
  /// Equation of the first unknown multiplier; -1 if there is none.
  int first_multiplier() const { return first_multiplier_; }
  /// A node of the surfaces that belongs to no rigid body and, if possible, to no linear constraint; -1 if there is
  /// none.
  int deformable_node() const;
  /// True if a node of the surface has an equation of its own.
  bool has_free_node(Side side) const;
  /// Per node of the surface, true if no solution of the present step can move it.
  mixture_contact::NodeFlags immovable_nodes(Side side) const;
  /// True if a node of the surface belongs to a rigid body that can move.
  bool has_free_rigid_body(Side side) const;

  /// The degrees of freedom on which a force on the node acts.
  const std::array<int, 3>& displacements(Side side, const FENode& node) const;
  /// The degrees of freedom of the rotations of rigid bodies, as their nodes store them.
  const std::array<int, 3>& rotations() const { return rotations_; }
  /// A node of the mesh that represents the block of multipliers in FEBio's assembly (see multiplier_node_).
  int multiplier_node() const { return multiplier_node_; }

 private:
  /// Degrees of freedom at a node: those of its position, or those of the back face of a shell.
  struct FaceDofs {
    std::array<int, 3> displacements{-1, -1, -1};
    int pressure = -1;
    int concentration = -1;  ///< concentration of solute 0; the others follow
  };
  /// True if a node, or its rigid body, has an unknown of motion.
  bool can_move(const FENode& node, const std::array<int, 3>& displacements) const;
  const FaceDofs& of_face(Side side) const { return surfaces_[side].has_shell_bottoms() ? back_ : front_; }
  FaceDofs face_dofs(const std::array<const char*, 3>& displacements, const char* pressure,
                     const char* concentration) const;

  ContactSurfaces& surfaces_;
  FaceDofs front_;
  FaceDofs back_;
  std::array<int, 3> rotations_{-1, -1, -1};
  int concentrations_ = 0;     ///< number of solutes in the model
  int first_multiplier_ = -1;  ///< equation of the first unknown multiplier; the others follow
  /// FEBio assembles equations in blocks that each belong to a node. It would leave a block without a node out of the
  /// coupling with rigid bodies, and treat a block of a rigid node as a force on the rigid body. A deformable node
  /// therefore represents the block of multipliers.
  int multiplier_node_ = -1;
};
