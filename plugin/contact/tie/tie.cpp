#include "tie/tie.h"

#include "base/in_order.h"
#include "conditions/bonded.h"
#include "conditions/law_value.h"
#include "tie/gap_vector.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mixture_contact {
namespace {

/// The stiffness of the diagonal entry of an unknown multiplier, over the stiffness of the adjoining elements. The
/// entry -1/penalty makes the matrix quasi-definite: redundant conditions, where several ties or prescribed values
/// meet, do not make it singular. Each iteration reduces the gap by this factor, and the solution meets D = 0.
constexpr double unknown_factor = 1e8;

/// Values of a field at the nodes of a tied node, primary nodes first.
VectorXd values_at(const TiedNode& tied, const PerSide<SurfaceFields>& fields, Index field) {
  VectorXd values(tied.count());
  Index n = 0;
  for (const int node : tied.primary) values[n++] = fields[Side::primary].scalar(node, field);
  for (const int node : tied.secondary) values[n++] = fields[Side::secondary].scalar(node, field);
  return values;
}

/// The value of a node. If it is zero (impermeable facets around the node), the largest value of the surface, or one.
double unit_of(const Eigen::Ref<const VectorXd>& values, int node) {
  if (values[node] > 0) return values[node];
  const double largest = values.maxCoeff();
  return largest > 0 ? largest : 1.0;
}

double traction_unit(const Penalties& penalties, int node) { return unit_of(penalties.stiffness, node); }

double flux_unit(const Penalties& penalties, int field, int node) {
  return unit_of(penalties.conductance.row(field).transpose(), node);
}

FacingPositions positions_of(const PerSide<SurfaceFields>& fields) {
  return {fields[Side::primary].position, fields[Side::secondary].position};
}

BondLoad bond(const Tie& tie, Index n, const Vector3d& gap, const FacingPositions& x) {
  return bond_load(std::get<Cohesive>(tie.breaking()), tie.traction_penalty(n), tie.state().damage.damage[n], gap,
                   normal_of(tie.nodes()[n], x));
}

/// The derivative of a bond's loads with respect to its gap vector and its normal.
BondHessian bond_tangent(const Tie& tie, Index n, const FacingPositions& x, const TieLoads& loads,
                         const Softening& softening) {
  const Vector3d gap = loads.gap.col(n);
  const double damage = loads.damage[n];
  const bool grows = damage > tie.state().damage.damage[n] && damage < 1;
  const BondLoad load = bond(tie, n, gap, x);
  if (!grows || softening.part == 1) return load.derivative;
  const BondHessian stiff = derivative_at(softening.without, tie.traction_penalty(n), damage, gap,
                                          normal_of(tie.nodes()[n], x));
  const BondHessian softer = load.derivative - stiff;
  // A viscosity may stiffen a bond.
  const bool softens = gap.dot(softer.topLeftCorner<3, 3>() * gap) < 0;
  return softens ? stiff + softening.part * softer : load.derivative;
}

VectorXd traction_residual(const Tie& tie, Index n, const FacingPositions& x, const TieLoads& loads) {
  const TiedNode& tied = tie.nodes()[n];
  const LocalLayout layout = tie.patch(n).layout();
  const double area = tied.traction.area;
  VectorXd residual(layout.size());
  residual.head(3 * layout.nodes()) = -area * gap_variation(tied, x).transpose() * loads.traction.col(n);
  if (loads.turning.cols() > 0)
    residual.head(3 * layout.nodes()) -= area * normal_variation(tied, x).transpose() * loads.turning.col(n);
  if (!layout.has_multipliers()) return residual;
  if (tie.state().damage.is_broken(n)) {
    residual.tail<3>() = area * tie.state().traction.col(n);
  } else {
    residual.tail<3>() = -area * traction_unit(tie.penalties(), tied.node) * loads.gap.col(n);
  }
  return residual;
}

/// The second derivative of a node's energy per area with respect to the nodal positions.
MatrixXd stiffness(const Tie& tie, Index n, const FacingPositions& x, const TieLoads& loads,
                   const Softening& softening) {
  const TiedNode& tied = tie.nodes()[n];
  const Matrix3Xd variation = gap_variation(tied, x);
  MatrixXd stiffness;
  if (loads.turning.cols() > 0) {
    MatrixXd both(6, variation.cols());
    both << variation, normal_variation(tied, x);
    stiffness.noalias() = both.transpose() * bond_tangent(tie, n, x, loads, softening) * both;
    stiffness += normal_hessian(tied, x, loads.turning.col(n));
  } else {
    stiffness.noalias() = tie.traction_penalty(n) * variation.transpose() * variation;
  }
  if (!tied.gaps.empty()) stiffness += gap_hessian(tied, x, loads.traction.col(n));
  return stiffness;
}

/// True if an augmentation has left more than a quarter of an error.
bool is_slow(const FieldGap& last, const FieldGap& now) { return now.relative > 0.25 * last.relative; }

/// Removes nodes that do not affect the loads, and finds the facets whose normal the law requires.
void prepare(IndexedVector<TiedNode>& nodes, const Unbreakable& /*law*/, const PerSide<SurfaceMesh>& /*mesh*/) {
  remove_uncoupled(nodes);
}

void prepare(IndexedVector<TiedNode>& nodes, const Brittle& /*law*/, const PerSide<SurfaceMesh>& mesh) {
  remove_uncoupled(nodes);
  find_faced_normals(nodes, mesh[Side::secondary]);
}

/// The loads of cohesive bonds depend on all nodes of the facets around them, because they turn with the normal.
void prepare(IndexedVector<TiedNode>& nodes, const Cohesive& /*law*/, const PerSide<SurfaceMesh>& mesh) {
  find_normals(nodes, mesh[Side::primary]);
}

}  // namespace

