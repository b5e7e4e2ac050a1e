#include "interface.h"

#include "parallel.h"
#include "search.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mixture_contact {
namespace {

/// Outward unit normals at the nodes: the sum of the area vectors of the facets around each.
Matrix3Xd nodal_normals(const SurfaceMesh& mesh, const Matrix3Xd& position) {
  Matrix3Xd normals = Matrix3Xd::Zero(3, mesh.nodes);
  for (const Facet& facet : mesh.facets) {
    const FacetCoordinates x = facet_coordinates(facet, position);
    for (int a = 0; a < node_count(facet.type); ++a) {
      const Eigen::Matrix<double, 3, 2> tangents = x *
                                                   shape_functions(facet.type, parametric_node(facet.type, a)).gradient;
      normals.col(facet.nodes[static_cast<std::size_t>(a)]) += tangents.col(0).cross(tangents.col(1));
    }
  }
  normals.colwise().normalize();
  return normals;
}

double longest_edge(const Facet& facet, const Matrix3Xd& position) {
  const int corners = is_triangle(facet.type) ? 3 : 4;  // the first nodes of every type
  double longest = 0;
  for (int a = 0; a < corners; ++a) {
    const int from = facet.nodes[static_cast<std::size_t>(a)];
    const int to = facet.nodes[static_cast<std::size_t>((a + 1) % corners)];
    longest = std::max(longest, (position.col(to) - position.col(from)).norm());
  }
  return longest;
}

std::vector<bool> in_contact_of(const std::vector<FacingNode>& nodes) {
  std::vector<bool> in_contact;
  for (const FacingNode& node : nodes) in_contact.push_back(node.in_contact);
  return in_contact;
}

UnnoticedOverlap unnoticed_among(const std::vector<FacingNode>& nodes) {
  UnnoticedOverlap found;
  for (const FacingNode& node : nodes) {
    if (node.share <= sound_overlap) continue;
    ++found.nodes;
    found.depth = std::max(found.depth, node.overlap);
    found.share = std::max(found.share, node.share);
  }
  return found;
}

void keep_worst(FieldGap& worst, const FieldGap& gap) {
  worst.relative = larger(worst.relative, gap.relative);
  worst.largest = larger(worst.largest, gap.largest);
}

}  // namespace

ContactInterface::ContactInterface(PerSide<SurfaceMesh> mesh, Effects effects, Settings settings)
    : mesh_(std::move(mesh)), effects_(std::move(effects)), settings_(settings), times_(effects_.scalar_fields()) {
  for (const Side side : both_sides) {
    if (side == Side::secondary && !settings_.two_pass) continue;
    if (side == Side::secondary && settings_.enforcement == Enforcement::lagrange_multipliers) {
      throw std::invalid_argument("multipliers that are unknowns on both surfaces contradict each other");
    }
    passes_.push_back(
        {side, std::make_unique<ContactPass>(mesh_[side], mesh_[other(side)], effects_, settings_), {}, {}});
  }
}

double ContactInterface::search_radius(const PerSide<Matrix3Xd>& position) const {
  if (settings_.search_radius > 0) return settings_.search_radius;
  return std::min(half_diagonal(position[Side::primary]), half_diagonal(position[Side::secondary]));
}

void ContactInterface::project(const PerSide<Matrix3Xd>& position, Search search) {
  const TaskClock timed = clock(Task::search);
  const auto same = [&](Side side) {
    return position_[side].cols() == position[side].cols() && position_[side] == position[side];
  };
  const bool search_all = search == Search::everywhere;
  if (same(Side::primary) && same(Side::secondary) && (searched_ || !search_all)) return;
  position_ = position;
  searched_ = search_all;
  for (Pass& pass : passes_) {
    if (!effects_.traction) pass.faced.reset();
    const Matrix3Xd& x1 = position_[pass.side];
    const Matrix3Xd& x2 = position_[other(pass.side)];
    if (search_all) {
      pass.integral->project(x1, x2, search_radius(position_));
    } else {
      pass.integral->project_on_same_facets(x1, x2);
    }
  }
}

void ContactInterface::exchange_traction(bool traction) {
  effects_.traction = traction;
  for (Pass& pass : passes_) {
    pass.faced.reset();
    pass.integral->forget();
  }
  for (Matrix3Xd& position : position_) position.resize(3, 0);
}

