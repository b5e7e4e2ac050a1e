#include "core_archive.h"

#include "archive.h"
#include "indexing/entries.h"

#include <FECore/DumpStream.h>

#include <cstdint>

using namespace mixture_contact;

namespace {

void archive_facet(DumpStream& ar, Facet& facet) {
  int type = static_cast<int>(facet.type);
  ar & type;
  facet.type = static_cast<FacetType>(type);
  for (int& node : facet.nodes) ar & node;
}

/// Stores or reads a mask as two halves, because dump streams do not support 64-bit integers.
void archive_mask(DumpStream& ar, FieldMask& mask) {
  constexpr FieldMask lower = 0xffffffffU;
  int low = indexing::as_int(mask & lower);
  int high = indexing::as_int(mask >> 32U);
  ar & low & high;
  const auto half = [](int bits) { return FieldMask{static_cast<std::uint32_t>(bits)}; };
  mask = half(low) | half(high) << 32U;
}

void archive_flags(DumpStream& ar, NodeFlags& flags) {
  VectorXd numbers(flags.count());
  for (Index node = 0; node < numbers.size(); ++node) numbers[node] = flags[node] ? 1 : 0;
  archive(ar, numbers);
  flags.assign(indexing::entries(numbers.size()), false);
  for (Index node = 0; node < numbers.size(); ++node) flags[node] = numbers[node] > 0;
}

void archive_multipliers(DumpStream& ar, Multipliers& multipliers) {
  archive(ar, multipliers.traction);
  archive(ar, multipliers.flux);
  archive(ar, multipliers.traction_penalty_scale);
  archive(ar, multipliers.flux_penalty_scale);
  archive(ar, multipliers.accepted_traction);
  archive_flags(ar, multipliers.flux_coupled);
  archive(ar, multipliers.friction);
  archive_flags(ar, multipliers.slips);
  archive(ar, multipliers.friction_penalty_scale);
}

void archive_carriers(DumpStream& ar, LoadCarriers& carriers) {
  int facets = mixture_contact::number_of(carriers);
  ar & facets;
  carriers.resize(indexing::entries(facets));
  for (FacetVector& of_facet : carriers) archive(ar, of_facet);
}

}  // namespace

void archive_mesh(DumpStream& ar, SurfaceMesh& mesh) {
  int facets = mixture_contact::number_of(mesh.facets);
  ar & mesh.nodes & facets;
  mesh.facets.resize(indexing::entries(facets));
  mesh.permeable.resize(indexing::entries(facets));
  for (Facet& facet : mesh.facets) archive_facet(ar, facet);
  for (FieldMask& mask : mesh.permeable) archive_mask(ar, mask);
  archive(ar, mesh.stiffness);
  archive(ar, mesh.conductance);
  std::vector<int>& ids = mesh.node_ids;
  archive(ar, ids);
  archive(ar, mesh.thickness);
  archive_flags(ar, mesh.joined);
}

void archive_effects(DumpStream& ar, Effects& effects) {
  int friction = static_cast<int>(effects.friction_kind);
  ar & effects.traction & effects.solvent & friction;
  effects.friction_kind = static_cast<mixture_contact::FrictionKind>(friction);
  archive(ar, effects.solutes);
}

void archive_state(DumpStream& ar, ContactInterface::State& state) {
  int passes = mixture_contact::number_of(state.multipliers);
  archive(ar, state.check_nodes);
  ar & passes;
  state.multipliers.resize(indexing::entries(passes));
  for (Multipliers& multipliers : state.multipliers) archive_multipliers(ar, multipliers);
  state.carriers.resize(indexing::entries(passes));
  for (LoadCarriers& carriers : state.carriers) archive_carriers(ar, carriers);
  state.faced.resize(indexing::entries(passes));
  for (NodeFlags& faced : state.faced) archive_flags(ar, faced);
  for (Matrix3Xd& position : state.slips_from) archive(ar, position);
  archive(ar, state.overlap);
}
