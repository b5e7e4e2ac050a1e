#include "interface/relocation.h"

namespace mixture_contact {

Matrix3Xd without_overlap(const ContactInterface& contact, const PerSide<Matrix3Xd>& position) {
  const IndexedVector<std::optional<SurfaceHit>> hits = hits_of_nodes(
      contact.mesh(Side::primary), contact.mesh(Side::secondary), seen_from(Side::primary, position),
      contact.settings());
  Matrix3Xd moved = position[Side::primary];
  const Matrix3Xd normals = nodal_normals(contact.mesh(Side::primary), moved);
  for (Index node = 0; node < moved.cols(); ++node) {
    const std::optional<SurfaceHit>& hit = hits[node];
    if (hit && hit->gap < 0) moved.col(node) += hit->gap * normals.col(node);
  }
  return moved;
}

}  // namespace mixture_contact
