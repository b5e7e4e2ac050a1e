#include "contact.h"

#include "error.h"
#include "host/friction.h"
#include "host/membrane.h"

namespace standalone {

Contact::Contact(ContactDefinition definition, const Bodies& bodies)
    : definition_(std::move(definition)), surfaces_(definition_.surfaces, bodies) {
  const Model& model = bodies.model();
  const FacetMaterials at_rest = surfaces_.materials(MatrixXd::Zero(model.dofs(), model.mesh.nodes.cols()));
  const mixture_contact::Effects effects = decide_effects(at_rest);
  PerSide<mixture_contact::SurfaceMesh> meshes = surfaces_.meshes(at_rest, effects);
  mixture_contact::find_joined_nodes(meshes, surfaces_.nodes());
  core_ = std::make_unique<mixture_contact::ContactInterface>(meshes, effects, core_settings(definition_.parameters));
  if (!core_->pass(0).penalty().traction.allFinite())
    throw InputError(model.file + ": contact \"" + definition_.name + "\": " + no_stiffness);
}

Motion Contact::motion() const {
  if (left_out(definition_.parameters).contact) return Motion::untouched;
  return surfaces_.can_move() ? Motion::possible : Motion::impossible;
}

mixture_contact::Effects Contact::decide_effects(const FacetMaterials& materials) {
  std::vector<FieldAtContact> fields = fields_at_contact(materials, definition_.surfaces, surfaces_.model().solutes);
  leave_out(left_out(definition_.parameters), fields);
  const ContactParameters& parameters = definition_.parameters;
  const Exchange exchange = decide_exchange(parameters.effects, fields, motion(),
                                            requested_friction(parameters, has_fluid(materials)));
  if (!exchange.complaints.empty())
    throw InputError(surfaces_.model().file + ": contact \"" + definition_.name + "\": " + exchange.complaints.front());
  const std::vector<std::string> wrong = membrane_complaints(parameters.membrane, exchange.effects);
  if (!wrong.empty())
    throw InputError(surfaces_.model().file + ": contact \"" + definition_.name + "\": " + wrong.front());
  effects_line_ = "sliding-mixture \"" + definition_.name + "\" exchanges " + exchange.summary;
  for (const std::string& notice : membrane_notices(parameters, exchange.effects)) effects_line_ += " " + notice;
  return exchange.effects;
}

void Contact::update_laws(double time, double dt, const mixture_contact::ReducedPenalty& reduction) {
  ContactParameters now = definition_.parameters;
  now.ambient.pressure = definition_.ambient_pressure.at(time, surfaces_.model().curves);
  mixture_contact::Settings settings = core_settings(now, SolverKind::newton, reduction);
  settings.solvent.time_step = dt;
  core_->update_laws(settings);
}

bool Contact::has_reducible_penalty() const {
  return core_->effects().traction && is_reducible(definition_.parameters, SolverKind::newton);
}

void Contact::find_immovable_nodes(const std::vector<bool>& free) {
  const auto is_immovable = [&](int node) {
    return !at(free, surfaces_.model().place(0, node)) && !at(free, surfaces_.model().place(1, node)) &&
           !at(free, surfaces_.model().place(2, node));
  };
  PerSide<mixture_contact::NodeFlags> immovable;
  for (const Side side : mixture_contact::both_sides) {
    for (const int node : surfaces_.nodes(side)) immovable[side].push_back(is_immovable(node));
  }
  set_immovable(*core_, std::move(immovable));
}

void Contact::update_properties(const MatrixXd& values) { update_materials(*core_, surfaces_.materials(values)); }

}  // namespace standalone
