#include "contact_setup.h"

#include "contact/base/indexed_vector.h"
#include "contact/interface/multipliers.h"
#include "material_properties.h"

#include <FEBioMech/FEExplicitSolidSolver.h>
#include <FECore/FEAnalysis.h>
#include <FECore/FEModel.h>
#include <FECore/FENewtonSolver.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

using namespace mixture_contact;

namespace {

std::set<std::vector<int>> facet_nodes(FESurface& surface) {
  std::set<std::vector<int>> facets;
  for (int i = 0; i < surface.Elements(); ++i) {
    std::vector<int> nodes = surface.Element(i).m_node;
    std::sort(nodes.begin(), nodes.end());
    facets.insert(nodes);
  }
  return facets;
}

bool share_facets(FESurface& first, FESurface& second) {
  const auto one = facet_nodes(first);
  const auto two = facet_nodes(second);
  return std::any_of(one.begin(), one.end(), [&](const auto& facet) { return two.count(facet) > 0; });
}

bool is_triangular(const FESurfaceElement& element) {
  return element.Shape() == ET_TRI3 || element.Shape() == ET_TRI6 || element.Shape() == ET_TRI7 ||
         element.Shape() == ET_TRI10;
}

std::optional<FacetType> type_of(const FESurfaceElement& element) {
  return facet_type(is_triangular(element), element.Nodes());
}

/// The first facet of a type that the core does not know; null if there is none.
const FESurfaceElement* unknown_facet(FESurface& surface) {
  for (int i = 0; i < surface.Elements(); ++i) {
    if (!type_of(surface.Element(i))) return &surface.Element(i);
  }
  return nullptr;
}

/// Facets whose types check_surfaces() has seen to be known.
SurfaceMesh surface_mesh(FESurface& surface, const std::vector<FacetMaterial>& materials, const Effects& effects) {
  SurfaceMesh mesh;
  mesh.nodes = surface.Nodes();
  for (int i = 0; i < surface.Elements(); ++i) {
    const FESurfaceElement& element = surface.Element(i);
    Facet facet;
    facet.type = type_of(element).value_or(FacetType::quad4);
    std::copy_n(element.m_lnode.begin(), element.Nodes(), facet.nodes.begin());
    mesh.facets.push_back(facet);
  }
  set_materials(mesh, materials, effects);
  return mesh;
}

}  // namespace

// ------------------------------------------------------------ checks

bool ContactSetup::has_sound_values() const {
  const std::vector<std::string> wrong = complaints(parameters_);
  log_.errors(wrong);
  return wrong.empty();
}

bool ContactSetup::check_parameters() const {
  const bool sound = has_sound_values();
  for (const std::string& sentence : notices(parameters_)) log_.say(sentence);
  const bool has_ambient = parameters_.ambient_pressure != 0 || !ambient_.empty();
  if (!parameters_.free_draining && has_ambient && !has_friction(parameters_))
    log_.say("ambient values have no effect: <free_draining> is 0.");
  return sound;
}

bool ContactSetup::check_surfaces() const {
  const PerSide<std::string> names = surfaces_.names();
  for (const Side side : both_sides) {
    const FESurfaceElement* unknown = unknown_facet(surfaces_[side]);
    if (unknown == nullptr) continue;
    log_.error("surface \"" + names[side] + "\" has a facet with " + std::to_string(unknown->Nodes()) +
               " nodes, which is not supported. Allowed are facets with 3, 6 or 7 (triangles) and 4, 8 or 9 nodes "
               "(quadrilaterals).");
    return false;
  }
  if (!share_facets(surfaces_[Side::primary], surfaces_[Side::secondary])) return true;
  log_.error("the surfaces \"" + names[Side::primary] + "\" and \"" + names[Side::secondary] +
             "\" share facets. A surface cannot be in contact with itself; the primary and secondary surface of the "
             "surface pair must be different.");
  return false;
}

std::string ContactSetup::complaint(const FEMixtureAmbientConcentration& ambient) const {
  const int solutes = dofs_.concentrations();
  if (ambient.solute < 0 || ambient.solute > solutes) {
    return "<ambient_concentration sol=\"" + std::to_string(ambient.solute) +
           "\"> names a solute that the model does not have. It has " + std::to_string(solutes) + ".";
  }
  if (ambient.solute == 0 && solutes != 1) {
    return "<ambient_concentration> needs the attribute sol=\"...\" to say which of the model's " +
           std::to_string(solutes) + " solutes it is for: a name or an id of <Solutes>.";
  }
  if (!std::isfinite(ambient.value) || ambient.value < 0)
    return "<ambient_concentration> is " + std::to_string(ambient.value) +
           "; it must be a number that is not negative.";
  const auto is_same = [&](const FEMixtureAmbientConcentration* other) {
    return std::max(other->solute, 1) == std::max(ambient.solute, 1);
  };
  if (std::count_if(ambient_.begin(), ambient_.end(), is_same) > 1)
    return "<ambient_concentration> is given more than once for the same solute. Give each solute's once.";
  return "";
}

bool ContactSetup::check_ambient() const {
  for (const FEMixtureAmbientConcentration* ambient : ambient_) {
    const std::string wrong = complaint(*ambient);
    if (wrong.empty()) continue;
    log_.error(wrong);
    return false;
  }
  return true;
}

bool ContactSetup::has_penalty(const BoundContact& contact) const {
  if (contact.core().pass(0).penalty().traction.allFinite()) return true;
  log_.error(
      "both surfaces are rigid, so there is no stiffness to choose a penalty from. Set <penalty> to a value "
      "[force/length^3] and <auto_penalty> to 0.");
  return false;
}

