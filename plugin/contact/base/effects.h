/// Which effects a contact exchanges. Search, residual, tangent, matrix profile, multipliers and log follow this value.
#pragma once

#include "base/indexed_vector.h"

#include <cstdint>

namespace mixture_contact {

/// A set of exchanged scalar fields, one bit each, in the order of Effects.
using FieldMask = std::uint64_t;
inline constexpr int max_scalar_fields = 64;

inline bool contains(FieldMask mask, int field) { return (mask >> static_cast<unsigned>(field)) & 1U; }
inline FieldMask only(int field) { return FieldMask{1} << static_cast<unsigned>(field); }

/// What is exchanged between two surfaces. Scalar fields are counted solvent first (if exchanged),
/// then solutes.
struct Effects {
  bool traction = true;      ///< the surfaces push on each other; false where none of their nodes can move: no unknown
                             ///< is a displacement then, and contact is linear transport
  bool solvent = false;      ///< both surfaces are permeable to the solvent
  std::vector<int> solutes;  ///< host's ids of the solutes that both surfaces share, ascending
  bool friction = false;     ///< the surfaces resist sliding, where they exchange traction
  bool bearing_fluid = false;  ///< friction depends on the fluid pressure, of both sides or of the one that has fluid

  /// Number of exchanged scalar fields.
  int scalar_fields() const { return (solvent ? 1 : 0) + number_of(solutes); }
  bool has_friction() const { return traction && friction; }
  /// Whether friction depends on the fluid pressure.
  bool has_bearing_fluid() const { return has_friction() && bearing_fluid; }
  /// The scalar field that is the fluid pressure: the exchanged one, or one more that friction alone reads.
  int pressure_field() const { return solvent ? 0 : scalar_fields(); }
  /// Number of scalar fields that nodes have: the exchanged ones, and what friction reads beside them.
  int nodal_fields() const { return scalar_fields() + (bearing_fluid && !solvent ? 1 : 0); }
};

}  // namespace mixture_contact
