#include "contact_surfaces.h"

#include "contact/base/parallel.h"
#include "host/facet_material.h"

#include <FECore/FEMesh.h>
#include <FECore/FEModel.h>
#include <FECore/FESolidDomain.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

using namespace mixture_contact;

namespace {

/// The nodes of each facet, ascending.
std::set<std::vector<int>> facet_nodes(const FESurface& surface) {
  std::set<std::vector<int>> facets;
  for (int i = 0; i < surface.Elements(); ++i) {
    std::vector<int> nodes = surface.Element(i).m_node;
    std::sort(nodes.begin(), nodes.end());
    facets.insert(nodes);
  }
  return facets;
}

}  // namespace

ContactSurfaces::ContactSurfaces(FEModel& fem, FEContactInterface& contact) : primary_(&fem), secondary_(&fem) {
  primary_.SetSibling(&secondary_);
  secondary_.SetSibling(&primary_);
  primary_.SetContactInterface(&contact);
  secondary_.SetContactInterface(&contact);
}

bool ContactSurfaces::init(const ContactParameters& parameters) {
  if (!primary_.Init() || !secondary_.Init()) return false;
  for (const Side side : both_sides) {
    if (parameters.surfaces[side].flip) (*this)[side].turn_round();
  }
  return true;
}

PerSide<std::string> ContactSurfaces::names() const { return {{primary_.GetName(), secondary_.GetName()}}; }

int ContactSurfaces::common_facets() const {
  const auto one = facet_nodes(primary_);
  const auto two = facet_nodes(secondary_);
  int count = 0;
  for (const auto& facet : one) count += two.count(facet) > 0 ? 1 : 0;
  return count;
}

NodeNumbers ContactSurfaces::node_numbers() const {
  NodeNumbers numbers;
  for (const Side side : both_sides) {
    const FEMixtureSurface& surface = (*this)[side];
    for (int node = 0; node < surface.Nodes(); ++node) numbers[side].push_back(surface.NodeIndex(node));
  }
  return numbers;
}

bool ContactSurfaces::take_change() {
  const bool primary = primary_.take_change();
  return secondary_.take_change() || primary;
}

const FEMixtureSurface* ContactSurfaces::without_facets() const {
  if (primary_.Elements() == 0) return &primary_;
  return secondary_.Elements() == 0 ? &secondary_ : nullptr;
}

PerSide<Matrix3Xd> ContactSurfaces::positions() {
  PerSide<Matrix3Xd> all;
  for (const Side side : both_sides) {
    FEMixtureSurface& surface = (*this)[side];
    all[side].resize(3, surface.Nodes());
    in_parallel(surface.Nodes(), [&](Index node) {
      const vec3d r = surface.position(indexing::as_int(node));
      all[side].col(node) << r.x, r.y, r.z;
    });
  }
  return all;
}

void ContactSurfaces::relocate_primary(const Matrix3Xd& positions) {
  for (int i = 0; i < primary_.Nodes(); ++i) {
    FENode& node = primary_.Node(i);
    node.m_rt = vec3d(positions(0, i), positions(1, i), positions(2, i));
    node.m_r0 = node.m_rt;
  }
  // Elements store the Jacobians of the reference configuration. FEBio computes these only at the start, so they are
  // computed again here.
  FEMesh& mesh = primary_.GetFEModel()->GetMesh();
  for (int i = 0; i < mesh.Domains(); ++i) {
    auto* domain = dynamic_cast<FESolidDomain*>(&mesh.Domain(i));
    if (domain != nullptr) domain->FESolidDomain::Init();
  }
}

void ContactSurfaces::store_output(const InterfaceOutput& out, const Effects& effects) {
  const std::vector<int> exchanged = exchanged_solutes(effects);
  Balance total = out.balance;
  primary_.store_output(out.nodes[Side::primary], total, exchanged);
  total.force = -total.force;
  total.friction = -total.friction;
  total.flow = -total.flow;
  secondary_.store_output(out.nodes[Side::secondary], total, exchanged);
}
