#include "tied_contact.h"

#include "error.h"
#include "host/tie_parameters.h"

#include <utility>

namespace standalone {

using mixture_contact::Settings;
using mixture_contact::Tie;

TiedContact::TiedContact(ContactDefinition definition, const Bodies& bodies)
    : definition_(std::move(definition)), surfaces_(definition_.surfaces, bodies) {
  const Model& model = bodies.model();
  const MatrixXd at_rest = MatrixXd::Zero(model.dofs(), model.mesh.nodes.cols());
  const FacetMaterials materials = surfaces_.materials(at_rest);
  const mixture_contact::Effects effects = decide_effects(materials);
  mixture_contact::PerSide<mixture_contact::SurfaceMesh> meshes = surfaces_.meshes(materials, effects);
  const Settings settings = tie_settings(definition_.parameters, SolverKind::newton, 0);
  const mixture_contact::PerSide<Matrix3Xd> reference = surfaces_.positions(at_rest);
  auto nodes = mixture_contact::find_tied_nodes(meshes, effects, settings, reference);
  if (nodes.empty())
    fail(
        "no node of the primary surface faces the other one within the search radius, and nothing is tied; set "
        "<search_radius> to more than their distance");
  lines_.push_back(title() + " " +
                   tied_nodes_line(nodes.count(), mixture_contact::untied_nodes(nodes, meshes, settings, reference)));
  core_ = std::make_unique<Tie>(std::move(meshes), effects, std::move(nodes));
  core_->set_laws(settings);
  if (!core_->penalties().traction.allFinite()) fail(no_stiffness);
}

void TiedContact::fail(const std::string& what) const {
  throw InputError(surfaces_.model().file + ": " + title() + ": " + what);
}

mixture_contact::Effects TiedContact::decide_effects(const FacetMaterials& materials) {
  const Exchange exchange = tie_exchange(definition_.parameters,
                                         fields_at_contact(materials, definition_.surfaces, surfaces_.model().solutes));
  if (!exchange.complaints.empty()) fail(exchange.complaints.front());
  lines_.push_back(title() + " exchanges " + exchange.summary);
  return exchange.effects;
}

void TiedContact::start_step(const MatrixXd& values, double dt) {
  if (reads_properties_again(definition_.parameters, core_->effects()))
    core_->set_meshes(surfaces_.meshes(surfaces_.materials(values), core_->effects()));
  core_->set_laws(tie_settings(definition_.parameters, SolverKind::newton, dt));
}

Augmentation TiedContact::augment(const MatrixXd& values, int augmentation) const {
  if (core_->settings().enforcement == mixture_contact::Enforcement::penalty) return {};
  const auto now = fields(values);
  return ::augment(title(), core_->gaps(now), core_->settings(), core_->effects(), augmentation,
                   [&] { return core_->augment(now); });
}

}  // namespace standalone
