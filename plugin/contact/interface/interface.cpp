#include "interface/interface.h"

#include "base/parallel.h"
#include "integration/search.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

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

bool has_node_among(const Facet& facet, const std::vector<bool>& given) {
  return std::any_of(facet.nodes.begin(), facet.nodes.begin() + node_count(facet.type),
                     [&](int node) { return given[static_cast<std::size_t>(node)]; });
}

/// All nodes of facets some of whose nodes are among the given ones.
std::vector<bool> nodes_of_facets_with(const std::vector<bool>& given, const std::vector<Facet>& facets) {
  std::vector<bool> found(given.size(), false);
  for (const Facet& facet : facets) {
    if (!has_node_among(facet, given)) continue;
    std::for_each(facet.nodes.begin(), facet.nodes.begin() + node_count(facet.type),
                  [&](int node) { found[static_cast<std::size_t>(node)] = true; });
  }
  return found;
}

/// Of nodes deeper than sound_overlap, all but some.
UnnoticedOverlap unnoticed_among(const std::vector<FacingNode>& nodes, const VectorXd& shares,
                                 const std::vector<bool>& but) {
  UnnoticedOverlap found;
  for (std::size_t index = 0; index < nodes.size(); ++index) {
    const double share = shares[static_cast<Index>(index)];
    if (share <= sound_overlap || but[index]) continue;
    ++found.nodes;
    found.depth = std::max(found.depth, -nodes[index].gap);
    found.share = std::max(found.share, share);
  }
  return found;
}

/// Settings of a second pass beside a first one that has them: its own, but for unknown multipliers.
Settings beside(Settings settings) {
  if (settings.enforcement != Enforcement::lagrange_multipliers) return settings;
  settings.enforcement = Enforcement::penalty;
  settings.traction = {true, default_traction_factor};
  settings.solvent = settings.solute = {true, default_flux_factor};
  return settings;
}

/// Area of a point in contact, shared among the nodes of its facet on the surface that is integrated over, or on the
/// other [mm^2].
FacetVector area_of_nodes(const PointContact& contact, bool integrated) {
  const PointKinematics& point = contact.kinematics;
  const FacetVector shape = (integrated ? point.primary_shape : point.secondary_shape).cwiseAbs();
  return contact.loads.weight * point.area / shape.sum() * shape;
}

VectorXd inverse_or_zero(const VectorXd& values) { return (values.array() > 0).select(values.array().inverse(), 0.0); }

bool fits(const Multipliers& multipliers, Index nodes, Index fields) {
  return multipliers.traction.size() == nodes && multipliers.flux.rows() == fields &&
         multipliers.flux.cols() == nodes && multipliers.flux_growth.size() == fields;
}

void keep_worst(FieldGap& worst, const FieldGap& gap) {
  worst.relative = larger(worst.relative, gap.relative);
  worst.largest = larger(worst.largest, gap.largest);
}

}  // namespace

ContactInterface::ContactInterface(PerSide<SurfaceMesh> mesh, Effects effects, Settings settings)
    : mesh_(std::move(mesh)),
      effects_(std::move(effects)),
      settings_(settings),
      settings_of_noticed_(beside(settings)),
      noticed_(static_cast<std::size_t>(mesh_[Side::secondary].nodes), false),
      times_(effects_.scalar_fields()) {
  if (settings_.two_pass && settings_.enforcement == Enforcement::lagrange_multipliers) {
    throw std::invalid_argument("multipliers that are unknowns on both surfaces contradict each other");
  }
  passes_.push_back(make_pass(Side::primary, settings_));
  if (settings_.two_pass) passes_.push_back(make_pass(Side::secondary, settings_));
}

ContactInterface::Pass ContactInterface::make_pass(Side side, const Settings& settings) const {
  return {side, std::make_unique<ContactPass>(mesh_[side], mesh_[other(side)], effects_, settings), {}, {}};
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
    if (search_all) {
      find_points(pass);
    } else {
      pass.integral->project_on_same_facets(position_[pass.side], position_[other(pass.side)]);
    }
  }
}

