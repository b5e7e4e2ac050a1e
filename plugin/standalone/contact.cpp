#include "contact.h"

#include "error.h"
#include "hexahedron.h"
#include "host/membrane.h"

#include <algorithm>
#include <limits>
#include <set>

namespace standalone {
namespace {

using mixture_contact::both_sides;
using mixture_contact::Facet;
using mixture_contact::Side;

/// Distinct nodes of facets, ascending.
std::vector<int> nodes_of(const std::vector<SurfaceFacet>& facets) {
  std::set<int> nodes;
  for (const SurfaceFacet& facet : facets)
    nodes.insert(facet.facet.nodes.begin(), facet.facet.nodes.begin() + node_count(facet.facet.type));
  return {nodes.begin(), nodes.end()};
}

}  // namespace

Contact::Contact(const Model& model, const ContactDefinition& definition, const Bodies& bodies)
    : model_(model), definition_(definition), bodies_(bodies) {
  for (const Side side : both_sides) {
    facets_[side] = model.mesh.surfaces.at(definition.surfaces[side]);
    nodes_[side] = nodes_of(facets_[side]);
  }
  const FacetMaterials at_rest = materials(MatrixXd::Zero(model.dofs(), model.mesh.nodes.cols()));
  const mixture_contact::Effects effects = decide_effects(at_rest);
  PerSide<mixture_contact::SurfaceMesh> meshes{{surface_mesh(Side::primary), surface_mesh(Side::secondary)}};
  for (const Side side : both_sides) set_materials(meshes[side], at_rest[side], effects);
  mixture_contact::find_joined_nodes(meshes, nodes_);
  core_ = std::make_unique<mixture_contact::ContactInterface>(meshes, effects, core_settings(definition.parameters));
  if (!core_->pass(0).penalty().traction.allFinite()) {
    throw InputError(
        model.file + ": contact \"" + definition.name +
        "\": both surfaces are rigid, so there is no stiffness to choose a penalty from; set <penalty> and leave "
        "<auto_penalty> at 0");
  }
}

Motion Contact::motion() const {
  if (left_out(definition_.parameters).contact) return Motion::untouched;
  return can_move() ? Motion::possible : Motion::impossible;
}

bool Contact::can_move() const {
  std::set<int> fixed;
  for (const Condition& condition : model_.prescribed) {
    for (const int node : condition.nodes) {
      if (condition.fixed) fixed.insert(model_.place(condition.dof, node));
    }
  }
  const auto moves = [&](int node) {
    return fixed.count(model_.place(0, node)) + fixed.count(model_.place(1, node)) +
               fixed.count(model_.place(2, node)) <
           3;
  };
  return std::any_of(both_sides.begin(), both_sides.end(),
                     [&](Side side) { return std::any_of(nodes_[side].begin(), nodes_[side].end(), moves); });
}

FacetMaterial Contact::material(const SurfaceFacet& facet, const MatrixXd& values) const {
  const auto element = entries(facet.element);
  const Material& material = bodies_.material(element);
  FacetMaterial found;
  Vector3d area(0, 0, 0);
  for (const FacetPoint& point : facet_points(facet.facet, model_.mesh.nodes)) area += point.area;
  const double thickness = bodies_.volume(element) / area.norm();
  found.thickness = thickness;
  found.stiffness = std::numeric_limits<double>::infinity();
  if (material.rigid) return found;
  found.stiffness = material.modulus / thickness;
  found.permeable = material.porous;
  found.permeability = material.permeability / thickness;
  if (material.solute) {
    const Solute& solute = *material.solute;
    const double convection = std::abs(bodies_.average(element, values).solvent_flux.dot(area.normalized()));
    const double spread = (1 - material.solid_fraction) * solute.diffusivity / thickness;
    const double carried = solute.diffusivity / solute.free_diffusivity * convection;
    found.solutes[solute.index] = solute.solubility * (spread + carried);
  }
  return found;
}

FacetMaterials Contact::materials(const MatrixXd& values) const {
  FacetMaterials all;
  for (const Side side : both_sides) {
    for (const SurfaceFacet& facet : facets_[side]) all[side].push_back(material(facet, values));
  }
  return all;
}

mixture_contact::Effects Contact::decide_effects(const FacetMaterials& materials) {
  std::vector<FieldAtContact> fields = fields_at_contact(materials, definition_.surfaces, model_.solutes);
  leave_out(left_out(definition_.parameters), fields);
  const ContactParameters& parameters = definition_.parameters;
  const FrictionRequest friction{has_friction(parameters), is_relieved_by_fluid(parameters) && has_fluid(materials)};
  const Exchange exchange = decide_exchange(parameters.effects, fields, motion(), friction);
  if (!exchange.complaints.empty())
    throw InputError(model_.file + ": contact \"" + definition_.name + "\": " + exchange.complaints.front());
  const std::vector<std::string> wrong = membrane_complaints(parameters.membrane, exchange.effects);
  if (!wrong.empty()) throw InputError(model_.file + ": contact \"" + definition_.name + "\": " + wrong.front());
  effects_line_ = "sliding-mixture \"" + definition_.name + "\" exchanges " + exchange.summary;
  for (const std::string& notice : membrane_notices(parameters, exchange.effects)) effects_line_ += " " + notice;
  return exchange.effects;
}

mixture_contact::SurfaceMesh Contact::surface_mesh(Side side) const {
  const std::vector<int>& nodes = nodes_[side];
  mixture_contact::SurfaceMesh mesh;
  mesh.nodes = number_of(nodes);
  for (const SurfaceFacet& facet : facets_[side]) {
    Facet local = facet.facet;
    for (int a = 0; a < node_count(local.type); ++a) {
      int& node = at(local.nodes, a);
      node = static_cast<int>(std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin());
    }
    mesh.facets.push_back(local);
  }
  return mesh;
}

void Contact::update_laws(double time, double dt, const mixture_contact::ReducedPenalty& reduction) {
  ContactParameters now = definition_.parameters;
  now.ambient.pressure = definition_.ambient_pressure.at(time, model_.curves);
  mixture_contact::Settings settings = core_settings(now, SolverKind::newton, reduction);
  settings.solvent.time_step = dt;
  core_->update_laws(settings);
}

bool Contact::has_reducible_penalty() const {
  return core_->effects().traction && is_reducible(definition_.parameters, SolverKind::newton);
}

void Contact::update_properties(const MatrixXd& values) { update_materials(*core_, materials(values)); }

Contact::PerSide<Matrix3Xd> Contact::positions(const MatrixXd& values) const {
  PerSide<Matrix3Xd> all;
  for (const Side side : both_sides)
    all[side] = model_.mesh.nodes(Eigen::all, nodes_[side]) + values.topRows<3>()(Eigen::all, nodes_[side]);
  return all;
}

int Contact::field_dof(int field) const {
  const int solute = solute_of(core_->effects(), field);
  return solute < 0 ? pressure_dof : concentration_dof(solute);
}

Contact::PerSide<mixture_contact::SurfaceFields> Contact::fields(const MatrixXd& values) const {
  PerSide<mixture_contact::SurfaceFields> all;
  PerSide<Matrix3Xd> position = positions(values);
  const int count = core_->effects().nodal_fields();
  for (const Side side : both_sides) {
    all[side].position = std::move(position[side]);
    all[side].scalar.resize(count_of(nodes_[side]), count);
    for (int k = 0; k < count; ++k) all[side].scalar.col(k) = values(field_dof(k), nodes_[side]).transpose();
  }
  return all;
}

std::vector<int> Contact::places(const mixture_contact::ContactInterface::Location& where) const {
  const mixture_contact::LocalLayout layout = where.patch.layout();
  mixture_contact::IndexedVector<int> all(layout.size());
  for (Index a = 0; a < layout.nodes(); ++a) {
    const Side side = a < layout.primary_nodes() ? where.first : other(where.first);
    const int node = at(nodes_[side], where.patch.node(a));
    for (int i = 0; layout.has_displacements() && i < 3; ++i) {
      all[layout.displacement(a, i)] = model_.place(i, node);
    }
    for (Index k = 0; k < layout.scalar_fields(); ++k) {
      const int dof = field_dof(where.patch.fields[k]);
      all[layout.scalar(a, k)] = model_.place(dof, node);
    }
  }
  return all;
}

}  // namespace standalone
