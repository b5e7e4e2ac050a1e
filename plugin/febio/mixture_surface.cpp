#include "mixture_surface.h"

#include "archive.h"
#include "contact/base/indexed_vector.h"

#include <FEBioMech/FEMechModel.h>
#include <FEBioMech/FERigidBody.h>
#include <FECore/FEMesh.h>
#include <FECore/FEModel.h>
#include <FECore/FESurfacePairConstraint.h>

#include <algorithm>
#include <array>
#include <map>

using mixture_contact::at;

namespace {

/// The point that CreateMaterialPoint() has made for an integration point.
FEBiphasicContactPoint& contact_point(FESurfaceElement& element, int q) {
  return static_cast<FEBiphasicContactPoint&>(*element.GetMaterialPoint(q));
}

bool is_triangular(const FESurfaceElement& element) {
  return element.Shape() == ET_TRI3 || element.Shape() == ET_TRI6 || element.Shape() == ET_TRI7 ||
         element.Shape() == ET_TRI10;
}

/// A facet in FEBio: its type and its nodes in the mesh.
using FacetInMesh = std::pair<int, std::vector<int>>;

/// Replaces the facets of a surface.
void create(FESurface& surface, const std::vector<FacetInMesh>& facets) {
  const int count = mixture_contact::number_of(facets);
  surface.Create(count);
  for (int face = 0; face < count; ++face) {
    const auto& [type, nodes] = at(facets, face);
    FESurfaceElement& element = surface.Element(face);
    element.SetType(type);
    element.m_node = nodes;
    element.setActive();
  }
  surface.CreateMaterialPointData();
}

}  // namespace

std::optional<mixture_contact::FacetType> facet_type(const FESurfaceElement& element) {
  return mixture_contact::facet_type(is_triangular(element), element.Nodes());
}

bool FEMixtureSurface::Init() {
  drop_inactive_facets();
  has_changed_ = true;
  return FEBiphasicContactSurface::Init();
}

void FEMixtureSurface::drop_inactive_facets() {
  std::vector<FacetInMesh> kept;
  for (int face = 0; face < Elements(); ++face) {
    const FESurfaceElement& element = Element(face);
    if (element.isActive()) kept.emplace_back(element.Type(), element.m_node);
  }
  if (mixture_contact::number_of(kept) != Elements()) create(*this, kept);
}

void FEMixtureSurface::take_facets_of(const FEMixtureSurface& other) {
  std::vector<FacetInMesh> facets;
  for (int face = 0; face < other.Elements(); ++face)
    facets.emplace_back(other.Element(face).Type(), other.Element(face).m_node);
  create(*this, facets);
  InitSurface();
}

int FEMixtureSurface::exchanged_field(int solute) const {
  const auto found = std::find(exchanged_.begin(), exchanged_.end(), solute);
  return found == exchanged_.end() ? -1 : indexing::as_int(found - exchanged_.begin());
}

void FEMixtureSurface::store_output(const mixture_contact::NodalOutput& nodal, const mixture_contact::Balance& total,
                                    const std::vector<int>& exchanged) {
  nodal_ = nodal;
  total_ = total;
  exchanged_ = exchanged;
  std::vector<double> gap(FEElement::MAX_NODES);
  std::vector<double> pressure(FEElement::MAX_NODES);
  std::vector<double> jump(FEElement::MAX_NODES);
  for (int face = 0; face < Elements(); ++face) {
    FESurfaceElement& element = Element(face);
    for (int a = 0; a < element.Nodes(); ++a) {
      const int node = at(element.m_lnode, a);
      at(gap, a) = nodal.gap[node];
      at(pressure, a) = nodal.pressure[node];
      at(jump, a) = nodal.jump.rows() > 0 ? nodal.jump(0, node) : 0.0;
    }
    for (int q = 0; q < element.GaussPoints(); ++q) {
      auto& point = contact_point(element, q);
      point.m_gap = -element.eval(gap.data(), q);  // FEBio counts an overlap as a positive gap
      point.m_Ln = element.eval(pressure.data(), q);
      point.m_pg = element.eval(jump.data(), q);
      point.m_nu = SurfaceNormal(element, q);
      point.m_tr = point.m_nu * (-point.m_Ln);
    }
    store_friction(element);
  }
}

