#include "enforcement/past_linearisation.h"

#include "base/bytes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mixture_contact {
namespace {

/// The largest of the amounts, which is no number where one of them is none.
double largest(const MatrixXd& values) {
  return values.size() == 0 ? 0 : values.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
}

/// Whether values per node (nodes, fields) differ by next to nothing.
bool are_same(const MatrixXd& one, const MatrixXd& other) {
  for (Index field = 0; field < one.cols(); ++field) {
    const double least = same_to_linearisation * largest(other.col(field));
    if (!(largest(one.col(field) - other.col(field)) <= least)) return false;
  }
  return true;
}

/// Flags the nodes whose loads (nodes, fields) differ.
void flag_other_loads(NodeFlags& flags, const MatrixXd& one, const MatrixXd& other) {
  for (Index field = 0; field < one.cols(); ++field) {
    const double least = same_to_linearisation * largest(other.col(field));
    for (Index node = 0; node < one.rows(); ++node) {
      if (!(std::abs(one(node, field) - other(node, field)) <= least)) flags[node] = true;
    }
  }
}

/// Flags the nodes of facets whose points are weighted otherwise.
void flag_other_weights(NodeFlags& flags, const LoadCarriers& one, const LoadCarriers& other,
                        const IndexedVector<Facet>& facets) {
  const auto carriers = [](const LoadCarriers& of, Index facet) { return of.empty() ? FacetVector() : of[facet]; };
  for (Index facet = 0; facet < facets.count(); ++facet) {
    const FacetVector before = carriers(one, facet);
    const FacetVector now = carriers(other, facet);
    if (before.size() == now.size() && before == now) continue;
    for (const int node : facets[facet]) flags[node] = true;
  }
}

/// Whether two are of the same points, and of the same values of fields.
bool have_same_points(const LinearisationSource& one, const LinearisationSource& other) {
  return one.pairs == other.pairs && are_same(one.primary.scalar, other.primary.scalar) &&
         are_same(one.secondary.scalar, other.secondary.scalar);
}

/// How far nodes have moved at most.
double largest_motion(const LinearisationSource& from, const LinearisationSource& to) {
  return largest(Vector2d(largest(to.primary.position - from.primary.position),
                          largest(to.secondary.position - from.secondary.position)));
}

/// Flags the nodes of another status, and those with facets so small that a motion is not.
void flag_other_status(NodeFlags& flags, const NodalLoads& before, const NodalLoads& now, double motion) {
  for (Index node = 0; node < flags.count(); ++node) {
    const bool has_moved = !(motion <= same_to_linearisation * std::sqrt(now.area[node]));
    const bool has_same_status = before.in_contact[node] == now.in_contact[node] &&
                                 before.flux_coupled[node] == now.flux_coupled[node];
    if (has_moved || !has_same_status) flags[node] = true;
  }
}

std::size_t bytes_of(const TangentBlock& block) {
  return bytes(block.rows) + bytes(block.columns) + bytes(block.values);
}

std::size_t bytes_of(const GeometricTangent& tangent) {
  std::size_t sum = bytes(tangent.fluxes) + bytes_of(tangent.traction);
  for (const TangentBlock& flux : tangent.fluxes) sum += bytes_of(flux);
  return sum;
}

std::size_t bytes_of(const NodeRows& rows) {
  std::size_t sum = bytes(rows);
  for (const TangentBlock& row : rows) sum += bytes_of(row);
  return sum;
}

std::size_t bytes_of(const IndexedVector<NodeRows>& fields) {
  std::size_t sum = bytes(fields);
  for (const NodeRows& rows : fields) sum += bytes_of(rows);
  return sum;
}

std::size_t bytes_of(const GeometricParts& pairs) {
  std::size_t sum = bytes(pairs);
  for (const std::optional<GeometricTangent>& tangent : pairs) sum += tangent ? bytes_of(*tangent) : 0;
  return sum;
}

std::size_t bytes_of(const SurfaceFields& fields) { return bytes(fields.position) + bytes(fields.scalar); }

std::size_t bytes_of(const LinearisationSource& source) {
  return bytes(source.pairs) + bytes(source.carriers) + bytes_of(source.primary) + bytes_of(source.secondary) +
         bytes(source.traction) + bytes(source.flux);
}

}  // namespace

LinearisationSource::LinearisationSource(const LinearisationPoint& point, const MortarSpace& space)
    : carriers(space.boundary_weights().last_decisions()),
      primary(point.primary),
      secondary(point.secondary),
      traction(point.geometric_traction),
      flux(point.geometric_flux) {
  pairs.reserve(space.facing().pairs().size());
  for (const FacetPair& pair : space.facing().pairs())
    pairs.push_back({pair.primary, pair.secondary, count_of(pair.points)});
}

LinearisationSource LinearisationSource::replaced_at(const NodeFlags& nodes, const LinearisationSource& by) const {
  LinearisationSource both = *this;
  both.carriers = by.carriers;
  for (Index node = 0; node < nodes.count(); ++node) {
    if (!nodes[node]) continue;
    both.traction[node] = by.traction[node];
    both.flux.col(node) = by.flux.col(node);
  }
  return both;
}

std::size_t GeometricPart::memory() const {
  return bytes_of(pairs) + bytes_of(tractions) + bytes_of(fluxes) + bytes_of(source);
}

void LastLinearisation::take_over(std::optional<GeometricPart>& held) {
  if (held) geometric_ = std::exchange(held, std::nullopt);
}

void LastLinearisation::take_over(std::optional<LinearisationPoint>& held) {
  if (held) point_ = std::exchange(held, std::nullopt);
}

std::optional<PastLinearisation> LastLinearisation::take() {
  std::optional<GeometricPart> geometric = std::exchange(geometric_, std::nullopt);
  std::optional<LinearisationPoint> point = std::exchange(point_, std::nullopt);
  if (!geometric || !point) return std::nullopt;
  return PastLinearisation{std::move(*point), std::move(*geometric)};
}

std::size_t LastLinearisation::memory() const {
  return (geometric_ ? geometric_->memory() : 0) + (point_ ? point_->memory() : 0);
}

NodeFlags changed_nodes(const PastLinearisation& past, const LinearisationPoint& next, const LinearisationSource& now,
                        const IndexedVector<Facet>& facets) {
  const LinearisationSource& source = past.geometric.source;
  const bool may_serve = past.point.is_linearised() && next.loads.friction.empty() && have_same_points(source, now);
  NodeFlags changed(next.loads.in_contact.count(), !may_serve);
  if (!may_serve) return changed;
  flag_other_status(changed, past.point.loads, next.loads, largest_motion(source, now));
  flag_other_loads(changed, source.traction, now.traction);
  flag_other_loads(changed, source.flux.transpose(), now.flux.transpose());
  flag_other_weights(changed, source.carriers, now.carriers, facets);
  return changed;
}

}  // namespace mixture_contact
