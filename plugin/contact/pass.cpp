#include "pass.h"

#include "quadrature.h"
#include <algorithm>
#include <cmath>

namespace mixture_contact {
namespace {

/// Curved facets bulge out of the box of their nodes by less than this part of its diagonal.
constexpr double box_margin = 0.1;
/// Surfaces closer than this part of their size touch to rounding.
constexpr double touch_fraction = 1e-10;
constexpr int nothing_seen = -1;
constexpr double least_share = 1e-6;

}  // namespace

ContactPass::ContactPass(const SurfaceMesh& primary, const SurfaceMesh& secondary, const Effects& effects,
                         const Settings& settings)
    : primary_(primary),
      secondary_(secondary),
      effects_(effects),
      settings_(settings),
      penalties_(penalties(primary, secondary, effects, settings)) {
  for (std::size_t f = 0; f < primary.facets.size(); ++f) {
    const FacetType type = primary.facets[f].type;
    const int order = settings.integration_order > 0 ? settings.integration_order : default_quadrature_order(type);
    for (const QuadraturePoint& q : quadrature(type, order)) {
      points_.push_back({static_cast<int>(f), q.weight, shape_functions(type, q.xi)});
    }
  }
  multipliers.traction.setZero(points());
  multipliers.flux.setZero(effects.scalar_fields(), points());
  multipliers.flux_growth.setOnes(effects.scalar_fields());
}

void ContactPass::update_penalties() { penalties_ = penalties(primary_, secondary_, effects_, settings_); }

void ContactPass::project(const Matrix3Xd& x1, const Matrix3Xd& x2, double radius) {
  pairs_.clear();
  seen_.assign(points_.size(), nothing_seen);
  touch_ = touch_fraction * half_diagonal(x1);
  const FacetTree tree(secondary_.facets, x2, box_margin);
  for (std::size_t q = 0; q < points_.size(); ++q) {
    const std::optional<SurfaceHit> hit = nearest_facing(tree, secondary_.facets, x2, ray(q, x1, radius));
    if (!hit) continue;
    seen_[q] = hit->facet;
    pairs_.push_back({static_cast<int>(q), points_[q].facet, hit->facet, hit->eta});
  }
}

void ContactPass::project_on_same_facets(const Matrix3Xd& x1, const Matrix3Xd& x2) {
  pairs_.clear();
  for (std::size_t q = 0; q < seen_.size(); ++q) {
    if (seen_[q] == nothing_seen) continue;
    const Facet& facet = secondary_.facets[static_cast<std::size_t>(seen_[q])];
    const Ray from = ray(q, x1, 0);
    const auto hit = intersect(facet.type, facet_coordinates(facet, x2), from.origin, from.direction, from.tolerance);
    if (hit) pairs_.push_back({static_cast<int>(q), points_[q].facet, seen_[q], hit->eta});
  }
}

Ray ContactPass::ray(std::size_t point, const Matrix3Xd& x1, double radius) const {
  const ShapeFunctions& shape = points_[point].shape;
  const FacetCoordinates x = facet_coordinates(primary_.facets[static_cast<std::size_t>(points_[point].facet)], x1);
  const Eigen::Matrix<double, 3, 2> tangents = x * shape.gradient;
  return {x * shape.value, tangents.col(0).cross(tangents.col(1)).normalized(), radius, settings_.search_tolerance};
}

PointKinematics ContactPass::kinematics(const PointPair& pair, const Matrix3Xd& x1, const Matrix3Xd& x2) const {
  const Facet& one = primary_.facets[static_cast<std::size_t>(pair.primary_facet)];
  const Facet& two = secondary_.facets[static_cast<std::size_t>(pair.secondary_facet)];
  return point_kinematics(points_[static_cast<std::size_t>(pair.point)].shape, facet_coordinates(one, x1),
                          shape_functions(two.type, pair.eta), facet_coordinates(two, x2));
}

LawValue ContactPass::traction(const PointPair& pair, double gap) const {
  const double penalty = multipliers.traction_growth * penalties_.traction[pair.primary_facet];
  return normal_traction(multipliers.traction[pair.point], penalty, gap, touch_);
}

std::vector<int> ContactPass::exchanged_fields(const PointPair& pair) const {
  const FieldMask both = primary_.permeable[static_cast<std::size_t>(pair.primary_facet)] &
                         secondary_.permeable[static_cast<std::size_t>(pair.secondary_facet)];
  std::vector<int> fields;
  for (int k = 0; k < effects_.scalar_fields(); ++k) {
    if (contains(both, k)) fields.push_back(k);
  }
  return fields;
}

PointContact ContactPass::contact(const PointPair& pair, const PointKinematics& point, const LawValue& traction,
                                  const SurfaceFields& primary, const SurfaceFields& secondary, double dt) const {
  PointContact contact;
  contact.pair = &pair;
  contact.kinematics = point;
  contact.fields = exchanged_fields(pair);
  const auto fields = static_cast<Index>(contact.fields.size());
  contact.values.resize(point.nodes(), fields);
  contact.loads.traction = traction;
  contact.loads.weight = points_[static_cast<std::size_t>(pair.point)].weight;
  contact.loads.time_increment = dt;
  contact.loads.flux.resize(fields);
  const PairVector h = point.jump_weights();
  for (Index k = 0; k < fields; ++k) {
    const int field = contact.fields[static_cast<std::size_t>(k)];
    contact.values.col(k) << facet_values(primary_.facets[static_cast<std::size_t>(pair.primary_facet)], primary.scalar.col(field)),
        facet_values(secondary_.facets[static_cast<std::size_t>(pair.secondary_facet)], secondary.scalar.col(field));
    const double penalty = multipliers.flux_growth[field] * penalties_.flux(field, pair.primary_facet);
    contact.loads.flux[k] = normal_flux(multipliers.flux(field, pair.point), penalty, h.dot(contact.values.col(k)));
  }
  return contact;
}

void ContactPass::for_each_contact(const SurfaceFields& primary, const SurfaceFields& secondary, double dt,
                                   const std::function<void(const PointContact&)>& use) const {
  for (const PointPair& pair : pairs_) {
    const PointKinematics point = kinematics(pair, primary.position, secondary.position);
    const LawValue load = traction(pair, point.gap);
    if (load.derivative > 0) use(contact(pair, point, load, primary, secondary, dt));
  }
}

FacetPair ContactPass::facet_pair(const PointPair& pair, const std::vector<int>& fields) const {
  const Facet& one = primary_.facets[static_cast<std::size_t>(pair.primary_facet)];
  const Facet& two = secondary_.facets[static_cast<std::size_t>(pair.secondary_facet)];
  return {one, two, fields, LocalLayout(node_count(one.type), node_count(two.type), static_cast<Index>(fields.size()))};
}

template <class Local, class Evaluate, class Add>
void ContactPass::gather_by_facet_pair(const SurfaceFields& primary, const SurfaceFields& secondary, double dt,
                                       const Evaluate& evaluate, const Add& add) const {
  // Points come facet by facet; those of one primary facet that see the same secondary facet are added up first.
  struct Sum {
    PointPair pair;
    std::vector<int> fields;
    Local local;
  };
  std::vector<Sum> sums;
  const auto flush = [&] {
    for (const Sum& sum : sums) add(facet_pair(sum.pair, sum.fields), sum.local);
    sums.clear();
  };
  for_each_contact(primary, secondary, dt, [&](const PointContact& contact) {
    if (!sums.empty() && sums.front().pair.primary_facet != contact.pair->primary_facet) flush();
    const Local local = evaluate(contact, facet_pair(*contact.pair, contact.fields).layout);
    const auto same = std::find_if(sums.begin(), sums.end(), [&](const Sum& sum) {
      return sum.pair.secondary_facet == contact.pair->secondary_facet;
    });
    if (same == sums.end()) {
      sums.push_back({*contact.pair, contact.fields, local});
    } else {
      same->local += local;
    }
  });
  flush();
}

void ContactPass::residual(const SurfaceFields& primary, const SurfaceFields& secondary, double dt,
                           const std::function<void(const FacetPair&, const VectorXd&)>& add) const {
  const auto evaluate = [](const PointContact& contact, const LocalLayout& layout) {
    return point_residual(contact.kinematics, contact.loads, layout);
  };
  gather_by_facet_pair<VectorXd>(primary, secondary, dt, evaluate, add);
}

void ContactPass::tangent(const SurfaceFields& primary, const SurfaceFields& secondary, double dt,
                          const std::function<void(const FacetPair&, const MatrixXd&)>& add) const {
  const auto evaluate = [this](const PointContact& contact, const LocalLayout& layout) {
    const MatrixXd full = point_tangent(contact.kinematics, contact.loads, contact.values, layout);
    return settings_.symmetric ? symmetric_part(full, layout) : full;
  };
  gather_by_facet_pair<MatrixXd>(primary, secondary, dt, evaluate, add);
}

void ContactPass::for_each_facet_pair(const std::function<void(const FacetPair&)>& use) const {
  std::vector<int> seen;
  int facet = -1;
  for (const PointPair& pair : pairs_) {
    if (pair.primary_facet != facet) seen.clear();
    facet = pair.primary_facet;
    if (std::find(seen.begin(), seen.end(), pair.secondary_facet) != seen.end()) continue;
    seen.push_back(pair.secondary_facet);
    const std::vector<int> fields = exchanged_fields(pair);
    use(facet_pair(pair, fields));
  }
}

VectorXd ContactPass::coverage(const Matrix3Xd& x1, const Matrix3Xd& x2) const {
  std::vector<bool> in_contact(points_.size(), false);
  for (const PointPair& pair : pairs_) {
    in_contact[static_cast<std::size_t>(pair.point)] = traction(pair, kinematics(pair, x1, x2).gap).derivative > 0;
  }
  VectorXd coverage = VectorXd::Zero(primary_.nodes);
  for (std::size_t q = 0; q < points_.size();) {
    const Facet& facet = primary_.facets[static_cast<std::size_t>(points_[q].facet)];
    FacetVector total = FacetVector::Zero(node_count(facet.type));
    FacetVector covered = total;
    for (const int index = points_[q].facet; q < points_.size() && points_[q].facet == index; ++q) {
      // The least share lets points count where a shape function vanishes at all of them.
      const FacetVector share = points_[q].weight * points_[q].shape.value.cwiseAbs().cwiseMax(least_share);
      total += share;
      if (in_contact[q]) covered += share;
    }
    for (Index a = 0; a < total.size(); ++a) {
      double& node = coverage[facet.nodes[static_cast<std::size_t>(a)]];
      node = std::max(node, covered[a] / total[a]);
    }
  }
  return coverage;
}

}  // namespace mixture_contact
