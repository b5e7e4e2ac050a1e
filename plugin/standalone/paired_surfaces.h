/// The two surfaces of a sliding contact or a tie: facets, nodes, materials behind the facets, and nodal values.
#pragma once

#include "bodies.h"
#include "host/facet_material.h"

namespace standalone {

/// The error message if neither surface has an element with a stiffness.
inline constexpr const char* no_stiffness =
    "both surfaces are rigid, so the penalty cannot follow from a stiffness; set <penalty> and leave <auto_penalty> "
    "at 0";

/// Access to the surfaces of a model in the form of the contact core.
class PairedSurfaces {
 public:
  using Side = mixture_contact::Side;
  template <class T>
  using PerSide = mixture_contact::PerSide<T>;

  /// Keeps a reference. Throws InputError if the materials cannot be used. `names`: names of the surfaces.
  PairedSurfaces(const PerSide<std::string>& names, const Bodies& bodies);

  const Model& model() const { return bodies_.model(); }
  const std::vector<int>& nodes(Side side) const { return nodes_[side]; }
  const PerSide<std::vector<int>>& nodes() const { return nodes_; }
  /// True if a displacement of any node is free.
  bool can_move() const;
  /// The materials behind all facets. `values`: nodal values, shape (dofs, nodes); the convection of solutes depends on
  /// them.
  FacetMaterials materials(const MatrixXd& values) const;
  /// The meshes of the surfaces with these materials.
  PerSide<mixture_contact::SurfaceMesh> meshes(const FacetMaterials& materials,
                                               const mixture_contact::Effects& effects) const;

  /// The positions of the nodes at these nodal values [mm].
  PerSide<Matrix3Xd> positions(const MatrixXd& values) const;
  /// Positions and exchanged fields in the form of the core.
  PerSide<mixture_contact::SurfaceFields> fields(const MatrixXd& values, const mixture_contact::Effects& effects) const;
  /// For each entry of a local vector over a patch, its index in a vector of all nodal values (see Model::place).
  /// `first`: side of the patch's primary nodes.
  std::vector<int> places(const mixture_contact::Patch& patch, Side first,
                          const mixture_contact::Effects& effects) const;

 private:
  FacetMaterial material(const SurfaceFacet& facet, const MatrixXd& values) const;
  mixture_contact::SurfaceMesh mesh(Side side) const;

  const Bodies& bodies_;
  PerSide<std::vector<SurfaceFacet>> facets_;  ///< facets with node indices of the mesh
  PerSide<std::vector<int>> nodes_;            ///< mesh nodes of each surface, in the node order of the core
};

}  // namespace standalone
