/// The two surfaces of a contact: positions of their nodes, and common facets.
#pragma once

#include "contact/interface/carried_state.h"
#include "mixture_surface.h"

#include <vector>

class ContactSurfaces {
 public:
  using Side = mixture_contact::Side;
  template <class T>
  using PerSide = mixture_contact::PerSide<T>;

  /// `contact`: the contact that owns them.
  ContactSurfaces(FEModel& fem, FEContactInterface& contact);

  FEMixtureSurface& operator[](Side side) { return side == Side::primary ? primary_ : secondary_; }
  const FEMixtureSurface& operator[](Side side) const { return side == Side::primary ? primary_ : secondary_; }
  PerSide<std::string> names() const;
  /// How many facets both have in common.
  int common_facets() const;

  /// Numbers in the mesh of the nodes of each surface.
  mixture_contact::NodeNumbers node_numbers() const;
  /// Whether facets of a surface may have changed since the last call.
  bool take_change();
  /// The surface that has lost all its facets; null if there is none.
  const FEMixtureSurface* without_facets() const;
  PerSide<mixture_contact::Matrix3Xd> positions();
  /// Moves the nodes of the primary surface, in the reference configuration.
  void relocate_primary(const mixture_contact::Matrix3Xd& positions);

 private:
  FEMixtureSurface primary_;
  FEMixtureSurface secondary_;
};
