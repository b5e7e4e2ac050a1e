/// The effects that a contact exchanges: traction, friction, solvent and solutes. Search, residual, tangent, matrix
/// profile, multipliers and log depend on them.
#pragma once

#include "base/indexed_vector.h"

#include <cstdint>

namespace mixture_contact {

/// A set of exchanged scalar fields, one bit each, in the order of Effects.
using FieldMask = std::uint64_t;
inline constexpr int max_scalar_fields = 64;

/// True if a field is in a set.
inline bool contains(FieldMask mask, int field) { return (mask >> static_cast<unsigned>(field)) & 1U; }
/// The set of one field.
inline FieldMask only(int field) { return FieldMask{1} << static_cast<unsigned>(field); }

/// The load to which the friction bound is proportional.
enum class FrictionKind : std::uint8_t {
  none,
  on_traction,  ///< the whole normal traction
  /// The part of the normal traction that the solid bears; the fluid of both sides, or of the side that has one, bears
  /// the rest.
  on_solid_part
};

/// The effects that two surfaces exchange. Exchanged scalar fields are numbered: first the solvent (if exchanged), then
/// the solutes.
struct Effects {
  /// True if the surfaces exchange tractions; false if none of their nodes can move: the contact then has no
  /// displacement unknowns and is linear transport.
  bool traction = true;
  bool solvent = false;      ///< true if both surfaces are permeable to the solvent and exchange it
  std::vector<int> solutes;  ///< the host's ids of the solutes that both surfaces share, ascending
  FrictionKind friction_kind = FrictionKind::none;  ///< friction where tractions are exchanged

  /// Number of exchanged scalar fields.
  int scalar_fields() const { return (solvent ? 1 : 0) + number_of(solutes); }
  /// The friction of the present step: none while no tractions are exchanged.
  FrictionKind acting_friction() const { return traction ? friction_kind : FrictionKind::none; }
  /// The fields on which the friction bound depends in the present step: the fluid pressure, or none.
  FieldMask bearing_fields() const { return traction && reads_fluid() ? only(pressure_field()) : FieldMask{0}; }
  /// True if the friction law reads the fluid pressure.
  bool reads_fluid() const { return friction_kind == FrictionKind::on_solid_part; }
  /// Index of the fluid pressure among the nodal fields: the exchanged field, or an additional one that only friction
  /// reads.
  int pressure_field() const { return solvent ? 0 : scalar_fields(); }
  /// Number of scalar fields at the nodes: the exchanged ones, and an additional pressure that only friction reads, if
  /// any.
  int nodal_fields() const { return scalar_fields() + (reads_fluid() && !solvent ? 1 : 0); }
};

}  // namespace mixture_contact
