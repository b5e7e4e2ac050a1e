/// The two surfaces of a contact in FEBio.
#pragma once

#include "contact/interface/carried_state.h"
#include "contact/interface/output.h"
#include "host/contact_parameters.h"
#include "mixture_surface.h"

#include <vector>

/// The surfaces with the positions and numbers of their nodes.
class ContactSurfaces {
 public:
  using Side = mixture_contact::Side;
  template <class T>
  using PerSide = mixture_contact::PerSide<T>;

  /// `contact`: contact that owns the surfaces.
  ContactSurfaces(FEModel& fem, FEContactInterface& contact);

  /// Initialises both surfaces, and reverses the facets of a surface that <flip_primary> or <flip_secondary> names.
  /// Returns false if FEBio rejects a surface.
  bool init(const ContactParameters& parameters);
  FEMixtureSurface& operator[](Side side) { return side == Side::primary ? primary_ : secondary_; }
  const FEMixtureSurface& operator[](Side side) const { return side == Side::primary ? primary_ : secondary_; }
  FEModel& fem() { return *primary_.GetFEModel(); }
  PerSide<std::string> names() const;
  /// The number of facets that both surfaces have in common.
  int common_facets() const;

  /// For each surface, the numbers of its nodes in the mesh.
  mixture_contact::NodeNumbers node_numbers() const;
  /// True if facets of a surface may have changed since the last call.
  bool take_change();
  /// The surface that has lost all its facets; null if both have facets.
  const FEMixtureSurface* without_facets() const;
  /// The present positions of the nodes of both surfaces [mm].
  PerSide<mixture_contact::Matrix3Xd> positions();
  /// Moves the nodes of the primary surface to these positions in the reference configuration.
  void relocate_primary(const mixture_contact::Matrix3Xd& positions);
  /// Stores the output of a contact that exchanges these effects. Totals of the secondary surface have opposite signs.
  void store_output(const mixture_contact::InterfaceOutput& out, const mixture_contact::Effects& effects);

 private:
  FEMixtureSurface primary_;
  FEMixtureSurface secondary_;
};
