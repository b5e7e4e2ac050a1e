#include "enforcement/past_linearisation.h"

#include "base/bytes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace mixture_contact {
namespace {

/// The largest absolute value; NaN if an entry is NaN.
double largest(const MatrixXd& values) {
  return values.size() == 0 ? 0 : values.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
}

/// The range of each field on both surfaces.
Eigen::RowVectorXd ranges(const SurfaceFields& primary, const SurfaceFields& secondary) {
  Eigen::RowVectorXd range(primary.scalar.cols());
  for (Index field = 0; field < range.size(); ++field) {
    const auto one = primary.scalar.col(field);
    const auto two = secondary.scalar.col(field);
    range[field] = std::max(one.maxCoeff(), two.maxCoeff()) - std::min(one.minCoeff(), two.minCoeff());
  }
  return range;
}

/// True if no value of a field (nodes, fields) has changed by more than `most`.
bool are_near(const MatrixXd& one, const MatrixXd& other, const Eigen::RowVectorXd& most) {
  for (Index field = 0; field < one.cols(); ++field) {
    if (!(largest(one.col(field) - other.col(field)) <= most[field])) return false;
  }
  return true;
}

bool have_same_fields(const LinearisationSource& one, const LinearisationSource& other, double same) {
  const Eigen::RowVectorXd most = same * ranges(other.primary, other.secondary);
  return are_near(one.primary.scalar, other.primary.scalar, most) &&
         are_near(one.secondary.scalar, other.secondary.scalar, most);
}

bool have_same_points(const LinearisationSource& one, const LinearisationSource& other) {
  return one.pairs == other.pairs && one.sub_facets == other.sub_facets;
}

double largest_motion(const Matrix3Xd& from, const Matrix3Xd& to) { return largest((to - from).colwise().norm()); }

double shortest_edge(const Facet& facet, const Matrix3Xd& x) {
  const int corners = corner_count(facet.type);
  double shortest = std::numeric_limits<double>::infinity();
  for (int a = 0; a < corners; ++a) {
    const Vector3d edge = x.col(facet.node((a + 1) % corners)) - x.col(facet.node(a));
    shortest = std::min(shortest, edge.norm());
  }
  return shortest;
}

/// The shortest edge of all facets that face each other.
double shortest_edge(const FacingPairs& facing, const LinearisationSource& at) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const FacetPair& pair : facing.pairs()) {
    shortest = std::min({shortest, shortest_edge(facing.primary_facet(pair), at.primary.position),
                         shortest_edge(facing.secondary_facet(pair), at.secondary.position)});
  }
  return shortest;
}

/// True if the surfaces have not moved by more than the fraction `same` of their facets' shortest edge.
bool are_in_same_place(const LinearisationSource& one, const LinearisationSource& other, const FacingPairs& facing,
                       double same) {
  const double motion = largest_motion(one.primary.position, other.primary.position) +
                        largest_motion(one.secondary.position, other.secondary.position);
  return motion <= same * shortest_edge(facing, other);
}

/// Flags the nodes whose loads (nodes, fields) differ by more than the fraction `same` of the largest load.
void flag_other_loads(NodeFlags& flags, const MatrixXd& one, const MatrixXd& other, double same) {
  for (Index field = 0; field < one.cols(); ++field) {
    const double most = same * largest(other.col(field));
    for (Index node = 0; node < one.rows(); ++node) {
      if (!(std::abs(one(node, field) - other(node, field)) <= most)) flags[node] = true;
    }
  }
}

/// Flags the nodes whose contact status differs.
void flag_other_status(NodeFlags& flags, const ContactStatus& one, const ContactStatus& other) {
  for (Index node = 0; node < flags.count(); ++node) {
    if (one.in_contact[node] != other.in_contact[node] || one.flux_coupled[node] != other.flux_coupled[node])
      flags[node] = true;
  }
}

/// Flags the nodes of facets whose points have different weights.
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

/// The largest ratio of a penalty to its stiffness or conductance; entries without a penalty do not count.
double largest_ratio(const MatrixXd& penalties, const MatrixXd& measure) {
  return penalties.size() == 0 ? 0 : (penalties.array() > 0).select(penalties.cwiseQuotient(measure), 0.0).maxCoeff();
}

std::size_t bytes_of(const TangentBlock& block) {
  return bytes(block.rows) + bytes(block.columns) + bytes(block.values);
}

std::size_t bytes_of(const GeometricTangent& tangent) {
  std::size_t sum = bytes(tangent.fluxes) + bytes_of(tangent.traction.block);
  for (const FluxTangent& flux : tangent.fluxes) sum += bytes_of(flux.block);
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

std::size_t bytes_of(const LinearisationSource& source) {
  return bytes(source.pairs) + bytes(source.sub_facets) + bytes(source.carriers) + source.primary.memory() +
         source.secondary.memory() + bytes(source.traction) + bytes(source.flux);
}

}  // namespace

double same_to_linearisation(const NodalLaws& laws) {
  constexpr double most = 1e-3;
  constexpr double most_left = 0.1;
  const Penalties& penalties = laws.penalties();
  const double ratio = std::max(
      laws.multipliers.traction_penalty_scale * largest_ratio(penalties.traction, penalties.stiffness),
      largest_ratio(laws.multipliers.flux_penalty_scale.asDiagonal() * penalties.flux, penalties.conductance));
  return std::min(most, std::sqrt(most_left / ratio));
}

LinearisationSource::LinearisationSource(const LinearisationPoint& point, const MortarSpace& space)
    : carriers(space.boundary_weights().last_decisions()),
      primary(point.primary),
      secondary(point.secondary),
      status(point.loads.status()),
      traction(point.geometric_traction),
      flux(point.geometric_flux) {
  pairs.reserve(space.facing().pairs().size());
  sub_facets.reserve(indexing::entries(point_count(space.facing())));
  for (const FacetPair& pair : space.facing().pairs()) {
    pairs.push_back({pair.primary, pair.secondary, pair.points});
    for (const IntegrationPoint& integration_point : space.facing().points(pair))
      sub_facets.push_back(integration_point.sub_facet);
  }
}

void LinearisationSource::replace_at(const NodeFlags& nodes, const LinearisationSource& by) {
  carriers = by.carriers;
  status = by.status;
  for (Index node = 0; node < nodes.count(); ++node) {
    if (!nodes[node]) continue;
    traction[node] = by.traction[node];
    flux.col(node) = by.flux.col(node);
  }
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

NodeFlags changed_nodes(const PastLinearisation& past, const LinearisationSource& now, const MortarSpace& space,
                        double same) {
  const LinearisationSource& source = past.geometric.source;
  const bool may_serve = past.point.is_linearised() && have_same_points(source, now) &&
                         have_same_fields(source, now, same) && are_in_same_place(source, now, space.facing(), same);
  NodeFlags changed(space.nodes(), !may_serve);
  if (!may_serve) return changed;
  flag_other_status(changed, source.status, now.status);
  flag_other_loads(changed, source.traction, now.traction, same);
  flag_other_loads(changed, source.flux.transpose(), now.flux.transpose(), same);
  flag_other_weights(changed, source.carriers, now.carriers, space.facing().primary().facets);
  return changed;
}

}  // namespace mixture_contact
