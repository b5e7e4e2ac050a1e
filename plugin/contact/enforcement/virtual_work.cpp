#include "enforcement/virtual_work.h"

#include "base/in_order.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace mixture_contact {
namespace {

/// The nodal sum of the residuals of pairs or patches that exchange the same fields. The host then receives each node
/// once.
class NodalResidual {
 public:
  NodalResidual(IndexedVector<int> fields, const FacingFields& surfaces)
      : fields_(std::move(fields)),
        primary_(zero_sums(surfaces.primary.position.cols())),
        secondary_(zero_sums(surfaces.secondary.position.cols())) {}

  /// Adds the local residual of a pair or patch with these nodes, in order.
  template <class Nodes>
  void add(const Nodes& primary, const Nodes& secondary, const VectorXd& local) {
    add_nodes(secondary, local, add_nodes(primary, local, 0, primary_), secondary_);
  }

  /// Calls `add` once with the sum over all nodes that have a part; not at all if there is none, because hosts do not
  /// accept empty vectors.
  void hand_over(const AddVector& add) const {
    const Patch patch{nodes_of(primary_), nodes_of(secondary_), fields_};
    if (patch.primary.empty() && patch.secondary.empty()) return;
    VectorXd values(patch.layout().size());
    values << parts_of(primary_, patch.primary), parts_of(secondary_, patch.secondary);
    add(patch, values);
  }

 private:
  /// The sums of one surface: a column with the block of each node, and whether the node has a part.
  struct Sums {
    MatrixXd values;
    NodeFlags has_part;
  };
  /// Adds the blocks of these nodes, which start at `entry` of the local vector. Returns the entry after them.
  template <class Nodes>
  static Index add_nodes(const Nodes& nodes, const VectorXd& local, Index entry, Sums& sums) {
    const Index rows = sums.values.rows();
    for (const int node : nodes) {
      sums.values.col(node).head<3>() += local.segment<3>(entry);
      for (Index row = 3; row < rows; ++row) sums.values(row, node) += local[entry + row];
      sums.has_part[node] = true;
      entry += rows;
    }
    return entry;
  }
  Sums zero_sums(Index nodes) const {
    return {MatrixXd::Zero(LocalLayout(1, 0, fields_.count()).size(), nodes), NodeFlags(nodes, false)};
  }
  static IndexedVector<int> nodes_of(const Sums& sums) {
    IndexedVector<int> nodes;
    for (int node = 0; node < sums.has_part.count(); ++node) {
      if (sums.has_part[node]) nodes.push_back(node);
    }
    return nodes;
  }
  static VectorXd parts_of(const Sums& sums, const IndexedVector<int>& nodes) {
    MatrixXd parts(sums.values.rows(), nodes.count());
    for (Index n = 0; n < nodes.count(); ++n) parts.col(n) = sums.values.col(nodes[n]);
    return parts.reshaped();
  }

  IndexedVector<int> fields_;
  Sums primary_;
  Sums secondary_;
};

/// Sets the traction part of a geometric tangent.
void set_tractions(const MortarSpace& space, const VaryingPair& varying, TractionTangent& traction) {
  MatrixXd& values = traction.block.values;
  traction.flat.reset();
  if (varying.flat) {
    const FlatForces forces = flat_forces(varying.flat->pair, varying.flat->vary, varying.flat->traction);
    if (space.symmetric()) return void(values = traction_tangent(forces));
    traction.flat = forces;
    return values.resize(0, 0);
  }
  const Index size = traction.block.rows.displacement_layout().size();
  values.setZero(size, size);
  for (const auto& [point, vary] : varying.points) {
    PointForce force = normal_force(point.kinematics, vary, point.loads);
    space.slips().add_force(point.kinematics, vary, point.loads, force);
    add_traction_tangent(point.kinematics, vary, force, values);
  }
}

/// Sets the part of the k-th flux of a geometric tangent.
void set_flux(const VaryingPair& varying, Index k, FluxTangent& flux) {
  MatrixXd& values = flux.block.values;
  flux.flat.reset();
  if (varying.flat) {
    flux.flat = flat_flows(varying.flat->pair, varying.flat->vary, varying.flat->flux[k]);
    return values.resize(0, 0);
  }
  const LocalLayout layout = flux.block.columns.layout();
  values.setZero(layout.nodes(), layout.size());
  for (const auto& [point, vary] : varying.points)
    add_flux_tangent(point.kinematics, vary, point.loads, k, layout, values);
}

/// Sets `of_field` to the nodes of a patch with one of its fields.
void set_field(const Patch& patch, int field, bool with_displacements, Patch& of_field) {
  of_field.primary = patch.primary;
  of_field.secondary = patch.secondary;
  of_field.fields.fill(1, field);
  of_field.displacements = with_displacements;
}

/// Sets the residual of a flat pair, in the order of `layout`.
void set_flat_residual(const FlatPair& flat, const FacetLoads& nodal, double dt, const LocalLayout& layout,
                       VectorXd& residual) {
  residual.resize(layout.size());
  const FlatVariation forces = traction_residual(flat, nodal.traction);
  for (Index node = 0; node < layout.nodes(); ++node)
    residual.segment<3>(layout.displacement(node, 0)) = forces.segment<3>(3 * node);
  for (Index k = 0; k < layout.scalar_fields(); ++k) {
    const FlatNodes flows = flux_residual(flat, dt * nodal.flux[k]);
    for (Index node = 0; node < layout.nodes(); ++node) residual[layout.scalar(node, k)] = flows[node];
  }
}

}  // namespace

