#include "contact.h"

#include "contact/quadrature.h"

#include <algorithm>
#include <limits>
#include <set>

namespace standalone {
namespace {

using mixture_contact::both_sides;
using mixture_contact::Facet;
using mixture_contact::only;

/// The facet seen from the other side.
Facet inverted(const Facet& facet) {
  const std::array<std::size_t, 8> order{0, 3, 2, 1, 7, 6, 5, 4};
  Facet turned = facet;
  for (std::size_t a = 0; a < static_cast<std::size_t>(mixture_contact::node_count(facet.type)); ++a) {
    turned.nodes[a] = facet.nodes[order[a]];
  }
  return turned;
}

/// Integral of the area vector over a facet: its direction is the normal [mm^2].
Vector3d area_vector(const Facet& facet, const Matrix3Xd& position) {
  Vector3d sum(0, 0, 0);
  const auto x = mixture_contact::facet_coordinates(facet, position);
  for (const auto& point :
       mixture_contact::quadrature(facet.type, mixture_contact::default_quadrature_order(facet.type))) {
    const Eigen::Matrix<double, 3, 2> tangents = x * mixture_contact::shape_functions(facet.type, point.xi).gradient;
    sum += point.weight * tangents.col(0).cross(tangents.col(1));
  }
  return sum;
}

}  // namespace

Contact::Contact(const Model& model, const ContactDefinition& definition, const Bodies& bodies, int first_row)
    : model_(model), definition_(definition), bodies_(bodies), first_row_(first_row) {
  for (const Side side : both_sides) {
    facets_[side] = model.mesh.surfaces.at(definition.surfaces[static_cast<std::size_t>(side)]);
    const bool flip = side == Side::primary ? definition.parameters.flip_primary : definition.parameters.flip_secondary;
    std::set<int> nodes;
    for (SurfaceFacet& facet : facets_[side]) {
      if (flip) facet.facet = inverted(facet.facet);
      nodes.insert(facet.facet.nodes.begin(),
                   facet.facet.nodes.begin() + mixture_contact::node_count(facet.facet.type));
    }
    nodes_[side].assign(nodes.begin(), nodes.end());
  }
  decide_effects();
  const MatrixXd start = MatrixXd::Zero(model.dofs(), model.mesh.nodes.cols());
  core_ = std::make_unique<mixture_contact::ContactInterface>(
      PerSide<mixture_contact::SurfaceMesh>{{surface_mesh(Side::primary, start), surface_mesh(Side::secondary, start)}},
      effects_, core_settings(definition.parameters));
  if (!core_->pass(0).penalty().traction.allFinite()) {
    throw InputError(
        model.file + ": contact \"" + definition.name +
        "\": both surfaces are rigid, so there is no stiffness to choose a penalty from; set <penalty> and leave "
        "<auto_penalty> at 0");
  }
}

std::vector<FieldAtContact> Contact::fields_of_model() const {
  const auto obstacles = [&](const auto& has, const char* lacking) {
    std::vector<std::string> list;
    for (const Side side : both_sides) {
      const auto behind = [&](const SurfaceFacet& facet) {
        return has(bodies_.material(static_cast<std::size_t>(facet.element)));
      };
      if (std::none_of(facets_[side].begin(), facets_[side].end(), behind))
        list.push_back("\"" + definition_.surfaces[static_cast<std::size_t>(side)] + "\" " + lacking);
    }
    return list;
  };
  std::vector<FieldAtContact> fields;
  fields.push_back({-1, "", obstacles([](const Material& m) { return m.porous; }, "is impermeable")});
  for (int solute = 0; solute < model_.solutes; ++solute) {
    const auto has_it = [solute](const Material& m) {
      return std::any_of(m.solutes.begin(), m.solutes.end(), [solute](const Solute& s) { return s.index == solute; });
    };
    const auto name = model_.solute_names.find(solute);
    fields.push_back(
        {solute, name == model_.solute_names.end() ? "" : name->second, obstacles(has_it, "does not have it")});
  }
  return fields;
}

bool Contact::can_move() const {
  std::array<std::set<int>, 3> fixed;
  for (const Condition& condition : model_.prescribed) {
    const bool zero = condition.value.value == 0 && condition.value.curve < 0;
    if (zero && condition.dof < 3)
      fixed[static_cast<std::size_t>(condition.dof)].insert(condition.nodes.begin(), condition.nodes.end());
  }
  const auto is_held = [&](int node) {
    return std::all_of(fixed.begin(), fixed.end(), [node](const auto& nodes) { return nodes.count(node) > 0; });
  };
  const auto is_rigid = [&](const SurfaceFacet& facet) {
    return bodies_.material(static_cast<std::size_t>(facet.element)).rigid;
  };
  return !std::all_of(both_sides.begin(), both_sides.end(), [&](Side side) {
    return std::all_of(nodes_[side].begin(), nodes_[side].end(), is_held) &&
           std::none_of(facets_[side].begin(), facets_[side].end(), is_rigid);
  });
}

void Contact::decide_effects() {
  const Motion motion = can_move() ? Motion::possible : Motion::impossible;
  const Exchange exchange = decide_exchange(definition_.parameters.effects, fields_of_model(), motion);
  if (!exchange.complaints.empty())
    throw InputError(model_.file + ": contact \"" + definition_.name + "\": " + exchange.complaints.front());
  effects_ = exchange.effects;
  effects_line_ = "sliding-mixture \"" + definition_.name + "\" exchanges " + exchange.summary;
}

mixture_contact::SurfaceMesh Contact::surface_mesh(Side side, const MatrixXd& values) const {
  mixture_contact::SurfaceMesh mesh;
  const auto count = static_cast<Index>(facets_[side].size());
  mesh.nodes = static_cast<int>(nodes_[side].size());
  mesh.stiffness.resize(count);
  mesh.conductance.setZero(effects_.scalar_fields(), count);
  for (Index f = 0; f < count; ++f) {
    const SurfaceFacet& facet = facets_[side][static_cast<std::size_t>(f)];
    const auto element = static_cast<std::size_t>(facet.element);
    const Material& material = bodies_.material(element);
    const Vector3d area = area_vector(facet.facet, model_.mesh.nodes);
    const double thickness = bodies_.volume(element) / area.norm();
    const Vector3d flow = bodies_.average(element, values).solvent_flux;
    const double convection = std::abs(flow.dot(area.normalized()));
    mesh.stiffness[f] = material.rigid ? std::numeric_limits<double>::infinity() : material.modulus / thickness;
    mixture_contact::FieldMask known = 0;
    if (effects_.solvent && material.porous) {
      known |= only(0);
      mesh.conductance(0, f) = material.permeability / thickness;
    }
    for (const Solute& solute : material.solutes) {
      const auto shared = std::find(effects_.solutes.begin(), effects_.solutes.end(), solute.index);
      if (shared == effects_.solutes.end()) continue;
      const auto field = static_cast<int>(shared - effects_.solutes.begin()) + (effects_.solvent ? 1 : 0);
      known |= only(field);
      const double spread = (1 - material.solid_fraction) * solute.diffusivity / thickness;
      const double carried = solute.diffusivity / solute.free_diffusivity * convection;
      mesh.conductance(field, f) = solute.solubility * (spread + carried);
    }
    mesh.permeable.push_back(known);
    Facet local = facet.facet;
    for (int a = 0; a < mixture_contact::node_count(local.type); ++a) {
      int& node = local.nodes[static_cast<std::size_t>(a)];
      node = static_cast<int>(std::lower_bound(nodes_[side].begin(), nodes_[side].end(), node) - nodes_[side].begin());
    }
    mesh.facets.push_back(local);
  }
  return mesh;
}

void Contact::update_properties(const MatrixXd& values) {
  PerSide<VectorXd> stiffness;
  PerSide<MatrixXd> conductance;
  for (const Side side : both_sides) {
    const mixture_contact::SurfaceMesh mesh = surface_mesh(side, values);
    stiffness[side] = mesh.stiffness;
    conductance[side] = mesh.conductance;
  }
  core_->update_properties(stiffness, conductance);
}

Contact::PerSide<Matrix3Xd> Contact::positions(const MatrixXd& values) const {
  PerSide<Matrix3Xd> all;
  for (const Side side : both_sides) {
    all[side].resize(3, static_cast<Index>(nodes_[side].size()));
    for (Index i = 0; i < all[side].cols(); ++i) {
      const int node = nodes_[side][static_cast<std::size_t>(i)];
      all[side].col(i) = model_.mesh.nodes.col(node) + values.col(node).head<3>();
    }
  }
  return all;
}

void Contact::project(const MatrixXd& values, bool keep_facets) {
  using Search = mixture_contact::ContactInterface::Search;
  core_->project(positions(values), keep_facets ? Search::same_facets : Search::everywhere);
}

int Contact::field_dof(int field) const {
  if (effects_.solvent && field == 0) return pressure_dof;
  return concentration_dof(effects_.solutes[static_cast<std::size_t>(field - (effects_.solvent ? 1 : 0))]);
}

Contact::PerSide<mixture_contact::SurfaceFields> Contact::fields(const MatrixXd& values) const {
  PerSide<mixture_contact::SurfaceFields> all;
  PerSide<Matrix3Xd> position = positions(values);
  for (const Side side : both_sides) {
    all[side].position = std::move(position[side]);
    all[side].scalar.resize(static_cast<Index>(nodes_[side].size()), effects_.scalar_fields());
    for (int k = 0; k < effects_.scalar_fields(); ++k) {
      for (Index i = 0; i < all[side].scalar.rows(); ++i) {
        all[side].scalar(i, k) = values(field_dof(k), nodes_[side][static_cast<std::size_t>(i)]);
      }
    }
  }
  return all;
}

Contact::Dofs Contact::dofs(const mixture_contact::ContactInterface::Location& at) const {
  const mixture_contact::Patch& patch = at.patch;
  const mixture_contact::LocalLayout layout = patch.layout();
  const int own = nodes_[at.first][static_cast<std::size_t>(patch.multiplier_node.value_or(0))];
  Dofs all(static_cast<std::size_t>(layout.size()), {first_row_, own});  // also the void places beside the multipliers
  for (Index a = 0; a < layout.nodes(); ++a) {
    const bool first = a < layout.primary_nodes();
    const auto local = static_cast<std::size_t>(first ? a : a - layout.primary_nodes());
    const int index = first ? patch.primary[local] : patch.secondary[local];
    const int node = nodes_[first ? at.first : other(at.first)][static_cast<std::size_t>(index)];
    for (int i = 0; layout.has_displacements() && i < 3; ++i) {
      all[static_cast<std::size_t>(layout.displacement(a, i))] = {i, node};
    }
    for (Index k = 0; k < layout.scalar_fields(); ++k) {
      const int dof = field_dof(patch.fields[static_cast<std::size_t>(k)]);
      all[static_cast<std::size_t>(layout.scalar(a, k))] = {dof, node};
    }
  }
  if (!patch.multiplier_node) return all;
  for (Index k = 0; k < layout.scalar_fields(); ++k) {
    const int row = first_row_ + 1 + patch.fields[static_cast<std::size_t>(k)];
    all[static_cast<std::size_t>(layout.flux_multiplier(k))] = {row, own};
  }
  return all;
}

int Contact::multiplier_rows() const {
  return core_->multiplier_layout().size() > 0 ? 1 + effects_.scalar_fields() : 0;
}

Contact::Dofs Contact::multipliers() const {
  const mixture_contact::MultiplierLayout layout = core_->multiplier_layout();
  Dofs all(static_cast<std::size_t>(layout.size()));
  for (Index i = 0; i < layout.size() / std::max(1, multiplier_rows()); ++i) {
    const int node = nodes_[Side::primary][static_cast<std::size_t>(i)];
    all[static_cast<std::size_t>(layout.traction(i))] = {first_row_, node};
    for (int k = 0; k < effects_.scalar_fields(); ++k) {
      all[static_cast<std::size_t>(layout.flux(i, k))] = {first_row_ + 1 + k, node};
    }
  }
  return all;
}

void Contact::take_multipliers(const MatrixXd& values) {
  const Dofs places = multipliers();
  if (places.empty()) return;
  VectorXd mu(places.size());
  Index entry = 0;
  for (const auto& [row, node] : places) mu[entry++] = values(row, node);
  core_->set_unknown_multipliers(mu);
}

Matrix3Xd Contact::nodes_without_overlap() {
  const PerSide<Matrix3Xd> start = positions(MatrixXd::Zero(3, model_.mesh.nodes.cols()));
  core_->project(start);
  const Matrix3Xd moved = core_->without_overlap(start);
  Matrix3Xd nodes = model_.mesh.nodes;
  for (Index i = 0; i < moved.cols(); ++i) nodes.col(nodes_[Side::primary][static_cast<std::size_t>(i)]) = moved.col(i);
  return nodes;
}

void Contact::for_each_residual(const MatrixXd& values, double dt,
                                const std::function<void(const Dofs&, const VectorXd&)>& add) const {
  using Location = mixture_contact::ContactInterface::Location;
  core_->residual(fields(values), dt, [&](const Location& at, const VectorXd& local) { add(dofs(at), local); });
}

void Contact::for_each_tangent(const MatrixXd& values, double dt,
                               const std::function<void(const Dofs&, const Dofs&, const MatrixXd&)>& add) const {
  using Location = mixture_contact::ContactInterface::Location;
  core_->tangent(fields(values), dt, [&](const Location& rows, const Location& columns, const MatrixXd& local) {
    add(dofs(rows), dofs(columns), local);
  });
}

Contact::Saved Contact::save() {
  Saved saved;
  for (std::size_t pass = 0; pass < core_->passes(); ++pass) saved.push_back(core_->multipliers(pass));
  return saved;
}

void Contact::restore(const Saved& saved) {
  for (std::size_t pass = 0; pass < core_->passes(); ++pass) core_->multipliers(pass) = saved[pass];
  core_->end_iterations();
}

}  // namespace standalone
