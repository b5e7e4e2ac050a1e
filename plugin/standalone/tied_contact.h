/// A tie of a model.
#pragma once

#include "contact/tie/tie.h"
#include "host/augmentation.h"
#include "paired_surfaces.h"

namespace standalone {

/// A tie: it passes positions and fields of the model to the core of ties. Its own state is that of the core; the
/// caller passes the current nodal values.
class TiedContact {
 public:
  /// Finds the tied nodes in the reference configuration. Throws InputError if there are none.
  TiedContact(ContactDefinition definition, const Bodies& bodies);

  mixture_contact::Tie& core() const { return *core_; }
  /// Lines for the log with the exchanged effects and the number of tied nodes.
  const std::vector<std::string>& lines() const { return lines_; }

  /// Sets the penalties in a step of length `dt` [s]; materials are read again if penalties depend on them.
  void start_step(const MatrixXd& values, double dt);
  mixture_contact::PerSide<mixture_contact::SurfaceFields> fields(const MatrixXd& values) const {
    return surfaces_.fields(values, core_->effects());
  }
  /// For each entry of a local vector of the core, its index in a vector of all nodal values (see Model::place).
  std::vector<int> places(const mixture_contact::Patch& patch) const {
    return surfaces_.places(patch, mixture_contact::Side::primary, core_->effects());
  }
  /// Reports the gaps and jumps of a solution, and augments the tie if they exceed the tolerances. `augmentation`:
  /// number of augmentations since the start of the step.
  Augmentation augment(const MatrixXd& values, int augmentation) const;

 private:
  [[noreturn]] void fail(const std::string& what) const;
  mixture_contact::Effects decide_effects(const FacetMaterials& materials);
  std::string title() const { return "tied-mixture \"" + definition_.name + "\""; }

  ContactDefinition definition_;
  PairedSurfaces surfaces_;
  std::vector<std::string> lines_;
  std::unique_ptr<mixture_contact::Tie> core_;
};

}  // namespace standalone
