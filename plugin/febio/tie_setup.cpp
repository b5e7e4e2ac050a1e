#include "tie_setup.h"

#include "contact_setup.h"
#include "host/cohesive_zone.h"
#include "material_properties.h"
#include "present_step.h"
#include "surface_materials.h"

#include <FECore/FEModel.h>

#include <utility>

using namespace mixture_contact;

namespace {

/// The reasons why two surfaces of a model cannot be tied, one sentence each.
std::vector<std::string> obstacles(FEModel& fem, const ContactSurfaces& surfaces) {
  std::vector<std::string> found;
  if (fem.MeshAdaptors() > 0) {
    found.emplace_back(
        "the model has a mesh adaptor, and a tie cannot change its nodes. Leave the adaptor out, or use "
        "sliding-mixture with <tension>1</tension>.");
  }
  if (surfaces.common_facets() > 0) {
    found.emplace_back(
        "its surfaces have facets in common, which are already joined. Give each body its own nodes and its own surface.");
  }
  return found;
}

}  // namespace

bool TieSetup::check() const {
  std::vector<std::string> wrong = tie_complaints(parameters_);
  for (std::string& obstacle : obstacles(fem(), surfaces())) wrong.push_back(std::move(obstacle));
  log_.errors(wrong);
  for (const std::string& sentence : notices(parameters_)) log_.say(sentence);
  return wrong.empty() && have_known_facets(surfaces(), log_);
}

std::optional<FacetMaterials> TieSetup::materials() const {
  std::optional<FacetMaterials> found = facet_materials(fem(), surfaces(), log_);
  const bool is_given = parameters_.penalties.traction.given && !parameters_.penalties.auto_penalty;
  if (found && !is_given && lack_stiffness((*found)[Side::primary], (*found)[Side::secondary]))
    stand_in_for_rigid_bodies(fem(), *found);
  return found;
}

std::optional<Effects> TieSetup::effects(const FacetMaterials& materials) const {
  std::vector<std::string> names = solute_names(fem());
  names.resize(indexing::entries(dofs_.concentrations()));
  std::vector<FieldAtContact> fields = fields_at_contact(materials, surfaces().names(), names);
  if (dofs_.pressure(false) < 0) fields.front().obstacles = {"the module has no fluid pressure"};
  const Exchange exchange = tie_exchange(parameters_, fields);
  log_.errors(exchange.complaints);
  if (!exchange.complaints.empty()) return std::nullopt;
  log_.line(log_.title() + " exchanges " + exchange.summary);
  if (exchange.effects.scalar_fields() <= max_scalar_fields) return exchange.effects;
  log_.error("the surfaces share " + std::to_string(exchange.effects.scalar_fields()) + " fields; at most " +
             std::to_string(max_scalar_fields) + " are supported.");
  return std::nullopt;
}

PerSide<SurfaceMesh> TieSetup::meshes(const FacetMaterials& materials, const Effects& effects) const {
  PerSide<SurfaceMesh> meshes;
  for (const Side side : both_sides) meshes[side] = surface_mesh(surfaces()[side], materials[side], effects);
  return meshes;
}

std::unique_ptr<Tie> TieSetup::build() const {
  const auto found = materials();
  const auto exchanged = found ? effects(*found) : std::nullopt;
  if (!exchanged) return nullptr;
  PerSide<SurfaceMesh> mesh = meshes(*found, *exchanged);
  const PerSide<Matrix3Xd> reference = surfaces().positions();
  const Settings chosen = settings();
  IndexedVector<TiedNode> nodes = find_tied_nodes(mesh, *exchanged, chosen, reference, breaking());
  if (nodes.empty()) {
    log_.error("no node of the primary surface \"" + surfaces().names()[Side::primary] + "\" faces \"" +
               surfaces().names()[Side::secondary] +
               "\" within the search radius, and nothing is tied. Set <search_radius> to more than their distance, "
               "or set <flip_primary> or <flip_secondary> if normals point into a body.");
    return nullptr;
  }
  auto tie = std::make_unique<Tie>(std::move(mesh), *exchanged, std::move(nodes), breaking());
  tie->set_laws(chosen);
  if (!tie->penalties().traction.allFinite()) {
    log_.error(
        "both surfaces are rigid and no material has a modulus, so the penalty cannot follow from a stiffness. Set "
        "<penalty> to a value [force/length^3] and <auto_penalty> to 0, or <E> of a rigid material.");
    return nullptr;
  }
  if (!can_break(*tie)) return nullptr;
  if (tie->unknown_count() > 0 && !can_solve_for_multipliers(fem(), dofs_, log_)) return nullptr;
  return tie;
}

bool TieSetup::can_break(const Tie& tie) const {
  if (!may_break(tie.breaking())) return true;
  std::string wrong;
  if (!tie.effects().traction) wrong = "<max_traction> is set, and <effects> omits traction: nothing can break.";
  if (solver_kind_of(fem()) != SolverKind::newton)
    wrong = "<max_traction> is set, and the solver is not a Newton solver: a tie cannot break with it.";
  if (wrong.empty()) wrong = penalty_complaint(tie);
  if (!wrong.empty()) log_.error(wrong);
  return wrong.empty();
}

void TieSetup::judge_cohesive_zone(const Tie& tie) const {
  const auto found = std::holds_alternative<Cohesive>(tie.breaking()) ? materials() : std::nullopt;
  if (!found) return;
  const std::string line = cohesive_zone_line(tie, *found, surfaces().positions());
  if (!line.empty()) log_.warning(line);
}

void TieSetup::say_what_is_tied(const Tie& tie) const {
  const UntiedNodes untied = untied_nodes(tie.nodes(), tie.mesh(), tie.settings(), surfaces().positions());
  log_.say(tied_nodes_line(tie.nodes().count(), untied));
}

Matrix3Xd TieSetup::relocated(const Tie& tie) const {
  return without_gaps(tie.nodes(), tie.mesh(), tie.settings(), surfaces().positions());
}

Settings TieSetup::settings() const {
  return tie_settings(parameters_, solver_kind_of(fem()), storing_time_step(fem()), breaking());
}

BreakingLaw TieSetup::breaking() const { return breaking_law(parameters_.breaking, fem().GetTime().timeIncrement); }

bool TieSetup::update(Tie& tie) const {
  const std::vector<std::string> wrong = tie_complaints(parameters_);
  log_.errors(wrong);
  if (!wrong.empty()) return false;
  if (reads_properties_again(parameters_, tie.effects())) {
    if (const auto found = materials()) tie.set_meshes(meshes(*found, tie.effects()));
  }
  tie.set_laws(settings(), breaking());
  return can_break(tie);
}
