/// FEBio's degrees of freedom of a contact's unknowns.
#pragma once

#include "contact_surfaces.h"

#include <FECore/DumpStream.h>

#include <array>

class DofMap {
 public:
  DofMap(FEModel& fem, ContactSurfaces& surfaces) : fem_(fem), surfaces_(surfaces) {}

  /// Finds the degrees of freedom of the module.
  void init();
  /// Takes the equations of multipliers, where they are unknowns, from this number on.
  void number_multipliers(int first);
  void serialize(DumpStream& ar);

  using Side = mixture_contact::Side;
  const std::array<int, 3>& displacements(Side side) const { return of_face(side).displacements; }
  /// -1 where the module has none.
  int pressure(Side side) const { return of_face(side).pressure; }
  int concentration(Side side, int solute) const { return of_face(side).concentration + solute; }
  /// Degrees of freedom at nodes, or on the back faces of shells; -1 where the module has no pressure.
  int pressure(bool is_back) const { return (is_back ? back_ : front_).pressure; }
  int concentration(bool is_back, int solute) const { return (is_back ? back_ : front_).concentration + solute; }
  /// The number of solutes in the model.
  int concentrations() const { return concentrations_; }
  /// The degree of freedom of an exchanged field.
  int field(Side side, const mixture_contact::Effects& effects, int field) const;
  int first_multiplier() const { return first_multiplier_; }
  /// A node that belongs to no rigid body, and if possible to no linear constraint; -1 where there is none.
  int deformable_node() const;
  /// Whether a surface has a node with an equation of its own.
  bool has_free_node(Side side) const;
  /// Whether a surface has a node of a rigid body that is free to move in some way.
  bool has_free_rigid_body(Side side) const;

  /// The degrees of freedom of the forces on a node.
  const std::array<int, 3>& displacements(Side side, const FENode& node) const;
  /// Degrees of freedom of the rotations of rigid bodies, as their nodes have them.
  const std::array<int, 3>& rotations() const { return rotations_; }
  /// A node of the mesh that stands for the block of multipliers.
  int multiplier_node() const { return multiplier_node_; }

 private:
  /// Degrees of freedom of a node: those of its position, or those of the back face of a shell.
  struct FaceDofs {
    std::array<int, 3> displacements{-1, -1, -1};
    int pressure = -1;
    int concentration = -1;  ///< of solute 0; the others follow
  };
  const FaceDofs& of_face(Side side) const { return surfaces_[side].has_shell_bottoms() ? back_ : front_; }
  FaceDofs face_dofs(const std::array<const char*, 3>& displacements, const char* pressure,
                     const char* concentration) const;

  FEModel& fem_;
  ContactSurfaces& surfaces_;
  FaceDofs front_;
  FaceDofs back_;
  std::array<int, 3> rotations_{-1, -1, -1};
  int concentrations_ = 0;     ///< number of solutes in the model
  int first_multiplier_ = -1;  ///< equation; the others follow
  /// FEBio assembles equations in blocks, one per node. A block that belongs to no node would be left out
  /// of the coupling with rigid bodies, one of a rigid node be taken for a force on it: a deformable node stands for
  /// the block of multipliers.
  int multiplier_node_ = -1;
};
