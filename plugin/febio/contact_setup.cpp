#include "contact_setup.h"

#include "contact/base/indexed_vector.h"
#include "contact/interface/multipliers.h"
#include "host/friction.h"
#include "host/membrane.h"
#include "material_properties.h"
#include "membrane_values.h"
#include "present_step.h"
#include "surface_materials.h"

#include <FECore/FEAnalysis.h>
#include <FECore/FEElement.h>
#include <FECore/FEMesh.h>
#include <FECore/FEMeshAdaptor.h>
#include <FECore/FEModel.h>
#include <FECore/FENewtonSolver.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

using namespace mixture_contact;

namespace {

/// The number of solid elements that have all of these nodes.
int solids_with(FEMesh& mesh, const std::vector<int>& nodes) {
  FENodeElemList& around = mesh.NodeElementList();
  FEElement** const elements = around.ElementList(nodes.front());
  return indexing::as_int(
      std::count_if(elements, elements + around.Valence(nodes.front()), [&](const FEElement* element) {
        const std::vector<int>& own = element->m_node;
        return element->Class() == FE_ELEM_SOLID && std::all_of(nodes.begin(), nodes.end(), [&](int node) {
                 return std::find(own.begin(), own.end(), node) != own.end();
               });
      }));
}

/// True if a mesh adaptor selects elements by the gaps of contacts, directly or through a filter.
bool is_criterion_of_gaps(FECoreBase& adaptor) {
  for (FECoreBase* criterion = adaptor.GetProperty("criterion"); criterion != nullptr;
       criterion = criterion->GetProperty("data")) {
    if (std::string(criterion->GetTypeStr()) == "contact gap") return true;
  }
  return false;
}

}  // namespace

bool can_solve_for_multipliers(FEModel& fem, const DofMap& dofs, const ContactLog& log) {
  for (int i = 0; i < fem.Steps(); ++i) {
    FESolver* const solver = fem.GetStep(i)->GetFESolver();
    if (solver == nullptr || dynamic_cast<const FENewtonSolver*>(solver) != nullptr) continue;
    log.error(
        "<laugon>LAGMULT</laugon> needs a Newton solver, because its multipliers are unknowns of the matrix. The solver of "
        "step " +
        std::to_string(i + 1) + " is " + solver->GetTypeStr() + ". Use PENALTY or AUGLAG.");
    return false;
  }
  if (dofs.deformable_node() >= 0) return true;
  log.error(
      "both surfaces are rigid, so <laugon>LAGMULT</laugon> has no unknowns. Use PENALTY or "
      "AUGLAG.");
  return false;
}

// ------------------------------------------------------------ checks

bool ContactSetup::has_sound_values() const {
  std::vector<std::string> wrong = complaints(parameters());
  for (const std::string& of_film : membrane_complaints(parameters().membrane, dofs().concentrations()))
    wrong.push_back(of_film);
  log().errors(wrong);
  return wrong.empty();
}

bool ContactSetup::check_parameters(const AmbientConcentrations& ambient) const {
  const bool sound = has_sound_values();
  for (const std::string& sentence : notices(parameters())) log().say(sentence);
  const bool has_ambient = parameters().ambient.pressure != 0 || !ambient.empty();
  if (has_ambient && !reads_ambient_values(parameters()))
    log().say("ambient values have no effect: <free_draining> is 0.");
  return sound;
}

bool ContactSetup::check_surfaces() const {
  if (!have_known_facets(surfaces(), log())) return false;
  return !parameters().self_contact || have_no_inner_facets();
}

bool ContactSetup::have_no_inner_facets() const {
  for (const Side side : both_sides) {
    FEMixtureSurface& surface = surfaces()[side];
    for (int i = 0; i < surface.Elements(); ++i) {
      if (solids_with(fem().GetMesh(), surface.Element(i).m_node) < 2) continue;
      log().error("the surfaces \"" + surfaces().names()[Side::primary] + "\" and \"" +
                  surfaces().names()[Side::secondary] + "\" have facets in common, and one of \"" + surface.GetName() +
                  "\" lies inside a body, between two elements: nothing can slide there. Give each body its own nodes, "
                  "or select outer faces alone.");
      return false;
    }
  }
  return true;
}

bool ContactSetup::check_ambient(const AmbientConcentrations& ambient) const {
  const double unlimited = std::numeric_limits<double>::infinity();
  const std::string wrong = complaint("ambient_concentration", solute_values(ambient), dofs().concentrations(),
                                      unlimited);
  if (!wrong.empty()) log().error(wrong);
  return wrong.empty();
}

