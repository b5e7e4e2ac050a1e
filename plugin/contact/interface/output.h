/// Output of a contact: balances and nodal values.
#pragma once

#include "interface/interface.h"

namespace mixture_contact {

/// Energies of the bonds of a tie.
struct BondEnergy {
  double dissipated = 0;   ///< energy dissipated by damage since the start of the tie [mJ]
  double viscous = 0;      ///< energy dissipated by viscosity since the start of the tie [mJ]
  double stored = 0;       ///< energy stored in the bonds [mJ]
  double broken_area = 0;  ///< area of broken bonds [mm^2]
};

/// Loads and flows on the primary surface; those on the secondary surface are opposite.
struct Balance {
  Vector3d force{0, 0, 0};     ///< contact force [N]
  double area = 0;             ///< area in contact [mm^2]
  VectorXd flow;               ///< flow out of the primary body per exchanged field [mm^3/s] or [nmol/s]
  Vector3d friction{0, 0, 0};  ///< part of the force from friction [N]
  double dissipation = 0;      ///< energy that friction has dissipated since the start of the step, in total [mJ]
  BondEnergy bonds;
};

/// The friction status of a node.
enum class Sliding { open = 0, sticks = 1, slips = 2 };

/// Friction at the nodes of a surface; empty without friction.
struct FrictionOutput {
  Matrix3Xd traction;  ///< friction on this surface [MPa]
  /// Slip of this surface relative to the other since the start of the step, in the present tangent plane [mm].
  Matrix3Xd slip;
  VectorXd bound;   ///< friction bound T_max [MPa]
  VectorXd fluid;   ///< load p~ - p* that the fluid bears [MPa]
  VectorXd status;  ///< status of each node, a value of Sliding
};

/// The value of a node; 0 if the contact has no such values.
inline double value_at(const VectorXd& values, Index node) { return node < values.size() ? values[node] : 0.0; }
/// The vector of a node; zero if the contact has no such vectors.
inline Vector3d vector_at(const Matrix3Xd& vectors, Index node) {
  return node < vectors.cols() ? Vector3d(vectors.col(node)) : Vector3d::Zero();
}

/// The friction status of a node; `open` without friction.
inline Sliding status_of(const FrictionOutput& friction, Index node) {
  return static_cast<Sliding>(static_cast<int>(value_at(friction.status, node)));
}

/// The state of the bonds at the nodes of a surface; empty if they cannot break.
struct BreakingOutput {
  VectorXd damage;     ///< damage d [-]
  VectorXd opening;    ///< distance of the tied points [mm]
  VectorXd energy;     ///< energy dissipated by damage [mJ/mm^2]
  VectorXd broken_at;  ///< time at which the last bond of the node broke [s]; negative if a bond is not broken
};

/// Values for output at the nodes of a surface, averaged over the points in contact around each node.
struct NodalOutput {
  VectorXd gap;             ///< average gap [mm]
  VectorXd pressure;        ///< contact pressure -t_n [MPa]
  MatrixXd flux;            ///< flux out of the body of this surface, shape (fields, nodes)
  MatrixXd jump;            ///< jump, this side minus the other side, shape (fields, nodes)
  VectorXd tributary_area;  ///< area in contact that belongs to the node [mm^2]
  FrictionOutput friction;
  BreakingOutput breaking;

  /// The effective coefficient of friction T_max/|t_n| at a node; 0 without traction.
  double effective_friction(Index node) const { return over_pressure(friction.bound, node); }
  /// The fluid load support (p~ - p*)/|t_n| at a node; 0 without traction.
  double fluid_load_support(Index node) const { return over_pressure(friction.fluid, node); }

 private:
  double over_pressure(const VectorXd& values, Index node) const {
    const double pressing = value_at(pressure, node);  // FEBio logs data before the contact has output
    return pressing > 0 ? value_at(values, node) / pressing : 0.0;
  }
};

/// All output of a contact at a state.
struct InterfaceOutput {
  Balance balance;
  PerSide<NodalOutput> nodes;
};
/// The output at a state, for whose positions project() has been called.
InterfaceOutput output(const ContactInterface& contact, const PerSide<SurfaceFields>& fields);

}  // namespace mixture_contact