Tie::Tie(PerSide<SurfaceMesh> mesh, Effects effects, IndexedVector<TiedNode> nodes, BreakingLaw breaking)
    : mesh_(std::move(mesh)),
      effects_(std::move(effects)),
      nodes_(std::move(nodes)),
      breaking_(breaking),
      first_(1, 0) {
  for (const TiedNode& tied : nodes_) {
    const auto exchanged = std::count_if(tied.fields.begin(), tied.fields.end(),
                                         [](const TiedAverage& average) { return average.exists(); });
    first_.push_back(first_.back() + (effects_.traction ? 3 : 0) + exchanged);
  }
  const int fields = effects_.scalar_fields();
  state_ = {Matrix3Xd::Zero(3, nodes_.count()), MatrixXd::Zero(fields, nodes_.count()), 1, VectorXd::Ones(fields), {}};
  std::visit([&](const auto& law) { prepare(nodes_, law, mesh_); }, breaking_);
  if (may_break(breaking_)) state_.damage = DamageState(nodes_.count());
}

void Tie::set_laws(const Settings& settings, const std::optional<BreakingLaw>& breaking) {
  settings_ = settings;
  last_gaps_.reset();
  if (breaking) breaking_ = *breaking;
  penalties_ = at_nodes(mixture_contact::penalties(mesh_[Side::primary], mesh_[Side::secondary], effects_, settings_),
                        mesh_[Side::primary]);
}

void Tie::set_meshes(PerSide<SurfaceMesh> mesh) {
  mesh_ = std::move(mesh);
  set_laws(settings_);
}

// ------------------------------------------------------------ loads

double Tie::traction_penalty(Index n) const {
  if (has_unknown_multipliers()) return 0;
  return state_.traction_penalty_scale * penalties_.traction[nodes_[n].node];
}

double Tie::flux_penalty(Index n, int field) const {
  if (has_unknown_multipliers()) return 0;
  return state_.flux_penalty_scale[field] * penalties_.flux(field, nodes_[n].node);
}

TieLoads Tie::loads(const PerSide<SurfaceFields>& fields) const {
  const Index count = nodes_.count();
  const Index scalars = effects_.scalar_fields();
  const bool is_cohesive = std::holds_alternative<Cohesive>(breaking_);
  TieLoads loads{Matrix3Xd::Zero(3, count),
                 Matrix3Xd::Zero(3, count),
                 MatrixXd::Zero(scalars, count),
                 MatrixXd::Zero(scalars, count),
                 Matrix3Xd::Zero(3, is_cohesive ? count : 0),
                 state_.damage.damage};
  const FacingPositions x = positions_of(fields);
  in_parallel(count, [&](Index n) {
    loads.gap.col(n) = gap_vector(nodes_[n], x);
    if (state_.damage.is_broken(n)) return;
    if (effects_.traction && is_cohesive) {
      const BondLoad load = bond(*this, n, loads.gap.col(n), x);
      loads.traction.col(n) = load.value.head<3>();
      loads.turning.col(n) = load.value.tail<3>();
      loads.damage[n] = load.damage;
    } else if (effects_.traction) {
      const double penalty = traction_penalty(n);
      loads.traction.col(n) = bonded_traction(state_.traction.col(n), penalty, loads.gap.col(n)).value;
    }
    for (int k = 0; k < scalars; ++k) {
      if (!nodes_[n].exchanges(k)) continue;
      loads.jump(k, n) = -nodes_[n].fields[k].weights.dot(values_at(nodes_[n], fields, k));
      loads.flux(k, n) = augmented(state_.flux(k, n), flux_penalty(n, k), loads.jump(k, n)).value;
    }
  });
  return loads;
}

