/// Relocation of surface nodes that overlap before the first step.
#pragma once

#include "interface/interface.h"

namespace mixture_contact {

/// The positions of the primary nodes after those that overlap the secondary surface have been moved onto it along
/// their normals.
Matrix3Xd without_overlap(const ContactInterface& contact, const PerSide<Matrix3Xd>& position);

}  // namespace mixture_contact