bool ContactSetup::check_mesh_adaptors() const {
  const bool is_lagmult = core_settings(parameters()).enforcement == Enforcement::lagrange_multipliers;
  for (int i = 0; i < fem().MeshAdaptors(); ++i) {
    FEMeshAdaptor& adaptor = *fem().MeshAdaptor(i);
    if (is_lagmult) {
      log().error("<laugon>LAGMULT</laugon> is set, and the model has a mesh adaptor (" +
                  std::string(adaptor.GetTypeStr()) +
                  "): FEBio cannot repeat a step in which the number of unknowns has changed. Use AUGLAG, or PENALTY.");
      return false;
    }
    const FEParam* const erodes = adaptor.GetParameter("erode_surfaces");
    if (erodes != nullptr && erodes->type() == FE_PARAM_INT && erodes->value<int>() == 0)
      log().say("<erode_surfaces> of the mesh adaptor is 0: facets of eroded elements remain in contact.");
    if (!parameters().penalties.traction.given && is_criterion_of_gaps(adaptor))
      log().say(
          "the mesh adaptor's criterion \"contact gap\" measures the overlap of the surfaces, which the automatic penalty "
          "hardly allows. Set <penalty> to the value for which you chose the criterion.");
  }
  return true;
}

bool ContactSetup::has_penalty() const {
  if (contact_.core().pass(0).penalty().traction.allFinite()) return true;
  log().error(
      "both surfaces are rigid and no material has a modulus, so the penalty cannot follow from a stiffness. Set "
      "<penalty> to a value [force/length^3] and <auto_penalty> to 0, or <E> of a rigid material.");
  return false;
}

bool ContactSetup::can_have_multipliers() const {
  return multiplier_layout(contact_.core()).size() == 0 || can_solve_for_multipliers(fem(), dofs(), log());
}

// ------------------------------------------------------------ materials

bool ContactSetup::lacks_stiffness(const FacetMaterials& materials) const {
  if (parameters().penalties.traction.given && !parameters().penalties.auto_penalty) return false;
  const auto& primary = materials[Side::primary];
  const auto& secondary = materials[Side::secondary];
  return lack_stiffness(primary, secondary) ||
         (parameters().enforcement.two_pass && lack_stiffness(secondary, primary));
}

std::optional<FacetMaterials> ContactSetup::materials() const {
  std::optional<FacetMaterials> materials = facet_materials(fem(), surfaces(), log());
  if (!materials || !lacks_stiffness(*materials)) return materials;
  stand_in_for_rigid_bodies(fem(), *materials);
  return materials;
}

void ContactSetup::say_stand_in() const {
  const auto found = facet_materials(fem(), surfaces(), log());
  if (!found || !lacks_stiffness(*found) || !(modulus_of_rigid_bodies(fem()) > 0)) return;
  std::ostringstream text;
  text
      << "both surfaces are rigid. The automatic penalty uses a modulus of " << modulus_of_rigid_bodies(fem())
      << ", the largest among <E>/(1 - <v>^2) of the rigid materials and the moduli of the deformable ones. Set <penalty> "
      << "[force/length^3] for a value of your own.";
  log().say(text.str());
}

std::vector<FieldAtContact> ContactSetup::fields_of_model(const FacetMaterials& materials) const {
  std::vector<std::string> names = solute_names(fem());
  names.resize(indexing::entries(dofs().concentrations()));
  std::vector<FieldAtContact> fields = fields_at_contact(materials, surfaces().names(), names);
  if (dofs().pressure(false) < 0) fields.front().obstacles = {"the module has no fluid pressure"};
  leave_out(left_out(parameters()), fields);
  return fields;
}

mixture_contact::FrictionKind ContactSetup::friction_of_model(const FacetMaterials& materials) const {
  return requested_friction(parameters(), dofs().pressure(false) >= 0 && has_fluid(materials));
}

