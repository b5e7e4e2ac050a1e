#include "enforcement/virtual_work.h"

#include "base/parallel.h"

#include <optional>
#include <utility>

namespace mixture_contact {
namespace {

struct PairResidual {
  Patch patch;
  VectorXd values;
};

/// Blocks of zeros for the fluxes of a patch; none in a symmetric tangent, where what is left of their part depends on
/// displacements alone.
std::vector<TangentBlock> flux_blocks(const MortarSpace& space, const Patch& patch) {
  std::vector<TangentBlock> blocks;
  if (space.symmetric()) return blocks;
  const Index nodes = patch.layout().nodes();
  for (const int field : patch.fields) {
    const Patch columns = space.columns_of(patch, field);
    blocks.push_back({patch.of_field(field, false), columns, MatrixXd::Zero(nodes, columns.layout().size())});
  }
  return blocks;
}

}  // namespace

GeometricTangent geometric_tangent(const MortarSpace& space, const FacetPair& pair,
                                   const std::vector<VaryingPoint>& points) {
  const Patch patch = space.facing().patch(pair);
  const LocalLayout displacements = patch.displacement_layout();
  MatrixXd traction = MatrixXd::Zero(displacements.size(), displacements.size());
  std::vector<TangentBlock> fluxes = flux_blocks(space, patch);
  ScopedTimer laps(space.effect_times(), space.effects().scalar_fields());
  for (const auto& [point, vary] : points) add_traction_tangent(point.kinematics, vary, point.loads, traction);
  laps.traction();
  for (Index k = 0; k < count_of(fluxes); ++k) {
    TangentBlock& block = at(fluxes, k);
    for (const auto& [point, vary] : points) {
      add_flux_tangent(point.kinematics, vary, point.loads, k, point.values.col(k), block.columns.layout(),
                       block.values);
    }
    laps.field(patch.fields[k]);
  }
  return {std::move(fluxes), traction_block(space, patch, std::move(traction))};
}

void pair_residuals(const MortarSpace& space, const NodalLoads& loads, const FacingFields& fields, double dt,
                    const AddVector& add) {
  const FacingPairs& facing = space.facing();
  const auto residual_of = [&](Index index) -> std::optional<PairResidual> {
    const FacetPair& pair = facing.pairs()[index];
    if (!facing.has_node_among(pair, loads.in_contact)) return std::nullopt;
    PairResidual residual{facing.patch(pair), {}};
    const LocalLayout layout = residual.patch.layout();
    residual.values.setZero(layout.size());
    for (std::size_t q = 0; q < pair.points.size(); ++q) {
      const PointContact point = loaded_point(space, pair, q, loads, fields, dt);
      add_residual(point.kinematics, point.loads, layout, residual.values);
    }
    return residual;
  };
  in_order(facing.pairs().count(), residual_of, [&](Index /*index*/, const std::optional<PairResidual>& residual) {
    if (residual) add(residual->patch, residual->values);
  });
}

void geometric_tangents(const MortarSpace& space, const NodalLoads& loads, const FacingFields& fields, double dt,
                        const AddBlock& add) {
  const IndexedVector<FacetPair>& pairs = space.facing().pairs();
  const auto of_pair = [&](Index index) -> std::optional<GeometricTangent> {
    if (!space.facing().has_node_among(pairs[index], loads.in_contact)) return std::nullopt;
    return geometric_tangent(space, pairs[index], varying_points(space, pairs[index], loads, fields, dt));
  };
  in_order(pairs.count(), of_pair, [&](Index /*index*/, const std::optional<GeometricTangent>& tangent) {
    if (!tangent) return;
    for (const TangentBlock& flux : tangent->fluxes) add(flux);
    add(tangent->traction);
  });
}

}  // namespace mixture_contact