void ContactInterface::find_points(Pass& pass) {
  pass.integral->project(position_[pass.side], position_[other(pass.side)], search_radius(position_));
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
  std::vector<bool> next = in_contact_of(facing_nodes(pass, sealed_nodes(pass)));
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
    const std::optional<SurfaceHit> hit = nearest_facing_or_passed(tree, facets, x2, ray);
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
    // Beside unknown multipliers penalties leave gaps of their own, which no augmentation closes.
    if (settings_.enforcement != pass.integral->enforcement()) continue;
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

UnnoticedOverlap ContactInterface::notice_overlap(const PerSide<SurfaceFields>& fields) {
  unnoticed_ = {};
  if (settings_.two_pass || !effects_.traction) return {};
  const TaskClock timed = clock(Task::augmentation);
  const std::vector<bool> in_contact = sealed_nodes(passes_.front());
  const std::vector<FacingNode> nodes = facing_nodes(passes_.front(), in_contact);
  const VectorXd shares = overlap_shares(nodes, in_contact);
  const std::vector<bool> loaded = passes_.size() > 1 ? sealed_nodes(passes_.back()) : noticed_;
  unnoticed_ = unnoticed_among(nodes, shares, loaded);
  const UnnoticedOverlap found = unnoticed_among(nodes, shares, noticed_);
  if (found.nodes > 0) notice(nodes, shares, fields);
  return found;
}

VectorXd ContactInterface::overlap_shares(const std::vector<FacingNode>& nodes,
                                          const std::vector<bool>& primary_in_contact) const {
  const std::vector<Facet>& facets = mesh_[Side::primary].facets;
  const std::vector<bool> beside_contact = nodes_of_facets_with(primary_in_contact, facets);
  VectorXd shares = VectorXd::Zero(static_cast<Index>(nodes.size()));
  for (std::size_t index = 0; index < nodes.size(); ++index) {
    const FacingNode& node = nodes[index];
    if (node.facet < 0 || node.gap >= 0) continue;
    const Facet& facet = facets[static_cast<std::size_t>(node.facet)];
    if (has_node_among(facet, beside_contact)) continue;
    shares[static_cast<Index>(index)] = -node.gap / longest_edge(facet, position_[Side::primary]);
  }
  return shares;
}

void ContactInterface::notice(const std::vector<FacingNode>& nodes, const VectorXd& shares,
                              const PerSide<SurfaceFields>& fields) {
  std::vector<bool> entered(mesh_[Side::primary].facets.size(), false);
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    if (shares[static_cast<Index>(node)] > sound_overlap) entered[static_cast<std::size_t>(nodes[node].facet)] = true;
  }
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    if (nodes[node].facet >= 0 && entered[static_cast<std::size_t>(nodes[node].facet)]) noticed_[node] = true;
  }
  const bool joins = passes_.size() == 1;
  limit_second_pass();
  Pass& pass = passes_.back();
  find_points(pass);
  if (joins) pass.integral->begin_open(fields[Side::secondary], fields[Side::primary]);
}

void ContactInterface::limit_second_pass() {
  if (passes_.size() == 1) passes_.push_back(make_pass(Side::secondary, settings_of_noticed_));
  passes_.back().integral->limit_to(noticed_);
}

ContactInterface::State ContactInterface::state() const {
  State state;
  for (std::size_t node = 0; node < noticed_.size(); ++node) {
    if (noticed_[node]) state.noticed.push_back(static_cast<int>(node));
  }
  for (const Pass& pass : passes_) state.multipliers.push_back(pass.integral->multipliers);
  return state;
}

