/// A contact surface in FEBio: its geometry, and the values of FEBio's contact plot variables.
#pragma once

#include "contact/interface/output.h"

#include <FEBioMix/FEBiphasicContactSurface.h>

#include <functional>
#include <optional>
#include <utility>
#include <vector>

/// FEBio's form of a vector.
inline vec3d to_febio(const mixture_contact::Vector3d& v) { return {v[0], v[1], v[2]}; }

/// The core's type of a facet; empty if the core does not support it.
std::optional<mixture_contact::FacetType> facet_type(const FESurfaceElement& element);

/// A surface of a sliding contact or a tie.
class FEMixtureSurface : public FEBiphasicContactSurface {
 public:
  explicit FEMixtureSurface(FEModel* fem) : FEBiphasicContactSurface(fem) {}

  /// Initialises the surface with its active facets. FEBio also calls it after erosion, when facets have become
  /// inactive or new ones have been added.
  bool Init() override;
  /// Copies the facets of another surface, because this surface has the same facets.
  void take_facets_of(const FEMixtureSurface& other);
  /// True if facets may have changed since the last call.
  bool take_change() { return std::exchange(has_changed_, false); }

  /// Makes a material point per integration point of FEBio's rule; these points contain output only.
  FEMaterialPoint* CreateMaterialPoint() override { return new FEBiphasicContactPoint; }

  /// Stores nodal values and totals of this surface for output, and copies them to FEBio's material points.
  /// `exchanged`: solute of each exchanged field, -1 for the solvent.
  void store_output(const mixture_contact::NodalOutput& nodal, const mixture_contact::Balance& total,
                    const std::vector<int>& exchanged);

  const mixture_contact::NodalOutput& nodal_output() const { return nodal_; }
  /// Totals on this surface from its own contact; flows are positive out of this surface's body.
  const mixture_contact::Balance& total() const { return total_; }
  /// The surfaces with this name in all active contacts of the model. A record in the log refers to a surface by its
  /// name, which several contacts may share.
  std::vector<const FEMixtureSurface*> of_all_contacts();
  /// The row of a solute (-1: the solvent) in flux, jump and flow; -1 if it is not exchanged.
  int exchanged_field(int solute) const;

  /// Uses the back faces of shells for this surface: positions of nodes minus their directors. Facets that are listed
  /// as front faces are reversed.
  void take_shell_bottoms();
  bool has_shell_bottoms() const { return has_shell_bottoms_; }
  /// The present position of a node of this surface.
  vec3d position(int node);

  /// Reverses the facets, such that they face the opposite direction. FESurface::Invert() does not reverse the local
  /// node numbers.
  void turn_round();

  vec3d GetContactForce() override;
  double GetContactArea() override;
  vec3d GetFluidForce() override;
  void GetVectorGap(int face, vec3d& gap) override;
  void GetContactTraction(int face, vec3d& traction) override;
  void GetStickStatus(int face, double& sticks) override;
  void GetMuEffective(int face, double& coefficient) override;
  void GetLocalFLS(int face, double& support) override;
  void GetNodalVectorGap(int face, vec3d* gap) override;
  void GetNodalContactPressure(int face, double* pressure) override;
  void GetNodalContactTraction(int face, vec3d* traction) override;

  void Serialize(DumpStream& ar) override;

 private:
  void drop_inactive_facets();
  /// True if the facets are listed as front faces of shells.
  bool faces_front();
  void store_friction(FESurfaceElement& element);
  /// The mean over the points of a facet.
  double mean(int face, const std::function<double(const FEBiphasicContactPoint&)>& value);

  mixture_contact::NodalOutput nodal_;
  mixture_contact::Balance total_;
  std::vector<int> exchanged_;
  bool has_shell_bottoms_ = false;
  bool has_changed_ = false;
};
