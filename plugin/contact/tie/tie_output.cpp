#include "tie/tie_output.h"

#include "interface/facing_nodes.h"

#include <algorithm>

namespace mixture_contact {
namespace {

/// Sums of values times areas at the nodes of a surface.
struct NodeSums {
  VectorXd area;
  Matrix3Xd gap;
  Matrix3Xd traction;
  MatrixXd jump;
  MatrixXd flux;

  NodeSums(Index nodes, Index fields)
      : area(VectorXd::Zero(nodes)),
        gap(Matrix3Xd::Zero(3, nodes)),
        traction(Matrix3Xd::Zero(3, nodes)),
        jump(MatrixXd::Zero(fields, nodes)),
        flux(MatrixXd::Zero(fields, nodes)) {}

  void add(int node, double share, const TieLoads& loads, Index n) {
    area[node] += share;
    gap.col(node) += share * loads.gap.col(n);
    traction.col(node) += share * loads.traction.col(n);
    jump.col(node) += share * loads.jump.col(n);
    flux.col(node) += share * loads.flux.col(n);
  }
};

/// The area-weighted means at the nodes of a surface. `sense`: 1 for the primary surface, -1 for the secondary one,
/// whose gaps and tractions have the opposite sign. `normals`: unit normals at the nodes, out of the body.
NodalOutput means_of(const NodeSums& sums, double sense, const Matrix3Xd& normals) {
  const Index nodes = sums.area.size();
  NodalOutput output;
  output.gap.setZero(nodes);
  output.pressure.setZero(nodes);
  output.flux.setZero(sums.flux.rows(), nodes);
  output.jump.setZero(sums.jump.rows(), nodes);
  output.tributary_area = sums.area;
  output.friction.traction.setZero(3, nodes);
  output.friction.slip.setZero(3, nodes);
  for (Index node = 0; node < nodes; ++node) {
    if (!(sums.area[node] > 0)) continue;
    const double factor = sense / sums.area[node];
    const Vector3d normal = normals.col(node);
    const Vector3d gap = factor * sums.gap.col(node);
    const Vector3d traction = factor * sums.traction.col(node);
    output.gap[node] = gap.dot(normal);
    output.pressure[node] = -traction.dot(normal);
    output.friction.traction.col(node) = traction + output.pressure[node] * normal;
    output.friction.slip.col(node) = output.gap[node] * normal - gap;  // slip of this side relative to the other side
    output.flux.col(node) = factor * sums.flux.col(node);
    output.jump.col(node) = factor * sums.jump.col(node);
  }
  return output;
}

/// Area-weighted damage, opening and energy of the bonds around the nodes of a surface.
struct BondSums {
  VectorXd area;
  BreakingOutput sums;

  explicit BondSums(Index nodes)
      : area(VectorXd::Zero(nodes)),
        sums{VectorXd::Zero(nodes), VectorXd::Zero(nodes), VectorXd::Zero(nodes), VectorXd::Zero(nodes)} {}

  void add(int node, double share, const DamageState& state, const TieLoads& loads, Index n) {
    const bool is_first = area[node] == 0;
    area[node] += share;
    sums.damage[node] += share * state.damage[n];
    sums.opening[node] += share * loads.gap.col(n).norm();
    sums.energy[node] += share * state.energy[n];
    double& last = sums.broken_at[node];
    const bool is_whole = state.broken_at[n] < 0 || (!is_first && last < 0);
    last = is_whole ? -1 : std::max(last, state.broken_at[n]);
  }

  BreakingOutput means() const {
    BreakingOutput means = sums;
    const VectorXd factor = area.unaryExpr([](double sum) { return sum > 0 ? 1 / sum : 0.0; });
    for (VectorXd* const values : {&means.damage, &means.opening, &means.energy}) values->array() *= factor.array();
    for (Index node = 0; node < area.size(); ++node) {
      if (!(area[node] > 0)) means.broken_at[node] = -1;
    }
    return means;
  }
};

BondEnergy energy_of(const Tie& tie, const TieLoads& loads, const DamageState& state) {
  BondEnergy all;
  for (Index n = 0; n < tie.nodes().count(); ++n) {
    const double area = tie.nodes()[n].traction.area;
    all.dissipated += area * state.energy[n];
    all.viscous += area * state.viscous[n];
    all.stored += 0.5 * area * loads.traction.col(n).dot(loads.gap.col(n));
    if (state.is_broken(n)) all.broken_area += area;
  }
  return all;
}

void add_breaking(const Tie& tie, const TieLoads& loads, const DamageState& state, InterfaceOutput& all) {
  if (!may_break(tie.breaking())) return;
  PerSide<BondSums> sums{{BondSums(tie.mesh()[Side::primary].nodes), BondSums(tie.mesh()[Side::secondary].nodes)}};
  for (Index n = 0; n < tie.nodes().count(); ++n) {
    const TiedNode& tied = tie.nodes()[n];
    const double area = tied.traction.area;
    sums[Side::primary].add(tied.node, area, state, loads, n);
    for (Index b = 0; b < tied.secondary.count(); ++b) {
      const double share = area * tied.secondary_shares[b];
      if (share != 0) sums[Side::secondary].add(tied.secondary[b], share, state, loads, n);
    }
  }
  for (const Side side : both_sides) all.nodes[side].breaking = sums[side].means();
  all.balance.bonds = energy_of(tie, loads, state);
}

}  // namespace

InterfaceOutput output(const Tie& tie, const PerSide<SurfaceFields>& fields, const DamageState& damage) {
  const TieLoads loads = tie.loads(fields);
  const Index scalars = tie.effects().scalar_fields();
  PerSide<NodeSums> sums{
      {NodeSums(tie.mesh()[Side::primary].nodes, scalars), NodeSums(tie.mesh()[Side::secondary].nodes, scalars)}};
  InterfaceOutput all;
  all.balance.flow.setZero(scalars);
  for (Index n = 0; n < tie.nodes().count(); ++n) {
    if (tie.state().damage.is_broken(n)) continue;
    const TiedNode& tied = tie.nodes()[n];
    const double area = tied.traction.area;
    all.balance.force += area * loads.traction.col(n);
    all.balance.area += area;
    for (int k = 0; k < scalars; ++k) all.balance.flow[k] += tied.fields[k].area * loads.flux(k, n);
    sums[Side::primary].add(tied.node, area, loads, n);
    for (Index b = 0; b < tied.secondary.count(); ++b)
      sums[Side::secondary].add(tied.secondary[b], area * tied.secondary_shares[b], loads, n);
  }
  for (const Side side : both_sides)
    all.nodes[side] = means_of(sums[side], side == Side::primary ? 1 : -1,
                               nodal_normals(tie.mesh()[side], fields[side].position));
  add_breaking(tie, loads, damage, all);
  return all;
}

}  // namespace mixture_contact