void ContactInterface::check(const State& state) const {
  const auto require = [](bool sound, const std::string& what) {
    if (!sound) throw std::invalid_argument("a stored state of the contact does not fit it: " + what);
  };
  for (const int node : state.noticed) {
    require(node >= 0 && node < mesh_[Side::secondary].nodes, "secondary node " + std::to_string(node));
  }
  require(!settings_.two_pass || state.noticed.empty(), "noticed nodes with two passes");
  const std::size_t passes = settings_.two_pass || !state.noticed.empty() ? 2 : 1;
  require(state.multipliers.size() == passes, "multipliers of " + std::to_string(state.multipliers.size()) + " passes");
  for (std::size_t pass = 0; pass < passes; ++pass) {
    require(fits(state.multipliers[pass], mesh_[both_sides.at(pass)].nodes, effects_.scalar_fields()),
            "multipliers of pass " + std::to_string(pass));
  }
}

void ContactInterface::restore(State state) {
  check(state);
  std::vector<bool> noticed(noticed_.size(), false);
  for (const int node : state.noticed) noticed[static_cast<std::size_t>(node)] = true;
  if (noticed != noticed_) {
    noticed_ = std::move(noticed);
    passes_.erase(passes_.begin() + 1, passes_.end());
    if (!state.noticed.empty()) limit_second_pass();
    for (Matrix3Xd& position : position_) position.resize(3, 0);
  }
  for (std::size_t pass = 0; pass < passes_.size(); ++pass) {
    passes_[pass].integral->multipliers = std::move(state.multipliers[pass]);
  }
  end_iterations();
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
    add(other(pass.side), pass.faced ? *pass.faced : in_contact_of(facing_nodes(pass, own)));
  }
  return in_contact;
}

std::vector<FacingNode> ContactInterface::facing_nodes(const Pass& pass, const std::vector<bool>& in_contact) const {
  const Side side = other(pass.side);
  std::vector<FacingNode> nodes(static_cast<std::size_t>(mesh_[side].nodes));
  const double reach = search_radius(position_);
  if (!surfaces_within_reach(position_[side], position_[pass.side], reach)) return nodes;
  const std::vector<Facet>& facets = mesh_[pass.side].facets;
  const FacetTree tree(facets, position_[pass.side], box_margin);
  const Matrix3Xd normals = nodal_normals(mesh_[side], position_[side]);
  const VectorXd share = VectorXd::NullaryExpr(static_cast<Index>(in_contact.size()), [&](Index node) {
    return in_contact[static_cast<std::size_t>(node)] ? 1.0 : 0.0;
  });
  in_parallel(nodes.size(), [&](std::size_t index) {
    const auto node = static_cast<Index>(index);
    const Ray ray{position_[side].col(node), normals.col(node), reach, settings_.search_tolerance};
    const std::optional<SurfaceHit> hit = nearest_facing_or_passed(tree, facets, position_[pass.side], ray);
    if (!hit) return;
    const Facet& facet = facets[static_cast<std::size_t>(hit->facet)];
    const int sub_facet = sub_facet_at(facet.type, hit->eta);
    const FacetVector psi = pass.integral->multiplier_shape(hit->facet, sub_facet, hit->eta).value;
    nodes[index] = {hit->facet, hit->gap, psi.dot(facet_values(facet, share)) >= covered};
  });
  return nodes;
}

Balance ContactInterface::balance(const PerSide<SurfaceFields>& fields) const {
  const TaskClock timed = clock(Task::output);
  Balance balance;
  balance.flow = VectorXd::Zero(effects_.scalar_fields());
  std::vector<VectorXd> areas;
  for (const Pass& pass : passes_) {
    const bool integrated = pass.side == Side::primary;
    const double sign = integrated ? 1 : -1;
    VectorXd& area = areas.emplace_back(VectorXd::Zero(mesh_[Side::primary].nodes));
    pass.integral->for_each_contact(fields[pass.side], fields[other(pass.side)], 1.0, [&](const PointContact& contact) {
      const double weight = contact.loads.weight;
      balance.force += sign * weight * contact.loads.traction.value * contact.kinematics.area_vector;
      const Facet& facet = facet_at(contact, Side::primary, integrated);
      const FacetVector shares = area_of_nodes(contact, integrated);
      for (Index a = 0; a < shares.size(); ++a) area[facet.nodes[static_cast<std::size_t>(a)]] += shares[a];
      for (std::size_t k = 0; k < contact.fields.size(); ++k) {
        balance.flow[contact.fields[k]] += sign * weight * contact.kinematics.area *
                                           contact.loads.flux[static_cast<Index>(k)].value;
      }
    });
  }
  balance.area = coverage(areas).sum();
  return balance;
}