bool ContactInterface::begin_iteration(const PerSide<SurfaceFields>& fields) {
  TaskClock timed = clock(Task::stiffness);
  bool changed = false;
  for (const Pass& pass : passes_) {
    const bool pass_changed = pass.integral->begin_iteration(fields[pass.side], fields[other(pass.side)]);
    changed = changed || pass_changed;
    timed.take(pass.integral->effect_times(), thread_count());
  }
  note_memory();
  return changed;
}

void ContactInterface::move_iteration(const PerSide<SurfaceFields>& fields) {
  for (const Pass& pass : passes_) pass.integral->move_iteration(fields[pass.side], fields[other(pass.side)]);
}

void ContactInterface::note_memory() {
  Memory now;
  for (const Pass& pass : passes_) {
    now.points += pass.integral->points();
    now.bytes += pass.integral->memory();
  }
  if (now.bytes >= memory_.bytes) memory_ = now;
}

std::vector<bool> ContactInterface::sealed_nodes(const Pass& pass) const {
  return pass.integral->sealed_nodes(position_[pass.side], position_[other(pass.side)]);
}

void ContactInterface::hold_facing_contact(Pass& pass) {
  if (pass.faced && !effects_.traction) return;
  std::vector<bool> next = in_contact_of(facing_nodes(other(pass.side), sealed_nodes(pass)));
  if (!pass.faced) pass.faced_changes.assign(next.size(), 0);
  for (std::size_t node = 0; node < next.size(); ++node) {
    if (pass.faced && next[node] != (*pass.faced)[node]) ++pass.faced_changes[node];
    // At the edge of contact, as ContactPass::begin_iteration has it; here no load tells whether it is.
    if (pass.faced_changes[node] > most_facing_changes) next[node] = false;
  }
  pass.faced = std::move(next);
}

void ContactInterface::end_iterations() {
  for (Pass& pass : passes_) {
    if (effects_.traction) pass.faced.reset();
    pass.integral->end_iterations();
  }
}

bool ContactInterface::is_solution(const PerSide<SurfaceFields>& fields) const {
  const TaskClock timed = clock(Task::augmentation);
  const bool agrees = std::all_of(passes_.begin(), passes_.end(), [&](const Pass& pass) {
    return pass.integral->is_solution(fields[pass.side], fields[other(pass.side)]);
  });
  return agrees && (settings_.enforcement != Enforcement::lagrange_multipliers || converged(gaps(fields)));
}

Matrix3Xd ContactInterface::without_overlap(const PerSide<Matrix3Xd>& position) const {
  const std::vector<Facet>& facets = mesh_[Side::secondary].facets;
  const Matrix3Xd& x2 = position[Side::secondary];
  const FacetTree tree(facets, x2, box_margin);
  Matrix3Xd moved = position[Side::primary];
  const Matrix3Xd normals = nodal_normals(mesh_[Side::primary], moved);
  const double reach = search_radius(position);
  for (Index node = 0; node < moved.cols(); ++node) {
    const Ray ray{moved.col(node), normals.col(node), reach, settings_.search_tolerance};
    const std::optional<SurfaceHit> hit = nearest_facing(tree, facets, x2, ray);
    if (hit && hit->gap < 0) moved.col(node) += hit->gap * normals.col(node);
  }
  return moved;
}

void ContactInterface::residual(const PerSide<SurfaceFields>& fields, double dt, const AddResidual& add) const {
  TaskClock timed = clock(Task::residual);
  for (const Pass& pass : passes_) {
    pass.integral->residual(
        fields[pass.side], fields[other(pass.side)], dt,
        [&](const Patch& patch, const VectorXd& values) { timed.in_host([&] { add({pass.side, patch}, values); }); });
  }
}

void ContactInterface::tangent(const PerSide<SurfaceFields>& fields, double dt, const AddTangent& add) const {
  TaskClock timed = clock(Task::stiffness);
  for (const Pass& pass : passes_) {
    pass.integral->tangent(fields[pass.side], fields[other(pass.side)], dt, [&](const TangentBlock& block) {
      timed.in_host(block.rows, [&] { add({pass.side, block.rows}, {pass.side, block.columns}, block.values); });
    });
    timed.take(pass.integral->effect_times(), thread_count());
  }
}

void ContactInterface::for_each_coupling(const std::function<void(const Location&)>& use) const {
  TaskClock timed = clock(Task::stiffness);
  for (const Pass& pass : passes_) {
    pass.integral->for_each_coupling(position_[pass.side], position_[other(pass.side)], [&](const Patch& patch) {
      timed.in_host(patch, [&] { use({pass.side, patch}); });
    });
  }
}