// ------------------------------------------------------------ residual and tangent

Patch Tie::patch(Index n) const {
  Patch patch{nodes_[n].primary, nodes_[n].secondary, {}, std::nullopt, true};
  if (has_unknown_multipliers()) patch.multiplier_node = indexing::as_int(n);
  return patch;
}

Patch Tie::patch(Index n, int field) const { return patch(n).of_field(field, false); }

template <class Values, class Make, class Use>
void Tie::for_each_part(const Make& make, const Use& use) const {
  const Index parts = effects_.scalar_fields() + 1;  // number of parts of a node: its traction, then its fluxes
  const auto exists = [&](Index n, Index part) {
    if (state_.damage.is_broken(n) && !has_unknown_multipliers()) return false;
    return part == 0 ? effects_.traction : nodes_[n].exchanges(indexing::as_int(part - 1));
  };
  in_order(
      nodes_.count() * parts,
      [&](Index i) {
        return exists(i / parts, i % parts) ? make(i / parts, indexing::as_int(i % parts) - 1) : Values();
      },
      [&](Index i, const Values& values) {
        const int field = indexing::as_int(i % parts) - 1;
        if (values.size() > 0) use(field < 0 ? patch(i / parts) : patch(i / parts, field), values);
      });
}

void Tie::for_each_patch(const std::function<void(const Patch&)>& use) const {
  for_each_part<VectorXd>([](Index /*n*/, int /*field*/) { return VectorXd::Zero(1); },
                          [&](const Patch& patch, const VectorXd& /*none*/) { use(patch); });
}

VectorXd Tie::flux_residual(Index n, int field, const TieLoads& loads) const {
  const LocalLayout layout = patch(n, field).layout();
  const TiedAverage& average = nodes_[n].fields[field];
  VectorXd residual(layout.size());
  residual.head(layout.nodes()) = -average.area * loads.flux(field, n) * average.weights;
  if (!layout.has_multipliers()) return residual;
  residual[layout.flux_multiplier(0)] = average.area *
                                        (state_.damage.is_broken(n)
                                             ? -state_.flux(field, n)
                                             : flux_unit(penalties_, field, nodes_[n].node) * loads.jump(field, n));
  return residual;
}

MatrixXd Tie::traction_tangent(Index n, const FacingPositions& x, const TieLoads& loads,
                               const Softening& softening) const {
  const LocalLayout layout = patch(n).layout();
  const Index own = 3 * layout.nodes();
  const double area = nodes_[n].traction.area;
  MatrixXd tangent = MatrixXd::Zero(layout.size(), layout.size());
  if (!state_.damage.is_broken(n)) tangent.topLeftCorner(own, own) = -area * stiffness(*this, n, x, loads, softening);
  if (!layout.has_multipliers()) return tangent;
  const double unit = traction_unit(penalties_, nodes_[n].node);
  if (state_.damage.is_broken(n)) {
    tangent.bottomRightCorner<3, 3>() = area * unit * Eigen::Matrix3d::Identity();
    return tangent;
  }
  const Matrix3Xd variation = gap_variation(nodes_[n], x);
  tangent.bottomLeftCorner(3, own) = -area * unit * variation;
  tangent.topRightCorner(own, 3) = -area * unit * variation.transpose();
  tangent.bottomRightCorner<3, 3>() = (area * unit / unknown_factor) * Eigen::Matrix3d::Identity();
  return tangent;
}

MatrixXd Tie::flux_tangent(Index n, int field) const {
  const LocalLayout layout = patch(n, field).layout();
  const Index own = layout.nodes();
  const TiedAverage& average = nodes_[n].fields[field];
  MatrixXd tangent = MatrixXd::Zero(layout.size(), layout.size());
  const double unit = flux_unit(penalties_, field, nodes_[n].node);
  if (state_.damage.is_broken(n)) {
    if (layout.has_multipliers()) tangent(own, own) = -average.area * unit;
    return tangent;
  }
  tangent.topLeftCorner(own, own).noalias() = (average.area * flux_penalty(n, field)) * average.weights *
                                              average.weights.transpose();
  if (!layout.has_multipliers()) return tangent;
  tangent.col(own).head(own) = -average.area * unit * average.weights;
  tangent.row(own).head(own) = -average.area * unit * average.weights.transpose();
  tangent(own, own) = -average.area * unit / unknown_factor;
  return tangent;
}