void FEMixtureSurface::store_friction(FESurfaceElement& element) {
  std::vector<vec3d> traction(FEElement::MAX_NODES);
  std::vector<double> coefficient(FEElement::MAX_NODES);
  std::vector<double> support(FEElement::MAX_NODES);
  std::vector<double> sticks(FEElement::MAX_NODES);
  for (int a = 0; a < element.Nodes(); ++a) {
    const int node = at(element.m_lnode, a);
    at(traction, a) = to_febio(vector_at(nodal_.friction.traction, node));
    at(coefficient, a) = nodal_.effective_friction(node);
    at(support, a) = nodal_.fluid_load_support(node);
    at(sticks, a) = mixture_contact::status_of(nodal_.friction, node) == mixture_contact::Sliding::sticks ? 1 : 0;
  }
  for (int q = 0; q < element.GaussPoints(); ++q) {
    auto& point = contact_point(element, q);
    point.m_tr += element.eval(traction.data(), q);
    point.m_mueff = element.eval(coefficient.data(), q);
    point.m_fls = element.eval(support.data(), q);
    point.m_bstick = element.eval(sticks.data(), q) > 0.5;
  }
}

void FEMixtureSurface::turn_round() {
  std::map<int, int> local;  // number of each node on the surface, by its index in the mesh
  for (int i = 0; i < Nodes(); ++i) local[NodeIndex(i)] = i;
  Invert();
  for (int face = 0; face < Elements(); ++face) {
    FESurfaceElement& element = Element(face);
    std::transform(element.m_node.begin(), element.m_node.end(), element.m_lnode.begin(),
                   [&](int node) { return local.at(node); });
  }
}

bool FEMixtureSurface::faces_front() {
  double along = 0;  // sum of normal.director over all facets
  for (int face = 0; face < Elements(); ++face) {
    const FESurfaceElement& element = Element(face);
    const auto& nodes = element.m_lnode;
    const vec3d& first = Node(nodes[0]).m_r0;
    const vec3d normal = (Node(nodes[1]).m_r0 - first) ^ (Node(nodes[2]).m_r0 - first);
    along += normal * Node(nodes[0]).m_d0;
  }
  return along > 0;
}

void FEMixtureSurface::take_shell_bottoms() {
  has_shell_bottoms_ = true;
  if (faces_front()) turn_round();
}

vec3d FEMixtureSurface::position(int node) {
  const FENode& place = Node(node);
  if (!has_shell_bottoms_) return place.m_rt;
  // FEBio does not rotate the directors of rigid shells.
  auto* mechanics = dynamic_cast<FEMechModel*>(GetFEModel());
  if (place.m_rid < 0 || mechanics == nullptr) return place.st();
  return place.m_rt - mechanics->GetRigidBody(place.m_rid)->GetRotation() * place.m_d0;
}

std::vector<const FEMixtureSurface*> FEMixtureSurface::of_all_contacts() {
  std::vector<const FEMixtureSurface*> found;
  FEModel& fem = *GetFEModel();
  for (int i = 0; i < fem.SurfacePairConstraints(); ++i) {
    FESurfacePairConstraint& contact = *fem.SurfacePairConstraint(i);
    if (!contact.IsActive()) continue;
    const std::array<FESurface*, 2> sides{contact.GetPrimarySurface(), contact.GetSecondarySurface()};
    const bool is_own = std::find(sides.begin(), sides.end(), this) != sides.end();
    const auto side = std::find_if(sides.begin(), sides.end(), [&](FESurface* each) {
      return is_own ? each == this : each->GetName() == GetName() && dynamic_cast<FEMixtureSurface*>(each) != nullptr;
    });
    if (side != sides.end()) found.push_back(dynamic_cast<const FEMixtureSurface*>(*side));
  }
  return found;
}

vec3d FEMixtureSurface::GetContactForce() {
  vec3d force(0, 0, 0);
  for (const FEMixtureSurface* surface : of_all_contacts()) force += to_febio(surface->total_.force);
  return force;
}

double FEMixtureSurface::GetContactArea() {
  double area = 0;
  for (const FEMixtureSurface* surface : of_all_contacts()) area += surface->total_.area;
  return area;
}

vec3d FEMixtureSurface::GetFluidForce() {
  // Force of the fluid on this surface where it is in contact: -p n da.
  vec3d force(0, 0, 0);
  if (m_dofP < 0 || nodal_.pressure.size() != Nodes()) return force;
  for (int face = 0; face < Elements(); ++face) {
    FESurfaceElement& element = Element(face);
    for (int q = 0; q < element.GaussPoints(); ++q) {
      const auto& point = contact_point(element, q);
      if (!(point.m_Ln > 0)) continue;
      double pressure = 0;
      for (int a = 0; a < element.Nodes(); ++a) {
        pressure += element.H(q)[a] * m_pMesh->Node(at(element.m_node, a)).get(m_dofP);
      }
      vec3d tangents[2];
      CoBaseVectors(element, q, tangents);
      force -= (tangents[0] ^ tangents[1]) * (pressure * element.GaussWeights()[q]);
    }
  }
  return force;
}

