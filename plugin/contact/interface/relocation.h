/// Relocation of the nodes of a mesh whose surfaces overlap before the first step.
#pragma once

#include "interface/interface.h"

namespace mixture_contact {

/// Positions of the primary nodes with those that overlap the secondary surface moved onto it along their normals.
Matrix3Xd without_overlap(const ContactInterface& contact, const PerSide<Matrix3Xd>& position);

}  // namespace mixture_contact
