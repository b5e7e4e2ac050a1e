/// The two surfaces of a contact, and the values at their nodes as the core takes them.
#pragma once

#include "mixture_surface.h"

class DofMap;

class ContactSurfaces {
 public:
  using Side = mixture_contact::Side;
  template <class T>
  using PerSide = mixture_contact::PerSide<T>;

  /// `contact`: the contact that owns them.
  ContactSurfaces(FEModel& fem, FEMixtureContact& contact);

  FEMixtureSurface& operator[](Side side) { return side == Side::primary ? primary_ : secondary_; }
  const FEMixtureSurface& operator[](Side side) const { return side == Side::primary ? primary_ : secondary_; }
  PerSide<std::string> names() const;
  /// How many facets both have in common.
  int common_facets() const;

  PerSide<mixture_contact::Matrix3Xd> positions();
  PerSide<mixture_contact::SurfaceFields> fields(const DofMap& dofs, const mixture_contact::Effects& effects);
  /// Moves the nodes of the primary surface, in the reference configuration.
  void relocate_primary(const mixture_contact::Matrix3Xd& positions);

 private:
  FEMixtureSurface primary_;
  FEMixtureSurface secondary_;
};