void FEMixtureSurface::GetVectorGap(int face, vec3d& gap) {
  FESurfaceElement& element = Element(face);
  gap = vec3d(0, 0, 0);
  for (int q = 0; q < element.GaussPoints(); ++q) {
    const auto& point = contact_point(element, q);
    gap += point.m_nu * (point.m_gap / element.GaussPoints());
  }
}

void FEMixtureSurface::GetContactTraction(int face, vec3d& traction) {
  FESurfaceElement& element = Element(face);
  traction = vec3d(0, 0, 0);
  for (int q = 0; q < element.GaussPoints(); ++q) {
    traction += contact_point(element, q).m_tr / element.GaussPoints();
  }
}

double FEMixtureSurface::mean(int face, const std::function<double(const FEBiphasicContactPoint&)>& value) {
  FESurfaceElement& element = Element(face);
  double sum = 0;
  for (int q = 0; q < element.GaussPoints(); ++q) sum += value(contact_point(element, q));
  return sum / element.GaussPoints();
}

void FEMixtureSurface::GetStickStatus(int face, double& sticks) {
  sticks = mean(face, [](const FEBiphasicContactPoint& point) { return point.m_bstick ? 1.0 : 0.0; });
}

void FEMixtureSurface::GetMuEffective(int face, double& coefficient) {
  coefficient = mean(face, [](const FEBiphasicContactPoint& point) { return point.m_mueff; });
}

void FEMixtureSurface::GetLocalFLS(int face, double& support) {
  support = mean(face, [](const FEBiphasicContactPoint& point) { return point.m_fls; });
}

void FEMixtureSurface::GetNodalVectorGap(int face, vec3d* gap) {
  FESurfaceElement& element = Element(face);
  vec3d at_points[FEElement::MAX_INTPOINTS];
  for (int q = 0; q < element.GaussPoints(); ++q) {
    const auto& point = contact_point(element, q);
    at_points[q] = point.m_nu * point.m_gap;
  }
  element.project_to_nodes(at_points, gap);
}

void FEMixtureSurface::GetNodalContactPressure(int face, double* pressure) {
  const FESurfaceElement& element = Element(face);
  for (int a = 0; a < element.Nodes(); ++a) {
    const int node = at(element.m_lnode, a);
    pressure[a] = node < nodal_.pressure.size() ? nodal_.pressure[node] : 0.0;
  }
}

void FEMixtureSurface::GetNodalContactTraction(int face, vec3d* traction) {
  FESurfaceElement& element = Element(face);
  double pressure[FEElement::MAX_NODES] = {};
  GetNodalContactPressure(face, pressure);
  // The facet types were checked when the contact began.
  const auto type = facet_type(element).value_or(mixture_contact::FacetType::quad4);
  for (int a = 0; a < element.Nodes(); ++a) {
    const mixture_contact::Vector2d place = mixture_contact::parametric_node(type, a);
    traction[a] = SurfaceNormal(element, place[0], place[1]) * (-pressure[a]);
    const int node = at(element.m_lnode, a);
    traction[a] += to_febio(vector_at(nodal_.friction.traction, node));
  }
}

void FEMixtureSurface::Serialize(DumpStream& ar) {
  // The stored data are output of the last accepted step, on which no step depends, or constants.
  if (ar.IsShallow()) return;
  FEBiphasicContactSurface::Serialize(ar);
  archive(ar, nodal_.gap);
  archive(ar, nodal_.pressure);
  archive(ar, nodal_.flux);
  archive(ar, nodal_.jump);
  archive(ar, nodal_.tributary_area);
  archive(ar, total_.force);
  archive(ar, total_.area);
  archive(ar, total_.flow);
  archive(ar, total_.friction);
  archive(ar, total_.dissipation);
  archive(ar, nodal_.friction.traction);
  archive(ar, nodal_.friction.slip);
  archive(ar, nodal_.friction.bound);
  archive(ar, nodal_.friction.fluid);
  archive(ar, nodal_.friction.status);
  archive(ar, nodal_.breaking.damage);
  archive(ar, nodal_.breaking.opening);
  archive(ar, nodal_.breaking.energy);
  archive(ar, nodal_.breaking.broken_at);
  archive(ar, total_.bonds.dissipated);
  archive(ar, total_.bonds.viscous);
  archive(ar, total_.bonds.stored);
  archive(ar, total_.bonds.broken_area);
  archive(ar, exchanged_);
  ar & has_shell_bottoms_;
}