GapReport ContactInterface::gaps(const PerSide<SurfaceFields>& fields) const {
  const TaskClock timed = clock(Task::augmentation);
  GapReport worst{{}, std::vector<FieldGap>(static_cast<std::size_t>(effects_.scalar_fields()))};
  for (const Pass& pass : passes_) {
    const GapReport report = measure_gaps(*pass.integral, fields[pass.side], fields[other(pass.side)], effects_);
    keep_worst(worst.traction, report.traction);
    for (std::size_t k = 0; k < worst.flux.size(); ++k) keep_worst(worst.flux[k], report.flux[k]);
  }
  return worst;
}

MultiplierLayout ContactInterface::multiplier_layout() const {
  const ContactPass& pass = *passes_[0].integral;
  return pass.has_unknown_multipliers() ? pass.multiplier_layout() : MultiplierLayout(0, 0);
}

VectorXd ContactInterface::unknown_multipliers() const { return passes_[0].integral->unknown_multipliers(); }

void ContactInterface::set_unknown_multipliers(const VectorXd& mu) { passes_[0].integral->set_unknown_multipliers(mu); }

void ContactInterface::augment(const PerSide<SurfaceFields>& fields) {
  const TaskClock timed = clock(Task::augmentation);
  for (const Pass& pass : passes_) {
    const SurfaceFields& primary = fields[pass.side];
    const SurfaceFields& secondary = fields[other(pass.side)];
    const GapReport report = measure_gaps(*pass.integral, primary, secondary, effects_);
    pass.integral->augment(primary, secondary);
    grow_penalties(*pass.integral, report, settings_.tolerances, effects_);
  }
}

PerSide<std::vector<bool>> ContactInterface::hold_nodes_in_contact() {
  {
    const TaskClock timed = clock(Task::stiffness);
    for (Pass& pass : passes_) hold_facing_contact(pass);
  }
  return nodes_in_contact();
}

UnnoticedOverlap ContactInterface::unnoticed_overlap() const {
  if (passes_.size() != 1 || !effects_.traction) return {};
  const TaskClock timed = clock(Task::output);
  const Pass& pass = passes_.front();
  return unnoticed_among(facing_nodes(other(pass.side), sealed_nodes(pass)));
}

PerSide<std::vector<bool>> ContactInterface::nodes_in_contact() const {
  const TaskClock timed = clock(Task::stiffness);
  PerSide<std::vector<bool>> in_contact;
  for (const Side side : both_sides) in_contact[side].assign(static_cast<std::size_t>(mesh_[side].nodes), false);
  const auto add = [&](Side side, const std::vector<bool>& found) {
    for (std::size_t node = 0; node < found.size(); ++node) {
      if (found[node]) in_contact[side][node] = true;
    }
  };
  for (const Pass& pass : passes_) {
    const std::vector<bool> own = sealed_nodes(pass);
    add(pass.side, own);
    add(other(pass.side), pass.faced ? *pass.faced : in_contact_of(facing_nodes(other(pass.side), own)));
  }
  return in_contact;
}

std::vector<FacingNode> ContactInterface::facing_nodes(Side side, const std::vector<bool>& other_in_contact) const {
  std::vector<FacingNode> nodes(static_cast<std::size_t>(mesh_[side].nodes));
  const double reach = search_radius(position_);
  if (!surfaces_within_reach(position_[side], position_[other(side)], reach)) return nodes;
  const std::vector<Facet>& facets = mesh_[other(side)].facets;
  const FacetTree tree(facets, position_[other(side)], box_margin);
  const Matrix3Xd normals = nodal_normals(mesh_[side], position_[side]);
  const VectorXd other_share = VectorXd::NullaryExpr(static_cast<Index>(other_in_contact.size()), [&](Index node) {
    return other_in_contact[static_cast<std::size_t>(node)] ? 1.0 : 0.0;
  });
  in_parallel(nodes.size(), [&](std::size_t index) {
    const auto node = static_cast<Index>(index);
    const Ray ray{position_[side].col(node), normals.col(node), reach, settings_.search_tolerance};
    const std::optional<SurfaceHit> hit = nearest_facing(tree, facets, position_[other(side)], ray);
    if (!hit) return;
    const Facet& facet = facets[static_cast<std::size_t>(hit->facet)];
    const int sub_facet = sub_facet_at(facet.type, hit->eta);
    const FacetVector shape = multiplier_functions(facet.type, sub_facet, hit->eta).value;
    const FacetVector shares = facet_values(facet, other_share);
    nodes[index].in_contact = shape.dot(shares) >= covered;
    if (hit->gap >= 0 || shares.maxCoeff() > 0) return;
    nodes[index].overlap = -hit->gap;
    nodes[index].share = -hit->gap / longest_edge(facet, position_[other(side)]);
  });
  return nodes;
}

