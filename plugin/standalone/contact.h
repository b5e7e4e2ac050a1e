/// A sliding contact of a model.
#pragma once

#include "host/penalty_reduction.h"
#include "paired_surfaces.h"

namespace standalone {

/// A sliding contact: it passes positions and fields of the model to the contact core. Its own state is that of the
/// core; the caller passes the current nodal values.
class Contact {
 public:
  using Side = mixture_contact::Side;
  template <class T>
  using PerSide = mixture_contact::PerSide<T>;

  /// Throws InputError if the surfaces cannot be in contact.
  Contact(ContactDefinition definition, const Bodies& bodies);

  const ContactDefinition& definition() const { return definition_; }
  mixture_contact::ContactInterface& core() const { return *core_; }
  const std::vector<int>& nodes(Side side) const { return surfaces_.nodes(side); }
  /// A line for the log with the exchanged effects, and the reason for each effect that is not exchanged.
  const std::string& effects_line() const { return effects_line_; }

  /// Sets the laws at the end of a step of length `dt` [s] that ends at `time` [s], with the ambient pressure of the
  /// friction law at that time. `reduction`: reduction of an automatic traction penalty.
  void update_laws(double time, double dt, const mixture_contact::ReducedPenalty& reduction);
  /// True if reduced penalties have an effect on this contact.
  bool has_reducible_penalty() const;
  /// Sets which nodes can move. `free`: per nodal value, true if it is an unknown (see Model::place).
  void find_immovable_nodes(const std::vector<bool>& free);
  /// Reads the materials behind the facets again, because their convective part depends on the current flow.
  void update_properties(const MatrixXd& values);
  /// Searches for the facets that face each other at these nodal values.
  void project(const MatrixXd& values) { core_->project(surfaces_.positions(values)); }
  /// Positions and exchanged fields in the form of the core.
  PerSide<mixture_contact::SurfaceFields> fields(const MatrixXd& values) const {
    return surfaces_.fields(values, core_->effects());
  }
  /// For each entry of a local vector of the core, its index in a vector of all nodal values (see Model::place).
  std::vector<int> places(const mixture_contact::ContactInterface::Location& where) const {
    return surfaces_.places(where.patch, where.first, core_->effects());
  }

 private:
  Motion motion() const;
  mixture_contact::Effects decide_effects(const FacetMaterials& materials);

  ContactDefinition definition_;
  PairedSurfaces surfaces_;
  std::string effects_line_;
  std::unique_ptr<mixture_contact::ContactInterface> core_;
};

}  // namespace standalone
