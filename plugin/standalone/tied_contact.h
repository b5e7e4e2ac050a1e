/// A tie of a model: gathers positions and fields for the core of ties, and hands its residual and tangent on.
#pragma once

#include "contact/tie/tie.h"
#include "host/augmentation.h"
#include "paired_surfaces.h"

namespace standalone {

/// One tie. Its state, besides the core's multipliers, are the current nodal values that the caller passes.
class TiedContact {
 public:
  /// Finds the tied nodes in the reference configuration. Throws InputError if there are none.
  TiedContact(const Model& model, const ContactDefinition& definition, const Bodies& bodies);

  mixture_contact::Tie& core() const { return *core_; }
  /// Lines with the exchanged effects of the tie, and its number of tied nodes.
  const std::vector<std::string>& lines() const { return lines_; }

  /// Takes penalties as they are in a step of `dt` [s]: those that follow the materials read these again.
  void start_step(const MatrixXd& values, double dt);
  mixture_contact::PerSide<mixture_contact::SurfaceFields> fields(const MatrixXd& values) const {
    return surfaces_.fields(values, core_->effects());
  }
  /// Places of nodal values (see Model::place) that a local vector of the core's belongs to.
  std::vector<int> places(const mixture_contact::Patch& patch) const {
    return surfaces_.places(patch, mixture_contact::Side::primary, core_->effects());
  }
  /// Reports gaps and jumps at a solution, and augments where they miss the tolerances.
  Augmentation augment(const MatrixXd& values, int augmentation) const;

 private:
  [[noreturn]] void fail(const std::string& what) const;
  mixture_contact::Effects decide_effects(const FacetMaterials& materials);
  std::string title() const { return "tied-mixture \"" + definition_.name + "\""; }

  const Model& model_;
  const ContactDefinition& definition_;
  PairedSurfaces surfaces_;
  std::vector<std::string> lines_;
  std::unique_ptr<mixture_contact::Tie> core_;
};

}  // namespace standalone
