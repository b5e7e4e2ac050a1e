/// A contact interface of a model: gathers positions and fields for the contact core, and hands its residual and
/// tangent on.
#pragma once

#include "host/penalty_reduction.h"
#include "paired_surfaces.h"

namespace standalone {

/// One contact. Its state, besides the core's multipliers and status, are the current nodal values that the caller
/// passes.
class Contact {
 public:
  using Side = mixture_contact::Side;
  template <class T>
  using PerSide = mixture_contact::PerSide<T>;

  /// Throws InputError if the surfaces cannot be in contact.
  Contact(const Model& model, const ContactDefinition& definition, const Bodies& bodies);

  const ContactDefinition& definition() const { return definition_; }
  mixture_contact::ContactInterface& core() const { return *core_; }
  const std::vector<int>& nodes(Side side) const { return surfaces_.nodes(side); }
  /// A line with the exchanged effects of the contact, and the reason for each absent one.
  const std::string& effects_line() const { return effects_line_; }

  /// Takes laws as they are at the end of a step of `dt` [s]: friction knows the ambient pressure, and an automatic
  /// penalty of the traction is reduced as `reduction` says.
  void update_laws(double time, double dt, const mixture_contact::ReducedPenalty& reduction);
  /// Whether a reduction changes any penalty.
  bool has_reducible_penalty() const;
  /// Reads the materials behind the facets again: the convective part follows the current flow.
  void update_properties(const MatrixXd& values);
  /// Finds out which facets face each other.
  void project(const MatrixXd& values) { core_->project(surfaces_.positions(values)); }
  /// Positions and exchanged fields, as the core takes them.
  PerSide<mixture_contact::SurfaceFields> fields(const MatrixXd& values) const {
    return surfaces_.fields(values, core_->effects());
  }
  /// Places of nodal values (see Model::place) that a local vector of the core's belongs to.
  std::vector<int> places(const mixture_contact::ContactInterface::Location& where) const {
    return surfaces_.places(where.patch, where.first, core_->effects());
  }

 private:
  Motion motion() const;
  mixture_contact::Effects decide_effects(const FacetMaterials& materials);

  const Model& model_;
  const ContactDefinition& definition_;
  PairedSurfaces surfaces_;
  std::string effects_line_;
  std::unique_ptr<mixture_contact::ContactInterface> core_;
};

}  // namespace standalone
