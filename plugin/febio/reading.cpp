#include "mixture_contact.h"

#include "material_properties.h"

#include <FECore/FEAnalysis.h>
#include <FECore/FEMesh.h>
#include <FECore/FEModel.h>
#include <FECore/FENewtonSolver.h>
#include <FECore/log.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

using namespace mixture_contact;

// Setting up: what the model's surfaces and materials are to the core.

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

bool is_triangular(const FESurfaceElement& element) {
  return element.Shape() == ET_TRI3 || element.Shape() == ET_TRI6 || element.Shape() == ET_TRI7 ||
         element.Shape() == ET_TRI10;
}

std::optional<FacetType> type_of(const FESurfaceElement& element) {
  return facet_type(is_triangular(element), element.Nodes());
}

}  // namespace

bool FEMixtureContact::check_surfaces() {
  for (const Side side : both_sides) {
    FEMixtureSurface& s = surface(side);
    for (int i = 0; i < s.Elements(); ++i) {
      if (type_of(s.Element(i))) continue;
      feLogError(
          "sliding-mixture \"%s\": surface \"%s\" has a facet with %d nodes, which is not supported. Allowed are facets with 3, 6 "
          "or 7 (triangles) and 4, 8 or 9 nodes (quadrilaterals).",
          GetName().c_str(), s.GetName().c_str(), s.Element(i).Nodes());
      return false;
    }
  }
  const auto one = facet_nodes(primary_);
  const auto two = facet_nodes(secondary_);
  const bool shared = std::any_of(one.begin(), one.end(), [&](const auto& facet) { return two.count(facet) > 0; });
  if (shared) {
    feLogError(
        "sliding-mixture \"%s\": the surfaces \"%s\" and \"%s\" share facets. A surface cannot be in contact with itself; the "
        "primary and secondary surface of the surface pair must be different.",
        GetName().c_str(), primary_.GetName().c_str(), secondary_.GetName().c_str());
  }
  return !shared;
}

std::optional<FacetMaterials> FEMixtureContact::materials() {
  FacetMaterials materials;
  for (const Side side : both_sides) {
    FEMixtureSurface& s = surface(side);
    for (int i = 0; i < s.Elements(); ++i) {
      std::string problem;
      const auto material = facet_material(*GetFEModel(), s, s.Element(i), problem);
      if (!material) {
        feLogError("sliding-mixture \"%s\": surface \"%s\": %s.", GetName().c_str(), s.GetName().c_str(),
                   problem.c_str());
        return std::nullopt;
      }
      materials[side].push_back(*material);
    }
  }
  return materials;
}

bool FEMixtureContact::read_materials() {
  const auto found = materials();
  if (!found || !decide_effects(*found)) return false;
  if (effects_.scalar_fields() > max_scalar_fields) {
    feLogError("sliding-mixture \"%s\": the surfaces share %d fields; at most %d are supported.", GetName().c_str(),
               effects_.scalar_fields(), max_scalar_fields);
    return false;
  }
  build_core({{surface_mesh(Side::primary, (*found)[Side::primary]),
               surface_mesh(Side::secondary, (*found)[Side::secondary])}});
  const VectorXd& penalty = core_->pass(0).penalty().traction;
  if (!penalty.allFinite()) {
    feLogError(
        "sliding-mixture \"%s\": both surfaces are rigid, so there is no stiffness to choose a penalty from. Set <penalty> "
        "to a value [force/length^3] and <auto_penalty> to 0.",
        GetName().c_str());
  }
  return penalty.allFinite() && check_multipliers();
}

bool FEMixtureContact::check_multipliers() {
  if (core_->multiplier_layout().size() == 0) return true;
  FEModel& model = *GetFEModel();
  for (int i = 0; i < model.Steps(); ++i) {
    FESolver* solver = model.GetStep(i)->GetFESolver();
    if (solver == nullptr || dynamic_cast<const FENewtonSolver*>(solver) != nullptr) continue;
    feLogError(
        "sliding-mixture \"%s\": <laugon>LAGMULT</laugon> needs a solver of Newton's kind, since its multipliers are unknowns of the "
        "matrix; that of step %d is %s. Use PENALTY or AUGLAG.",
        GetName().c_str(), i + 1, solver->GetTypeStr());
    return false;
  }
  if (deformable_node() >= 0) return true;
  feLogError(
      "sliding-mixture \"%s\": both surfaces are rigid, so there is nothing that <laugon>LAGMULT</laugon> could be solved for. "
      "Use PENALTY or AUGLAG.",
      GetName().c_str());
  return false;
}

void FEMixtureContact::build_core(PerSide<SurfaceMesh> meshes) {
  core_ = std::make_unique<ContactInterface>(std::move(meshes), effects_, core_settings(parameters_));
}