bool ContactSetup::can_have_multipliers(const BoundContact& contact) const {
  if (multiplier_layout(contact.core()).size() == 0) return true;
  for (int i = 0; i < fem_.Steps(); ++i) {
    FESolver* const solver = fem_.GetStep(i)->GetFESolver();
    if (solver == nullptr || dynamic_cast<const FENewtonSolver*>(solver) != nullptr) continue;
    log_.error(
        "<laugon>LAGMULT</laugon> needs a solver of Newton's kind, since its multipliers are unknowns of the matrix; that "
        "of step " +
        std::to_string(i + 1) + " is " + solver->GetTypeStr() + ". Use PENALTY or AUGLAG.");
    return false;
  }
  if (dofs_.deformable_node() >= 0) return true;
  log_.error(
      "both surfaces are rigid, so there is nothing that <laugon>LAGMULT</laugon> could be solved for. Use PENALTY or "
      "AUGLAG.");
  return false;
}

// ------------------------------------------------------------ materials

std::optional<FacetMaterials> ContactSetup::materials() const {
  FacetMaterials materials;
  for (const Side side : both_sides) {
    FEMixtureSurface& surface = surfaces_[side];
    for (int i = 0; i < surface.Elements(); ++i) {
      std::string problem;
      const auto material = facet_material(fem_, surface, surface.Element(i), problem);
      if (!material) {
        log_.error("surface \"" + surface.GetName() + "\": " + problem + ".");
        return std::nullopt;
      }
      materials[side].push_back(*material);
    }
  }
  return materials;
}

std::vector<FieldAtContact> ContactSetup::fields_of_model(const FacetMaterials& materials) const {
  std::vector<std::string> names = solute_names(fem_);
  names.resize(newton::entries(dofs_.concentrations()));
  std::vector<FieldAtContact> fields = fields_at_contact(materials, surfaces_.names(), names);
  if (dofs_.pressure() < 0) fields.front().obstacles = {"the module has no fluid pressure"};
  leave_out(left_out(parameters_), fields);
  return fields;
}

FrictionRequest ContactSetup::friction_of_model(const FacetMaterials& materials) const {
  return {has_friction(parameters_), dofs_.pressure() >= 0 && parameters_.contact_frac < 1 && has_fluid(materials)};
}

std::optional<Effects> ContactSetup::effects(const FacetMaterials& materials) {
  fields_at_contact_ = fields_of_model(materials);
  friction_ = friction_of_model(materials);
  const Exchange exchange = decide_exchange(parameters_.effects, fields_at_contact_, Motion::undecided, friction_);
  log_.errors(exchange.complaints);
  if (!exchange.complaints.empty()) return std::nullopt;
  const int fields = exchange.effects.nodal_fields();
  if (fields <= max_scalar_fields) return exchange.effects;
  log_.error("the surfaces share " + std::to_string(fields) + " fields; at most " + std::to_string(max_scalar_fields) +
             " are supported.");
  return std::nullopt;
}

bool ContactSetup::build(BoundContact& contact) {
  const auto found = materials();
  const auto exchanged = found ? effects(*found) : std::nullopt;
  if (!exchanged) return false;
  PerSide<SurfaceMesh> meshes;
  for (const Side side : both_sides) meshes[side] = surface_mesh(surfaces_[side], (*found)[side], *exchanged);
  contact.build(std::move(meshes), *exchanged);
  return has_penalty(contact) && can_have_multipliers(contact);
}

void ContactSetup::update_properties(const BoundContact& contact) const {
  if (const auto found = materials()) update_materials(contact.core(), *found);
}

SolverKind ContactSetup::solver_kind() const {
  const FESolver* const solver = fem_.GetCurrentStep()->GetFESolver();
  if (dynamic_cast<const FENewtonSolver*>(solver) != nullptr) return SolverKind::newton;
  const auto* dynamics = dynamic_cast<const FEExplicitSolidSolver*>(solver);
  return dynamics == nullptr ? SolverKind::conjugate_gradient : SolverKind::explicit_dynamics;
}

void ContactSetup::update_laws(const BoundContact& contact) const {
  contact.core().update_laws(core_settings(parameters_, solver_kind()));
}

bool ContactSetup::follow_load_curves(const BoundContact& contact) const {
  const bool sound = has_sound_values() && check_ambient();
  if (sound) update_laws(contact);
  return sound;
}

// ------------------------------------------------------------ traction

Motion ContactSetup::motion() const {
  if (left_out(parameters_).contact) return Motion::untouched;
  const auto is_fixed = [&](const FENode& node) {
    const std::array<int, 3>& dofs = dofs_.displacements();
    return node.m_rid < 0 &&
           std::all_of(dofs.begin(), dofs.end(), [&](int dof) { return node.get_bc(dof) == DOF_FIXED; });
  };
  for (const Side side : both_sides) {
    FEMixtureSurface& surface = surfaces_[side];
    for (int i = 0; i < surface.Nodes(); ++i) {
      if (!is_fixed(surface.Node(i))) return Motion::possible;
    }
  }
  return Motion::impossible;
}

bool ContactSetup::decide_traction(const BoundContact& contact) {
  // Only a step's own boundary conditions tell whether anything can move in it. A continued run has not read materials.
  if (fields_at_contact_.empty()) {
    if (const auto found = materials()) {
      fields_at_contact_ = fields_of_model(*found);
      friction_ = friction_of_model(*found);
    }
  }
  const Exchange exchange = decide_exchange(parameters_.effects, fields_at_contact_, motion(), friction_);
  log_.errors(exchange.complaints);
  if (exchange.effects.traction != contact.core().effects().traction)
    contact.core().exchange_traction(exchange.effects.traction);
  if (std::exchange(summary_, exchange.summary) != exchange.summary)
    log_.line("sliding-mixture \"" + log_.name() + "\" exchanges " + exchange.summary);
  return exchange.complaints.empty();
}
