/// The effects that a contact exchanges. Search, residual, tangent, matrix profile, multipliers and log follow this
/// value.
#pragma once

#include "base/indexed_vector.h"

#include <cstdint>

namespace mixture_contact {

/// A set of exchanged scalar fields, one bit each, in the order of Effects.
using FieldMask = std::uint64_t;
inline constexpr int max_scalar_fields = 64;

inline bool contains(FieldMask mask, int field) { return (mask >> static_cast<unsigned>(field)) & 1U; }
inline FieldMask only(int field) { return FieldMask{1} << static_cast<unsigned>(field); }

/// The load to which friction is in proportion.
enum class FrictionKind : std::uint8_t {
  none,
  on_traction,   ///< the traction
  on_solid_part  ///< its part that the fluid, of both sides or of the one that has it, does not bear
};

/// The effects that two surfaces exchange. Scalar fields are counted solvent first (if exchanged),
/// then solutes.
struct Effects {
  bool traction = true;      ///< the surfaces push on each other; false if none of their nodes can move: no unknown
                             ///< is a displacement then, and contact is linear transport
  bool solvent = false;      ///< both surfaces are permeable to the solvent
  std::vector<int> solutes;  ///< host's ids of the solutes that both surfaces share, ascending
  FrictionKind friction_kind = FrictionKind::none;  ///< where they exchange traction

  /// Number of exchanged scalar fields.
  int scalar_fields() const { return (solvent ? 1 : 0) + number_of(solutes); }
  /// Whether there is friction in the steps in which traction is exchanged.
  bool may_rub() const { return friction_kind != FrictionKind::none; }
  bool has_friction() const { return traction && may_rub(); }
  /// Whether friction depends on the fluid pressure.
  bool has_bearing_fluid() const { return traction && reads_fluid(); }
  bool reads_fluid() const { return friction_kind == FrictionKind::on_solid_part; }
  /// The scalar field that is the fluid pressure: the exchanged one, or one more that friction alone reads.
  int pressure_field() const { return solvent ? 0 : scalar_fields(); }
  /// Number of scalar fields that nodes have: the exchanged ones, and those that friction reads in addition.
  int nodal_fields() const { return scalar_fields() + (reads_fluid() && !solvent ? 1 : 0); }
};

}  // namespace mixture_contact