std::vector<FieldAtContact> FEMixtureContact::fields_of_model(const FacetMaterials& materials) {
  std::vector<std::string> names = solute_names(*GetFEModel());
  names.resize(static_cast<std::size_t>(concentrations_));
  std::vector<FieldAtContact> fields = fields_at_contact(materials, {{primary_.GetName(), secondary_.GetName()}},
                                                         names);
  if (pressure_dof_ < 0) fields.front().obstacles = {"the module has no fluid pressure"};
  return fields;
}

bool FEMixtureContact::decide_effects(const FacetMaterials& materials) {
  fields_at_contact_ = fields_of_model(materials);
  const Exchange exchange = decide_exchange(parameters_.effects, fields_at_contact_, Motion::undecided);
  for (const std::string& sentence : exchange.complaints)
    feLogError("sliding-mixture \"%s\": %s", GetName().c_str(), sentence.c_str());
  if (!exchange.complaints.empty()) return false;
  effects_ = exchange.effects;
  return true;
}

Motion FEMixtureContact::motion() {
  const auto fixed = [&](const FENode& node) {
    return node.m_rid < 0 && std::all_of(
                                 displacement_dofs_.begin(), displacement_dofs_.end(),
                                 [&](int dof) { return node.get_bc(dof) == DOF_FIXED; });
  };
  for (const Side side : both_sides) {
    FEMixtureSurface& s = surface(side);
    for (int i = 0; i < s.Nodes(); ++i) {
      if (!fixed(s.Node(i))) return Motion::possible;
    }
  }
  return Motion::impossible;
}

void FEMixtureContact::decide_traction() {
  // Only a step's own boundary conditions tell whether anything can move in it. A continued run has not read materials.
  if (fields_at_contact_.empty()) {
    if (const auto found = materials()) fields_at_contact_ = fields_of_model(*found);
  }
  const Exchange exchange = decide_exchange(parameters_.effects, fields_at_contact_, motion());
  may_run_ = exchange.complaints.empty();
  for (const std::string& sentence : exchange.complaints)
    feLogError("sliding-mixture \"%s\": %s", GetName().c_str(), sentence.c_str());
  if (exchange.effects.traction != effects_.traction) {
    effects_.traction = exchange.effects.traction;
    core_->exchange_traction(effects_.traction);
  }
  if (std::exchange(summary_, exchange.summary) != exchange.summary)
    feLog("sliding-mixture \"%s\" exchanges %s\n", GetName().c_str(), exchange.summary.c_str());
}

SurfaceMesh FEMixtureContact::surface_mesh(Side side, const std::vector<FacetMaterial>& materials) {
  FEMixtureSurface& s = surface(side);
  SurfaceMesh mesh;
  mesh.nodes = s.Nodes();
  for (int i = 0; i < s.Elements(); ++i) {
    const FESurfaceElement& element = s.Element(i);
    Facet facet;
    facet.type = type_of(element).value_or(FacetType::quad4);  // check_surfaces() has seen to it that there is a type
    std::copy_n(element.m_lnode.begin(), element.Nodes(), facet.nodes.begin());
    mesh.facets.push_back(facet);
  }
  set_materials(mesh, materials, effects_);
  return mesh;
}

bool FEMixtureContact::update_properties() {
  const auto found = materials();
  if (found) update_materials(*core_, *found);
  return found.has_value();
}

std::string FEMixtureContact::complaint(const FEMixtureAmbientConcentration& ambient) const {
  if (ambient.solute < 0 || ambient.solute > concentrations_) {
    return "<ambient_concentration sol=\"" + std::to_string(ambient.solute) +
           "\"> names a solute that the model does not have. It has " + std::to_string(concentrations_) + ".";
  }
  if (ambient.solute == 0 && concentrations_ != 1) {
    return "<ambient_concentration> needs the attribute sol=\"...\" to say which of the model's " +
           std::to_string(concentrations_) + " solutes it is for: a name or an id of <Solutes>.";
  }
  if (!std::isfinite(ambient.value) || ambient.value < 0) {
    return "<ambient_concentration> is " + std::to_string(ambient.value) +
           "; it must be a number that is not negative.";
  }
  const auto same = [&](const FEMixtureAmbientConcentration* other) {
    return std::max(other->solute, 1) == std::max(ambient.solute, 1);
  };
  if (std::count_if(ambient_concentrations_.begin(), ambient_concentrations_.end(), same) > 1)
    return "<ambient_concentration> is given more than once for the same solute. Give each solute's once.";
  return "";
}

bool FEMixtureContact::check_ambient() {
  for (const FEMixtureAmbientConcentration* ambient : ambient_concentrations_) {
    const std::string wrong = complaint(*ambient);
    if (wrong.empty()) continue;
    feLogError("sliding-mixture \"%s\": %s", GetName().c_str(), wrong.c_str());
    return false;
  }
  return true;
}
