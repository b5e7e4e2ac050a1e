/// Sums over the points of a pass that balances and values at nodes are made of.
#pragma once

#include "interface/pass.h"

namespace mixture_contact {

/// Rows of matrices with the sums at nodes, one column for each: sums over points of their values, weighted
/// with the node's share of their area [mm^2]. Values after turning() change their signs from one surface to the other.
class OutputRows {
 public:
  explicit OutputRows(const Effects& effects)
      : fields_(effects.scalar_fields()), has_friction_(effects.has_friction()) {}

  static constexpr Index area = 0;
  static constexpr Index gap = 1;
  static constexpr Index pressure = 2;
  // Rows of friction: the bound T_max, the load that the fluid bears, and whether the surfaces slip, 1 or 0.
  static constexpr Index bound = 3;
  static constexpr Index fluid = 4;
  static constexpr Index slips = 5;

  Index turning() const { return has_friction_ ? slips + 1 : pressure + 1; }
  /// The row of the first field's flux; those of the other fields follow.
  Index flux() const { return turning(); }
  Index jump() const { return flux() + fields_; }
  /// The first of three, as the next.
  Index traction() const { return jump() + fields_; }
  Index slip() const { return traction() + 3; }
  Index count() const { return has_friction_ ? slip() + 3 : traction(); }

  Index fields() const { return fields_; }
  bool has_friction() const { return has_friction_; }

 private:
  Index fields_;
  bool has_friction_;
};

/// The friction at a pass's nodes, for interpolation between them; empty without friction.
struct SlidingNodes {
  Matrix3Xd slip;  ///< in the present tangent plane
  VectorXd bound;
  VectorXd fluid;
  VectorXd in_contact;  ///< 1 or 0
  VectorXd slips;       ///< 1 or 0
  double dissipation = 0;

  bool empty() const { return bound.size() == 0; }
};

SlidingNodes sliding_nodes(const NodalLaws& laws, const NodalLoads& loads);

/// Sums over points of a pair of facets, or of a whole pass.
struct OutputSums {
  Vector3d force = Vector3d::Zero();  ///< of the normal traction, on the surface that is integrated over [N]
  MatrixXd integrated;                ///< at that surface's nodes, OutputRows each
  MatrixXd facing;                    ///< at those of the other

  void set_zero(Index rows, Index integrated_nodes, Index facing_nodes) {
    force.setZero();
    integrated.setZero(rows, integrated_nodes);
    facing.setZero(rows, facing_nodes);
  }
};

/// A state of a pass; refers to all of it.
struct LoadedState {
  const MortarSpace& space;
  const NodalLoads& loads;
  const SlidingNodes& sliding;
  const FacingFields& fields;

  OutputRows rows() const { return OutputRows(space.effects()); }
};

/// Sums over all points of a pass that carry load.
OutputSums sums_of(const LoadedState& state);

}  // namespace mixture_contact