VectorXd ContactInterface::coverage(const std::vector<VectorXd>& areas) const {
  const VectorXd& first = areas.front();
  const VectorXd& second = areas.back();  // the same where there is one pass
  if (!settings_.two_pass) return first.cwiseMax(second);
  const auto both = first.array() > 0 && second.array() > 0;
  return both.select(0.5 * (first + second), first + second);
}

NodalOutput ContactInterface::nodal_output(Side side, const PerSide<SurfaceFields>& fields) const {
  const TaskClock timed = clock(Task::output);
  const Index nodes = mesh_[side].nodes;
  const Index scalars = effects_.scalar_fields();
  NodalOutput out{VectorXd::Zero(nodes), VectorXd::Zero(nodes), MatrixXd::Zero(scalars, nodes),
                  MatrixXd::Zero(scalars, nodes), VectorXd::Zero(nodes)};
  VectorXd weight = VectorXd::Zero(nodes);  // area of all passes
  std::vector<VectorXd> areas;
  for (const Pass& pass : passes_) {
    const bool integrated = pass.side == side;
    const double sign = integrated ? 1 : -1;
    VectorXd& area = areas.emplace_back(VectorXd::Zero(nodes));
    pass.integral->for_each_contact(fields[pass.side], fields[other(pass.side)], 1.0, [&](const PointContact& contact) {
      const Facet& facet = facet_at(contact, side, integrated);
      const FacetVector shares = area_of_nodes(contact, integrated);
      const PairVector h = contact.kinematics.jump_weights();
      for (Index a = 0; a < shares.size(); ++a) {
        const int node = facet.nodes[static_cast<std::size_t>(a)];
        area[node] += shares[a];
        out.gap[node] += shares[a] * contact.kinematics.gap;
        out.pressure[node] -= shares[a] * contact.loads.traction.value;
        for (std::size_t k = 0; k < contact.fields.size(); ++k) {
          const auto column = static_cast<Index>(k);
          out.flux(contact.fields[k], node) += sign * shares[a] * contact.loads.flux[column].value;
          out.jump(contact.fields[k], node) += sign * shares[a] * h.dot(contact.values.col(column));
        }
      }
    });
    weight += area;
  }
  out.coverage = coverage(areas);
  const VectorXd mean = inverse_or_zero(weight);
  out.gap.array() *= mean.array();
  out.jump = out.jump * mean.asDiagonal();
  // Passes that cover the same area share its load: each integrates a part of it.
  const VectorXd per_area = inverse_or_zero(out.coverage);
  out.pressure.array() *= per_area.array();
  out.flux = out.flux * per_area.asDiagonal();
  return out;
}

const Facet& ContactInterface::facet_at(const PointContact& contact, Side side, bool integrated) const {
  const int facet = integrated ? contact.pair->primary : contact.pair->secondary;
  return mesh_[side].facets[static_cast<std::size_t>(facet)];
}

void ContactInterface::update_properties(PerSide<VectorXd> stiffness, PerSide<MatrixXd> conductance) {
  for (const Side side : both_sides) {
    mesh_[side].stiffness = std::move(stiffness[side]);
    mesh_[side].conductance = std::move(conductance[side]);
  }
  for (const Pass& pass : passes_) pass.integral->update_penalties();
}

void ContactInterface::update_laws(const Settings& settings) {
  settings_.tolerances = settings.tolerances;
  if (same_penalties(settings_, settings)) return;
  settings_.traction = settings.traction;
  settings_.solvent = settings.solvent;
  settings_.solute = settings.solute;
  settings_of_noticed_ = beside(settings_);
  for (const Pass& pass : passes_) pass.integral->update_penalties();
}

}  // namespace mixture_contact
