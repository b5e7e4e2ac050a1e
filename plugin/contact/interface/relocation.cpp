#include "interface/relocation.h"

#include "integration/search.h"

namespace mixture_contact {

Matrix3Xd without_overlap(const ContactInterface& contact, const PerSide<Matrix3Xd>& position) {
  const Reach reach = reach_of(contact.settings(), position);
  const IndexedVector<Facet>& facets = contact.mesh(Side::secondary).facets;
  const Matrix3Xd& x2 = position[Side::secondary];
  const FacetTree tree(facets, x2, box_margin);
  Matrix3Xd moved = position[Side::primary];
  const Matrix3Xd normals = nodal_normals(contact.mesh(Side::primary), moved);
  for (Index node = 0; node < moved.cols(); ++node) {
    const Ray ray{moved.col(node), normals.col(node), reach.distance, reach.tolerance};
    const std::optional<SurfaceHit> hit = nearest_facing_or_passed(tree, facets, x2, ray);
    if (hit && hit->gap < 0) moved.col(node) += hit->gap * normals.col(node);
  }
  return moved;
}

}  // namespace mixture_contact
