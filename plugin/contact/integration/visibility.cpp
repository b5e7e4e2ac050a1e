#include "integration/visibility.h"

#include "integration/facing_share.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace mixture_contact {
namespace {

/// A facet within this fraction of the surface's size from an end of the segment counts as being at the end.
constexpr double at_end = 1e-9;
/// Tolerance outside a facet within which a segment meets it, in parametric coordinates: a segment through the edge of
/// two facets meets both.
constexpr double seam = 1e-6;
/// Overlaps up to this fraction of the elements' thickness always count.
constexpr double shallow_part = 0.5;
/// The largest overlap that counts, as a fraction of the thickness of the thinner body. Facets of bodies that are side
/// by side appear to overlap by at least the whole thickness.
constexpr double deepest_part = 0.75;
constexpr double unlimited = std::numeric_limits<double>::infinity();

}  // namespace

Visibility::Visibility(const SurfaceMesh& primary, const SurfaceMesh& secondary) {
  if (primary.may_meet_itself()) return;
  screens_.emplace_back(primary);
  screens_.emplace_back(secondary);
}

void Visibility::move_to(const Matrix3Xd& x1, const Matrix3Xd& x2) {
  if (screens_.empty()) return;
  screens_.front().moving.move_to(screens_.front().mesh.facets, x1);
  screens_.back().moving.move_to(screens_.back().mesh.facets, x2);
  for (Screen& screen : screens_) screen.size = 2 * half_diagonal(screen.moving.positions());
}

double Visibility::element_thickness(const Screen& screen, int facet) {
  const VectorXd& thickness = screen.mesh.thickness;
  return facet == node || thickness.size() == 0 ? 0 : thickness[facet];
}

double Visibility::first_met(const Screen& screen, const Way& way, double sense, int but) {
  double first = unlimited;
  for (const int index : screen.moving.met(way.from, way.direction, way.length)) {
    if (index == but) continue;
    const Facet& facet = screen.mesh.facets[index];
    const FacetCoordinates x = facet_coordinates(facet, screen.moving.positions());
    if (sense * middle_normal(facet.type, x).dot(way.direction) < least_opposition) continue;
    const auto hit = intersect(facet.type, x, way.from, way.direction, seam);
    const double end = at_end * screen.size;
    if (hit && hit->gap > end && hit->gap < way.length - end) first = std::min(first, hit->gap);
  }
  return first;
}

double Visibility::deepest_overlap(const Vector3d& point, const Vector3d& normal, double gap, int own,
                                   int other) const {
  const Screen& one = screens_.front();
  const Screen& two = screens_.back();
  const double first = first_met(one, {point, -normal, one.size}, 1, own);
  const double second = first_met(two, {point + gap * normal, normal, two.size}, 1, other);
  return deepest_part * std::min(first, second);
}

bool Visibility::is_hidden(const Vector3d& point, const Vector3d& normal, double gap, int own, int other) const {
  if (screens_.empty()) return false;
  const Screen& one = screens_.front();
  const Screen& two = screens_.back();
  if (gap > 0) {
    const Way ahead{point, normal, gap};
    return !std::isinf(first_met(one, ahead, -1, own)) || !std::isinf(first_met(two, ahead, 1, other));
  }
  if (-gap <= shallow_part * std::min(element_thickness(one, own), element_thickness(two, other))) return false;
  return -gap > deepest_overlap(point, normal, gap, own, other);
}

std::size_t Visibility::memory() const {
  std::size_t sum = 0;
  for (const Screen& screen : screens_) sum += screen.moving.memory();
  return sum;
}

}  // namespace mixture_contact
