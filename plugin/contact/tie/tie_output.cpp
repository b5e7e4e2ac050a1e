#include "tie/tie_output.h"

#include "interface/facing_nodes.h"

namespace mixture_contact {
namespace {

/// Sums over areas at the nodes of a surface.
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

/// Means over the areas, as a surface sees them: `sense` -1 turns what has the primary surface's sense round.
/// `normals`: at its nodes, out of its body.
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
    output.friction.slip.col(node) = output.gap[node] * normal - gap;  // of this side over the other
    output.flux.col(node) = factor * sums.flux.col(node);
    output.jump.col(node) = factor * sums.jump.col(node);
  }
  return output;
}

}  // namespace

InterfaceOutput output(const Tie& tie, const PerSide<SurfaceFields>& fields) {
  const TieLoads loads = tie.loads(fields);
  const Index scalars = tie.effects().scalar_fields();
  PerSide<NodeSums> sums{
      {NodeSums(tie.mesh()[Side::primary].nodes, scalars), NodeSums(tie.mesh()[Side::secondary].nodes, scalars)}};
  InterfaceOutput all;
  all.balance.flow.setZero(scalars);
  for (Index n = 0; n < tie.nodes().count(); ++n) {
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
  return all;
}

}  // namespace mixture_contact
