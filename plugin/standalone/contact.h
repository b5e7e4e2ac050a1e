/// A contact interface of a model: gathers positions and fields for the contact core, and hands its residual and
/// tangent on.
#pragma once

#include "bodies.h"
#include "contact/interface.h"
#include "host/exchange.h"

namespace standalone {

/// One contact. Its state, beside the core's multipliers and status, are the current nodal values that the caller
/// passes.
class Contact {
 public:
  using Side = mixture_contact::Side;
  template <class T>
  using PerSide = mixture_contact::PerSide<T>;
  using Dofs = std::vector<std::pair<int, int>>;  ///< (row of nodal values, node)

  /// Unknown multipliers are nodal values from row `first_row` on. Throws InputError where the surfaces cannot be in
  /// contact.
  Contact(const Model& model, const ContactDefinition& definition, const Bodies& bodies, int first_row);

  const ContactDefinition& definition() const { return definition_; }
  mixture_contact::ContactInterface& core() { return *core_; }
  const std::vector<int>& nodes(Side side) const { return nodes_[side]; }
  /// A line that says which effects the contact exchanges, and why others are absent.
  const std::string& effects_line() const { return effects_line_; }

  /// Rows of nodal values that hold unknown multipliers, on the primary nodes: none, or traction and each field.
  int multiplier_rows() const;
  Dofs multipliers() const;
  /// Sets the core's unknown multipliers to those among the nodal values.
  void take_multipliers(const MatrixXd& values);

  /// Stiffness and conductance behind each facet, for the automatic penalties; the convective part follows the current
  /// flow.
  void update_properties(const MatrixXd& values);
  /// Finds out which facets face each other; `keep_facets`: no new search.
  void project(const MatrixXd& values, bool keep_facets);
  /// The mesh's nodes with those of the primary surface that overlap the other one moved onto it.
  Matrix3Xd nodes_without_overlap();
  /// The core's calls of the same names, at these nodal values.
  bool begin_iteration(const MatrixXd& values) { return core_->begin_iteration(fields(values)); }
  bool is_solution(const MatrixXd& values) const { return core_->is_solution(fields(values)); }
  PerSide<mixture_contact::SurfaceFields> fields(const MatrixXd& values) const;

  /// Calls add(rows, forces), degrees of freedom as (dof, node), for each part of the virtual work (2.5).
  void for_each_residual(const MatrixXd& values, double dt,
                         const std::function<void(const Dofs&, const VectorXd&)>& add) const;
  /// Calls add(rows, columns, tangent), for each part of the tangent (2.6).
  void for_each_tangent(const MatrixXd& values, double dt,
                        const std::function<void(const Dofs&, const Dofs&, const MatrixXd&)>& add) const;

  /// Multipliers of each pass: what is to be kept for a time step that is tried again.
  using Saved = std::vector<mixture_contact::Multipliers>;
  Saved save();
  void restore(const Saved& saved);

 private:
  std::vector<FieldAtContact> fields_of_model() const;
  bool can_move() const;
  void decide_effects();
  mixture_contact::SurfaceMesh surface_mesh(Side side, const MatrixXd& values) const;
  PerSide<Matrix3Xd> positions(const MatrixXd& values) const;
  int field_dof(int field) const;
  Dofs dofs(const mixture_contact::ContactInterface::Location& at) const;

  const Model& model_;
  const ContactDefinition& definition_;
  const Bodies& bodies_;
  int first_row_;                              ///< of the multipliers
  PerSide<std::vector<SurfaceFacet>> facets_;  ///< with nodes of the mesh
  PerSide<std::vector<int>> nodes_;            ///< mesh nodes of each surface, in the order of the core
  mixture_contact::Effects effects_;
  std::string effects_line_;
  std::unique_ptr<mixture_contact::ContactInterface> core_;
};

}  // namespace standalone
