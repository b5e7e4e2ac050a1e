#include "rigid_shell_bottoms.h"

#include <FEBioMech/FEMechModel.h>
#include <FEBioMech/FERigidBody.h>

using mixture_contact::both_sides;

RigidShellBottoms::RigidShellBottoms(ContactSurfaces& surfaces) {
  for (const auto side : both_sides) {
    FEMixtureSurface& surface = surfaces[side];
    auto* const mechanics = dynamic_cast<FEMechModel*>(surface.GetFEModel());
    if (!surface.has_shell_bottoms() || mechanics == nullptr) continue;
    for (int i = 0; i < surface.Nodes(); ++i) {
      FENode& node = surface.Node(i);
      if (node.m_rid >= 0) move_to_back(node, *mechanics->GetRigidBody(node.m_rid));
    }
  }
}

RigidShellBottoms::~RigidShellBottoms() {
  for (const Moved& moved : moved_) {
    moved.node->m_rt = moved.present;
    moved.node->m_rp = moved.past;
  }
}

void RigidShellBottoms::move_to_back(FENode& node, const FERigidBody& body) {
  moved_.push_back({&node, node.m_rt, node.m_rp});
  node.m_rt -= body.GetRotation() * node.m_d0;
  node.m_rp -= body.GetPreviousRotation() * node.m_d0;
}
