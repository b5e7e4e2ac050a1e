#include "tie_archive.h"

#include "archive.h"
#include "core_archive.h"

#include <FECore/DumpStream.h>

#include <utility>

using namespace mixture_contact;

namespace {

void archive_entry(DumpStream& ar, TiedAverage& average) {
  ar & average.area;
  archive(ar, average.weights);
}

void archive_entry(DumpStream& ar, PlaceOnFacet& place) {
  archive(ar, static_cast<std::vector<int>&>(place.nodes));
  archive(ar, place.gradient);
}

void archive_entry(DumpStream& ar, KeptGap& gap) {
  archive_entry(ar, gap.at);
  ar & gap.size;
}

template <class Entry>
void archive_list(DumpStream& ar, IndexedVector<Entry>& entries);

void archive_entry(DumpStream& ar, TiedNode& tied) {
  ar & tied.node;
  archive(ar, static_cast<std::vector<int>&>(tied.primary));
  archive(ar, static_cast<std::vector<int>&>(tied.secondary));
  archive_entry(ar, tied.traction);
  archive_list(ar, tied.fields);
  archive(ar, tied.primary_shares);
  archive(ar, tied.secondary_shares);
  for (IndexedVector<int>& of_side : tied.facets) archive(ar, static_cast<std::vector<int>&>(of_side));
  archive_list(ar, tied.gaps);
}

template <class Entry>
void archive_list(DumpStream& ar, IndexedVector<Entry>& entries) {
  int count = mixture_contact::number_of(entries);
  ar & count;
  entries.resize(indexing::entries(count));
  for (Entry& entry : entries) archive_entry(ar, entry);
}

}  // namespace

void archive_tie(DumpStream& ar, std::unique_ptr<Tie>& tie, const BreakingLaw& breaking) {
  PerSide<SurfaceMesh> mesh;
  Effects effects;
  IndexedVector<TiedNode> nodes;
  if (ar.IsSaving()) {
    mesh = tie->mesh();
    effects = tie->effects();
    nodes = tie->nodes();
  }
  for (SurfaceMesh& of_side : mesh) archive_mesh(ar, of_side);
  archive_effects(ar, effects);
  archive_list(ar, nodes);
  if (!ar.IsSaving()) tie = std::make_unique<Tie>(std::move(mesh), std::move(effects), std::move(nodes), breaking);
}

void archive_state(DumpStream& ar, TieState& state) {
  archive(ar, state.traction);
  archive(ar, state.flux);
  archive(ar, state.flux_penalty_scale);
  ar & state.traction_penalty_scale;
  archive(ar, state.damage.damage);
  archive(ar, state.damage.energy);
  archive(ar, state.damage.viscous);
  archive(ar, state.damage.opening);
  archive(ar, state.damage.broken_at);
}