Balance ContactInterface::balance(const PerSide<SurfaceFields>& fields) const {
  const TaskClock timed = clock(Task::output);
  Balance balance;
  balance.flow = VectorXd::Zero(effects_.scalar_fields());
  for (const Pass& pass : passes_) {
    const double sign = pass.side == Side::primary ? 1 : -1;
    const double share = 1.0 / static_cast<double>(passes_.size());
    pass.integral->for_each_contact(fields[pass.side], fields[other(pass.side)], 1.0, [&](const PointContact& contact) {
      const double weight = contact.loads.weight;
      balance.force += sign * weight * contact.loads.traction.value * contact.kinematics.area_vector;
      balance.area += share * weight * contact.kinematics.area;
      for (std::size_t k = 0; k < contact.fields.size(); ++k) {
        balance.flow[contact.fields[k]] += sign * weight * contact.kinematics.area *
                                           contact.loads.flux[static_cast<Index>(k)].value;
      }
    });
  }
  return balance;
}

NodalOutput ContactInterface::nodal_output(Side side, const PerSide<SurfaceFields>& fields) const {
  const TaskClock timed = clock(Task::output);
  const Index nodes = mesh_[side].nodes;
  const Index scalars = effects_.scalar_fields();
  NodalOutput out{VectorXd::Zero(nodes), VectorXd::Zero(nodes), MatrixXd::Zero(scalars, nodes),
                  MatrixXd::Zero(scalars, nodes), VectorXd::Zero(nodes)};
  VectorXd& weight = out.coverage;  // the sum of weights of all passes until the end
  for (const Pass& pass : passes_) {
    const bool integrated = pass.side == side;
    const double sign = integrated ? 1 : -1;
    pass.integral->for_each_contact(fields[pass.side], fields[other(pass.side)], 1.0, [&](const PointContact& contact) {
      const PointKinematics& point = contact.kinematics;
      const int facet_index = integrated ? contact.pair->primary : contact.pair->secondary;
      const Facet& facet = mesh_[side].facets[static_cast<std::size_t>(facet_index)];
      const FacetVector& shape = integrated ? point.primary_shape : point.secondary_shape;
      const PairVector h = point.jump_weights();
      const double area = contact.loads.weight * point.area / shape.cwiseAbs().sum();
      for (Index a = 0; a < shape.size(); ++a) {
        const int node = facet.nodes[static_cast<std::size_t>(a)];
        const double share = area * std::abs(shape[a]);
        weight[node] += share;
        out.gap[node] += share * point.gap;
        out.pressure[node] -= share * contact.loads.traction.value;
        for (std::size_t k = 0; k < contact.fields.size(); ++k) {
          const auto column = static_cast<Index>(k);
          out.flux(contact.fields[k], node) += sign * share * contact.loads.flux[column].value;
          out.jump(contact.fields[k], node) += sign * share * h.dot(contact.values.col(column));
        }
      }
    });
  }
  const VectorXd scale = (weight.array() > 0).select(weight.array().inverse(), 0.0);
  // Two passes share the load: each integrates its part of it.
  const double parts = static_cast<double>(passes_.size());
  out.gap.array() *= scale.array();
  out.pressure.array() *= parts * scale.array();
  out.flux = parts * out.flux * scale.asDiagonal();
  out.jump = out.jump * scale.asDiagonal();
  out.coverage /= parts;
  return out;
}

void ContactInterface::update_properties(PerSide<VectorXd> stiffness, PerSide<MatrixXd> conductance) {
  for (const Side side : both_sides) {
    mesh_[side].stiffness = std::move(stiffness[side]);
    mesh_[side].conductance = std::move(conductance[side]);
  }
  for (const Pass& pass : passes_) pass.integral->update_penalties();
}

}  // namespace mixture_contact
