/// Sums over the integration points of a pass, from which balances and nodal output are computed.
#pragma once

#include "interface/pass.h"

namespace mixture_contact {

/// The rows of a matrix of nodal sums with one column per node. Each entry is the sum over points of a value times the
/// part of the point's area that belongs to the node [mm^2]. Values from row turning() on have opposite signs on both
/// surfaces.
class OutputRows {
 public:
  explicit OutputRows(const Effects& effects)
      : fields_(effects.scalar_fields()), has_friction_(effects.has_friction()) {}

  static constexpr Index area = 0;
  static constexpr Index gap = 1;
  static constexpr Index pressure = 2;
  // Rows of friction: the bound T_max, the load that the fluid bears, and 1 for slip or 0 for stick.
  static constexpr Index bound = 3;
  static constexpr Index fluid = 4;
  static constexpr Index slips = 5;

  /// First row of values with opposite signs on both surfaces.
  Index turning() const { return has_friction_ ? slips + 1 : pressure + 1; }
  /// Row of the first field's flux; the other fields follow.
  Index flux() const { return turning(); }
  /// Row of the first field's jump; the other fields follow.
  Index jump() const { return flux() + fields_; }
  /// First of three rows of the friction traction.
  Index traction() const { return jump() + fields_; }
  /// First of three rows of the slip.
  Index slip() const { return traction() + 3; }
  /// Number of rows.
  Index count() const { return has_friction_ ? slip() + 3 : traction(); }

  Index fields() const { return fields_; }
  bool has_friction() const { return has_friction_; }

 private:
  Index fields_;
  bool has_friction_;
};

/// Friction at the nodes of a pass, for interpolation between nodes; empty without friction.
struct SlidingNodes {
  Matrix3Xd slip;  ///< slip in the present tangent plane [mm]
  /// Friction bound T_max [MPa].
  VectorXd bound;
  /// The load that the fluid bears [MPa].
  VectorXd fluid;
  VectorXd in_contact;  ///< 1 for a node in contact, 0 for any other
  VectorXd slips;       ///< 1 for a node that slips, 0 for any other
  /// Energy dissipated since the start of the step [mJ].
  double dissipation = 0;

  bool empty() const { return bound.size() == 0; }
};

/// Friction at the nodes for these loads.
SlidingNodes sliding_nodes(const NodalLaws& laws, const NodalLoads& loads);

/// Sums over the points of a pair of facets or of a pass.
struct OutputSums {
  Vector3d force = Vector3d::Zero();  ///< force of the normal traction on the primary surface [N]
  MatrixXd integrated;                ///< sums at the primary nodes, rows as OutputRows
  MatrixXd facing;                    ///< sums at the secondary nodes, rows as OutputRows

  void set_zero(Index rows, Index integrated_nodes, Index facing_nodes) {
    force.setZero();
    integrated.setZero(rows, integrated_nodes);
    facing.setZero(rows, facing_nodes);
  }
};

/// References to the data of a state of a pass.
struct LoadedState {
  const MortarSpace& space;
  const NodalLoads& loads;
  const SlidingNodes& sliding;
  const FacingFields& fields;

  OutputRows rows() const { return OutputRows(space.effects()); }
};

/// The sums over all points of a pass that carry load.
OutputSums sums_of(const LoadedState& state);

}  // namespace mixture_contact