void Tie::residual(const PerSide<SurfaceFields>& fields, double dt, const AddResidual& add) const {
  const TieLoads now = loads(fields);
  const FacingPositions x = positions_of(fields);
  for_each_part<VectorXd>(
      [&](Index n, int field) -> VectorXd {
        return field < 0 ? traction_residual(*this, n, x, now) : dt * flux_residual(n, field, now);
      },
      add);
}

void Tie::tangent(const PerSide<SurfaceFields>& fields, double dt, const Softening& softening,
                  const AddTangent& add) const {
  const TieLoads now = loads(fields);
  const FacingPositions x = positions_of(fields);
  for_each_part<MatrixXd>(
      [&](Index n, int field) -> MatrixXd {
        return field < 0 ? traction_tangent(n, x, now, softening) : dt * flux_tangent(n, field);
      },
      add);
}

// ------------------------------------------------------------ multipliers

GapReport Tie::gaps(const PerSide<SurfaceFields>& fields) const {
  const TieLoads now = loads(fields);
  GapSums traction;
  IndexedVector<GapSums> flux(effects_.scalar_fields());
  for (Index n = 0; n < nodes_.count(); ++n) {
    if (state_.damage.is_broken(n)) continue;
    const TiedNode& tied = nodes_[n];
    const double area = tied.traction.area;
    if (effects_.traction)
      traction.add(area, traction_unit(penalties_, nodes_[n].node), now.gap.col(n).norm(), now.traction.col(n).norm(),
                   std::sqrt(area));
    for (int k = 0; k < flux.count(); ++k) {
      if (!nodes_[n].exchanges(k)) continue;
      flux[k].add(tied.fields[k].area, flux_unit(penalties_, k, nodes_[n].node), now.jump(k, n), now.flux(k, n),
                  fields[Side::primary].scalar(tied.node, k));
    }
  }
  GapReport report{traction.field_gap(), {}, {}};
  for (const GapSums& sums : flux) report.flux.push_back(sums.field_gap());
  return report;
}

bool Tie::augment(const PerSide<SurfaceFields>& fields) {
  const GapReport report = gaps(fields);
  const std::optional<GapReport> last = std::exchange(last_gaps_, report);
  const TieLoads now = loads(fields);
  state_.traction = now.traction;
  state_.flux = now.flux;
  const Tolerances& tolerances = settings_.tolerances;
  bool any = last && is_slow(last->traction, report.traction) &&
             grow(state_.traction_penalty_scale, report.traction, tolerances.traction, penalties_.traction,
                  penalties_.stiffness, largest_tie_factor);
  for (int k = 0; last && k < effects_.scalar_fields(); ++k) {
    if (!is_slow(last->flux[k], report.flux[k])) continue;
    any = grow(state_.flux_penalty_scale[k], report.flux[k], tolerance_of_flux(tolerances, effects_, k),
               penalties_.flux.row(k).transpose(), penalties_.conductance.row(k).transpose(), largest_tie_factor) ||
          any;
  }
  return any;
}

Index Tie::unknown(Index n, std::optional<int> field) const {
  if (!field) return first_[n];
  const IndexedVector<TiedAverage>& fields = nodes_[n].fields;
  return first_[n] + (effects_.traction ? 3 : 0) +
         std::count_if(fields.begin(), fields.begin() + *field, [](const TiedAverage& each) { return each.exists(); });
}

VectorXd Tie::unknowns() const {
  VectorXd values(unknown_count());
  if (values.size() == 0) return values;
  for (Index n = 0; n < nodes_.count(); ++n) {
    if (effects_.traction)
      values.segment<3>(first_[n]) = state_.traction.col(n) / traction_unit(penalties_, nodes_[n].node);
    for (int k = 0; k < effects_.scalar_fields(); ++k) {
      if (nodes_[n].exchanges(k)) values[unknown(n, k)] = state_.flux(k, n) / flux_unit(penalties_, k, nodes_[n].node);
    }
  }
  return values;
}

void Tie::set_unknowns(const VectorXd& values) {
  for (Index n = 0; n < nodes_.count(); ++n) {
    if (effects_.traction)
      state_.traction.col(n) = traction_unit(penalties_, nodes_[n].node) * values.segment<3>(first_[n]);
    for (int k = 0; k < effects_.scalar_fields(); ++k) {
      if (nodes_[n].exchanges(k)) state_.flux(k, n) = flux_unit(penalties_, k, nodes_[n].node) * values[unknown(n, k)];
    }
  }
}

bool couples_directions(const Tie& tie) {
  const auto keeps_gap = [](const TiedNode& tied) { return !tied.gaps.empty(); };
  return std::holds_alternative<Cohesive>(tie.breaking()) ||
         std::any_of(tie.nodes().begin(), tie.nodes().end(), keeps_gap);
}

}  // namespace mixture_contact