std::optional<Effects> ContactSetup::effects(const FacetMaterials& materials) {
  fields_at_contact_ = fields_of_model(materials);
  friction_ = friction_of_model(materials);
  const Exchange exchange = decide_exchange(parameters().effects, fields_at_contact_, Motion::undecided, friction_);
  log().errors(exchange.complaints);
  if (!exchange.complaints.empty()) return std::nullopt;
  const std::vector<std::string> wrong = membrane_complaints(parameters().membrane, exchange.effects);
  log().errors(wrong);
  if (!wrong.empty()) return std::nullopt;
  for (const std::string& sentence : membrane_notices(parameters(), exchange.effects)) log().say(sentence);
  const int fields = exchange.effects.nodal_fields();
  if (fields <= max_scalar_fields) return exchange.effects;
  log().error("the surfaces share " + std::to_string(fields) + " fields; at most " + std::to_string(max_scalar_fields) +
              " are supported.");
  return std::nullopt;
}

bool ContactSetup::build() {
  crossing_.reset();  // the surfaces may have changed
  const auto found = materials();
  const auto exchanged = found ? effects(*found) : std::nullopt;
  if (!exchanged) return false;
  PerSide<SurfaceMesh> meshes;
  for (const Side side : both_sides) meshes[side] = surface_mesh(surfaces()[side], (*found)[side], *exchanged);
  const NodeNumbers numbers = surfaces().node_numbers();
  if (parameters().self_contact) {
    for (const Side side : both_sides) meshes[side].node_ids = numbers[side];
  } else if (surfaces()[Side::primary].has_shell_bottoms() == surfaces()[Side::secondary].has_shell_bottoms()) {
    find_joined_nodes(meshes, {{numbers[Side::primary], numbers[Side::secondary]}});
  }
  contact_.build(std::move(meshes), *exchanged);
  say_stand_in();
  return has_penalty() && can_have_multipliers();
}

void ContactSetup::update_properties() const {
  if (const auto found = materials()) update_materials(contact_.core(), *found);
}

SolverKind ContactSetup::solver_kind() {
  if (!has_inertia(fem())) return solver_kind_of(fem());
  if (!crossing_) {
    const std::optional<FacetMaterials> found = materials();
    crossing_ = found ? longest_crossing(*found) : 0;
  }
  // The size that the user gave, because a penalty that changed with the step would change the energy of the contact.
  const double dt = fem().GetCurrentStep()->m_dt0;
  return would_rebound(*crossing_, dt) ? SolverKind::implicit_dynamics : SolverKind::newton;
}

void ContactSetup::update_laws(const ReducedPenalty& reduction) {
  Settings settings = core_settings(parameters(), solver_kind(), reduction);
  settings.solvent.time_step = storing_time_step(fem());
  contact_.core().update_laws(settings);
}

void ContactSetup::find_immovable_nodes() const {
  set_immovable(contact_.core(), {{dofs().immovable_nodes(Side::primary), dofs().immovable_nodes(Side::secondary)}});
}

bool ContactSetup::has_reducible_penalty() const { return is_reducible(parameters(), solver_kind_of(fem())); }

bool ContactSetup::follow_load_curves(const AmbientConcentrations& ambient, const ReducedPenalty& reduction) {
  const bool sound = has_sound_values() && check_ambient(ambient);
  if (sound) update_laws(reduction);
  return sound;
}

// ------------------------------------------------------------ traction

Motion ContactSetup::motion() const {
  if (left_out(parameters()).contact) return Motion::untouched;
  const auto is_fixed = [&](const FENode& node, const std::array<int, 3>& dofs) {
    return node.m_rid < 0 &&
           std::all_of(dofs.begin(), dofs.end(), [&](int dof) { return node.get_bc(dof) == DOF_FIXED; });
  };
  for (const Side side : both_sides) {
    FEMixtureSurface& surface = surfaces()[side];
    for (int i = 0; i < surface.Nodes(); ++i) {
      if (!is_fixed(surface.Node(i), dofs().displacements(side))) return Motion::possible;
    }
  }
  return Motion::impossible;
}

bool ContactSetup::decide_traction() {
  // Only the boundary conditions of the present step determine whether a node can move in it. After a restart, the
  // materials have not been read yet.
  if (fields_at_contact_.empty()) {
    if (const auto found = materials()) {
      fields_at_contact_ = fields_of_model(*found);
      friction_ = friction_of_model(*found);
    }
  }
  const Exchange exchange = decide_exchange(parameters().effects, fields_at_contact_, motion(), friction_);
  log().errors(exchange.complaints);
  if (exchange.effects.traction != contact_.core().effects().traction)
    contact_.core().exchange_traction(exchange.effects.traction);
  if (std::exchange(summary_, exchange.summary) != exchange.summary)
    log().line("sliding-mixture \"" + log().name() + "\" exchanges " + exchange.summary);
  return exchange.complaints.empty();
}