TangentBlock with_values(const TractionTangent& tangent) {
  TangentBlock block = tangent.block;
  if (tangent.flat) block.values = traction_tangent(*tangent.flat);
  return block;
}

TangentBlock with_values(const FluxTangent& tangent) {
  TangentBlock block = tangent.block;
  if (!tangent.flat) return block;
  const LocalLayout layout = block.columns.layout();
  const auto rows = flux_tangent(*tangent.flat);
  block.values.setZero(layout.nodes(), layout.size());
  for (Index node = 0; node < layout.nodes(); ++node)
    block.values.middleCols<3>(layout.displacement(node, 0)) = rows.middleCols<3>(3 * node);
  return block;
}

void set_geometric_tangent(const MortarSpace& space, const FacetPair& pair, const VaryingPair& varying,
                           GeometricTangent& tangent) {
  TangentBlock& traction = tangent.traction.block;
  space.facing().set_patch(pair, traction.rows);
  // In a symmetric tangent, the fluxes have no geometric part.
  tangent.fluxes.resize(space.symmetric() ? 0 : traction.rows.fields.size());
  ScopedTimer laps(space.effect_times(), space.effects().scalar_fields(), stands_for(space.facing(), pair));
  set_tractions(space, varying, tangent.traction);
  laps.traction();
  for (Index k = 0; k < count_of(tangent.fluxes); ++k) {
    FluxTangent& flux = at(tangent.fluxes, k);
    const int field = traction.rows.fields[k];
    set_field(traction.rows, field, false, flux.block.rows);
    set_field(traction.rows, field, traction.rows.displacements, flux.block.columns);
    set_flux(varying, k, flux);
    laps.field(field);
  }
  set_traction_block(space, traction);
}

GeometricTangent geometric_tangent(const MortarSpace& space, const FacetPair& pair, const VaryingPair& varying) {
  GeometricTangent tangent;
  set_geometric_tangent(space, pair, varying, tangent);
  return tangent;
}

void nodal_residual(const MortarSpace& space, const NodalLoads& loads, const FacingFields& fields, double dt,
                    const AddVector& add) {
  const FacingPairs& facing = space.facing();
  const auto carries_load = [&](const FacetPair& pair) { return facing.has_node_among(pair, loads.in_contact); };
  const auto set_residual = [&](Index index, VectorXd& residual, std::monostate& /*none*/) {
    const FacetPair& pair = facing.pairs()[index];
    if (!carries_load(pair)) return;
    const Facet& facet = facing.primary_facet(pair);
    const IndexedVector<int> exchanged = facing.exchanged_fields(pair);
    const LocalLayout layout(facet.count(), facing.secondary_facet(pair).count(), exchanged.count());
    const FacetLoads nodal = facet_loads(facet, loads, exchanged);
    const auto by_moments = [&](const FlatPair& flat) { set_flat_residual(flat, nodal, dt, layout, residual); };
    const auto add_point = [&](const IntegrationPoint& place, const PointKinematics& point, const FacetVector& psi) {
      PointLoads here = loads_at(nodal, psi);
      here.weight = place.weight;
      here.time_increment = dt;
      add_residual(point, here, layout, residual);
    };
    space.integrate(pair, by_moments, [&] {
      residual.setZero(layout.size());
      space.for_each_point(pair, add_point);
    });
  };
  std::map<std::vector<int>, NodalResidual> sums;  // by the exchanged fields of the pairs
  const auto sum_up = [&](Index index, const VectorXd& residual) {
    const FacetPair& pair = facing.pairs()[index];
    if (!carries_load(pair)) return;
    const IndexedVector<int> exchanged = facing.exchanged_fields(pair);
    NodalResidual& sum = sums.try_emplace(exchanged, exchanged, fields).first->second;
    sum.add(facing.primary_facet(pair), facing.secondary_facet(pair), residual);
  };
  in_order_with(std::monostate(), VectorXd(), facing.pairs().count(), set_residual, sum_up);
  for (const auto& sum : sums) sum.second.hand_over(add);
}

void linear_residual(const IndexedVector<NodeLinearisation>& nodes, const NodalLoads& loads, const FacingFields& fields,
                     double dt, const AddVector& add) {
  NodalResidual tractions({}, fields);
  for (Index node = 0; node < nodes.count(); ++node) {
    const NodeLinearisation& linear = nodes[node];
    if (linear.empty()) continue;
    tractions.add(linear.patch.primary, linear.patch.secondary, loads.traction[node] * linear.traction_work);
    for (Index k = 0; k < linear.jumps.count(); ++k) {
      const int field = linear.patch.fields[k];
      if (!loads.exchanges(field, node)) continue;
      const double flow = dt * loads.flux_area(field, node) * loads.flux(field, node);
      add(linear.patch.of_field(field, false), flow * linear.jumps[k].weights);
    }
  }
  tractions.hand_over(add);
}

void geometric_tangents(const MortarSpace& space, const NodalLoads& loads, const FacingFields& fields, double dt,
                        const AddBlock& add) {
  const IndexedVector<FacetPair>& pairs = space.facing().pairs();
  const auto of_pair = [&](Index index) -> std::optional<GeometricTangent> {
    if (!space.facing().has_node_among(pairs[index], loads.in_contact)) return std::nullopt;
    return geometric_tangent(space, pairs[index], varying_pair(space, pairs[index], loads, fields, dt));
  };
  in_batches(pairs.count(), of_pair, [&](Index /*index*/, const std::optional<GeometricTangent>& tangent) {
    if (!tangent) return;
    for (const FluxTangent& flux : tangent->fluxes) add(with_values(flux));
    add(with_values(tangent->traction));
  });
}

}  // namespace mixture_contact
