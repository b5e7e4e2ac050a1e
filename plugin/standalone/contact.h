/// A contact interface of a model: gathers positions and fields for the contact core, and hands its residual and
/// tangent on.
#pragma once

#include "bodies.h"
#include "host/facet_material.h"
#include "host/penalty_reduction.h"

namespace standalone {

/// One contact. Its state, beside the core's multipliers and status, are the current nodal values that the caller
/// passes.
class Contact {
 public:
  using Side = mixture_contact::Side;
  template <class T>
  using PerSide = mixture_contact::PerSide<T>;

  /// Throws InputError where the surfaces cannot be in contact.
  Contact(const Model& model, const ContactDefinition& definition, const Bodies& bodies);

  const ContactDefinition& definition() const { return definition_; }
  mixture_contact::ContactInterface& core() const { return *core_; }
  const std::vector<int>& nodes(Side side) const { return nodes_[side]; }
  /// A line that says which effects the contact exchanges, and why others are absent.
  const std::string& effects_line() const { return effects_line_; }

  /// Takes laws as they are at the end of a step of `dt` [s]: friction knows the ambient pressure, and an automatic
  /// penalty of the traction is reduced as `reduction` says.
  void update_laws(double time, double dt, const mixture_contact::ReducedPenalty& reduction);
  /// Whether a reduction has an effect.
  bool has_reducible_penalty() const;
  /// Reads the materials behind the facets again: the convective part follows the current flow.
  void update_properties(const MatrixXd& values);
  /// Finds out which facets face each other.
  void project(const MatrixXd& values) { core_->project(positions(values)); }
  /// Positions and exchanged fields, as the core takes them.
  PerSide<mixture_contact::SurfaceFields> fields(const MatrixXd& values) const;
  /// Places of nodal values (see Model::place) that a local vector of the core's belongs to.
  std::vector<int> places(const mixture_contact::ContactInterface::Location& where) const;

 private:
  Motion motion() const;
  bool can_move() const;
  FacetMaterial material(const SurfaceFacet& facet, const MatrixXd& values) const;
  FacetMaterials materials(const MatrixXd& values) const;
  mixture_contact::Effects decide_effects(const FacetMaterials& materials);
  mixture_contact::SurfaceMesh surface_mesh(Side side) const;
  PerSide<Matrix3Xd> positions(const MatrixXd& values) const;
  int field_dof(int field) const;

  const Model& model_;
  const ContactDefinition& definition_;
  const Bodies& bodies_;
  PerSide<std::vector<SurfaceFacet>> facets_;  ///< with nodes of the mesh
  PerSide<std::vector<int>> nodes_;            ///< mesh nodes of each surface, in the order of the core
  std::string effects_line_;
  std::unique_ptr<mixture_contact::ContactInterface> core_;
};

}  // namespace standalone
