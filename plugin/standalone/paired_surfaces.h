/// The two surfaces of a contact or a tie: their facets and nodes, the materials behind them, and nodal values on them.
#pragma once

#include "bodies.h"
#include "host/facet_material.h"

namespace standalone {

/// The error where no element of either surface has a stiffness.
inline constexpr const char* no_stiffness =
    "both surfaces are rigid, so the penalty cannot follow from a stiffness; set <penalty> and leave <auto_penalty> "
    "at 0";

class PairedSurfaces {
 public:
  using Side = mixture_contact::Side;
  template <class T>
  using PerSide = mixture_contact::PerSide<T>;

  /// Keeps references. Throws InputError if materials cannot be read.
  PairedSurfaces(const Model& model, const PerSide<std::string>& names, const Bodies& bodies);

  const std::vector<int>& nodes(Side side) const { return nodes_[side]; }
  const PerSide<std::vector<int>>& nodes() const { return nodes_; }
  /// Whether a displacement of any node is free.
  bool can_move() const;
  /// The materials behind all facets, at nodal values of shape (dofs, nodes): solutes are carried by the flow there.
  FacetMaterials materials(const MatrixXd& values) const;
  PerSide<mixture_contact::SurfaceMesh> meshes(const FacetMaterials& materials,
                                               const mixture_contact::Effects& effects) const;

  PerSide<Matrix3Xd> positions(const MatrixXd& values) const;
  /// Positions and exchanged fields, as the core takes them.
  PerSide<mixture_contact::SurfaceFields> fields(const MatrixXd& values, const mixture_contact::Effects& effects) const;
  /// Places of nodal values (see Model::place) that a local vector over a patch belongs to. `first` is the patch's
  /// primary side.
  std::vector<int> places(const mixture_contact::Patch& patch, Side first,
                          const mixture_contact::Effects& effects) const;

 private:
  FacetMaterial material(const SurfaceFacet& facet, const MatrixXd& values) const;
  mixture_contact::SurfaceMesh mesh(Side side) const;

  const Model& model_;
  const Bodies& bodies_;
  PerSide<std::vector<SurfaceFacet>> facets_;  ///< with nodes of the mesh
  PerSide<std::vector<int>> nodes_;            ///< mesh nodes of each surface, in the order of the core
};

}  // namespace standalone
