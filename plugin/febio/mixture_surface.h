/// A surface of the contact for FEBio: geometry, and the values of FEBio's own plot variables.
#pragma once

#include "contact/interface/output.h"

#include <FEBioMix/FEBiphasicContactSurface.h>

#include <functional>
#include <optional>
#include <utility>
#include <vector>

/// The core's type of a facet; none where the core does not know it.
std::optional<mixture_contact::FacetType> facet_type(const FESurfaceElement& element);

class FEMixtureSurface : public FEBiphasicContactSurface {
 public:
  explicit FEMixtureSurface(FEModel* fem) : FEBiphasicContactSurface(fem) {}

  /// Begins with the facets that are active: FEBio's erosion calls this, too, where it has made some inactive or has
  /// made others.
  bool Init() override;
  /// Takes the facets of another surface, on which this one lies.
  void take_facets_of(const FEMixtureSurface& other);
  /// Whether facets may have changed since the last call.
  bool take_change() { return std::exchange(has_changed_, false); }

  /// One FEBiphasicContactPoint per integration point of FEBio's rule; it carries output only.
  FEMaterialPoint* CreateMaterialPoint() override { return new FEBiphasicContactPoint; }

  /// Takes the values at the nodes and the totals of this surface for output, and hands them on to FEBio's material
  /// points. `exchanged`: the solute of each exchanged field, -1 for the solvent.
  void store_output(const mixture_contact::NodalOutput& nodal, const mixture_contact::Balance& total,
                    const std::vector<int>& exchanged);

  const mixture_contact::NodalOutput& nodal_output() const { return nodal_; }
  /// Totals as they act on this surface by its contact alone; flows out of this surface's body.
  const mixture_contact::Balance& total() const { return total_; }
  /// The surfaces of this name in the active contacts of the model, one of each contact: a record of the log names a
  /// surface, which several contacts may share.
  std::vector<const FEMixtureSurface*> of_all_contacts();
  /// Row of a solute (-1: the solvent) in flux, jump and flow; -1 where it is not exchanged.
  int exchanged_field(int solute) const;

  /// Takes the back faces of shells for this surface: the nodes' positions less their directors. Facets that are listed
  /// as those of the front face are turned round.
  void take_shell_bottoms();
  bool has_shell_bottoms() const { return has_shell_bottoms_; }
  /// The present position of a node on this surface.
  vec3d position(int node);

  /// Turns the facets round, so that they face the other way. FESurface::Invert() alone leaves their local node
  /// numbers.
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
  /// Whether the facets are listed as those of the front faces of shells.
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
