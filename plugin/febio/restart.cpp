#include "mixture_contact.h"

#include "archive.h"

#include <FECore/DumpStream.h>

#include <utility>

using namespace mixture_contact;

// Restart: the state in a dump.

namespace {

void archive_mesh(DumpStream& ar, SurfaceMesh& mesh) {
  int facets = static_cast<int>(mesh.facets.size());
  ar & mesh.nodes & facets;
  mesh.facets.resize(static_cast<std::size_t>(facets));
  mesh.permeable.resize(static_cast<std::size_t>(facets));
  for (Facet& facet : mesh.facets) {
    int type = static_cast<int>(facet.type);
    ar & type;
    facet.type = static_cast<FacetType>(type);
    for (int& node : facet.nodes) ar & node;
  }
  for (FieldMask& mask : mesh.permeable) {
    // Dump streams know no 64-bit integers.
    int low = static_cast<int>(static_cast<std::uint32_t>(mask));
    int high = static_cast<int>(static_cast<std::uint32_t>(mask >> 32U));
    ar & low & high;
    mask = static_cast<FieldMask>(static_cast<std::uint32_t>(low)) |
           static_cast<FieldMask>(static_cast<std::uint32_t>(high)) << 32U;
  }
  archive(ar, mesh.stiffness);
  archive(ar, mesh.conductance);
}

void archive_multipliers(DumpStream& ar, Multipliers& multipliers) {
  archive(ar, multipliers.traction);
  archive(ar, multipliers.flux);
  archive(ar, multipliers.traction_growth);
  archive(ar, multipliers.flux_growth);
}

void archive_state(DumpStream& ar, ContactInterface::State& state) {
  int passes = static_cast<int>(state.multipliers.size());
  archive(ar, state.noticed);
  ar & passes;
  state.multipliers.resize(static_cast<std::size_t>(passes));
  for (Multipliers& multipliers : state.multipliers) archive_multipliers(ar, multipliers);
}

}  // namespace

void FEMixtureContact::Serialize(DumpStream& ar) {
  FEContactInterface::Serialize(ar);
  primary_.Serialize(ar);
  secondary_.Serialize(ar);
  if (!ar.IsShallow()) {
    ar & pressure_dof_ & concentration_dof_ & concentrations_ & relocated_ & first_equation_ & multiplier_node_;
    for (int& dof : displacement_dofs_) ar & dof;
    archive(ar, step_start_);
    ar & effects_.traction & effects_.solvent & effects_.solutes;
    for_each_parameter(parameters_, [&ar](const ParameterTag& tag, auto& /*value*/) {
      if (tag.given == nullptr) return;
      bool& given = *tag.given;
      ar & given;
    });
    PerSide<SurfaceMesh> meshes;
    for (const Side side : both_sides) {
      if (ar.IsSaving()) meshes[side] = core_->mesh(side);
      archive_mesh(ar, meshes[side]);
    }
    if (!ar.IsSaving()) build_core(std::move(meshes));
  }
  extrapolation_.serialize(ar);
  ContactInterface::State state = core_->state();
  archive_state(ar, state);
  if (ar.IsSaving()) return;
  core_->restore(std::move(state));
  in_trial_ = keep_prediction_ = begun_ = false;  // a trial that was cut back is over
  residual_outdated_ = moved_ = false;
  add_callbacks();
}
