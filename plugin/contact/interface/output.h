/// Output of a contact: balances and values at nodes.
#pragma once

#include "interface/interface.h"

namespace mixture_contact {

/// Energies of a tie, of both sides together.
struct BondEnergy {
  double dissipated = 0;   ///< by damage, since the tie began [mJ]
  double viscous = 0;      ///< dissipated by viscosity since the start of the tie [mJ]
  double stored = 0;       ///< in bonds [mJ]
  double broken_area = 0;  ///< [mm^2]
};

/// The loads and flows across the interface that act on the primary surface; those on the secondary one are opposite.
struct Balance {
  Vector3d force{0, 0, 0};     ///< contact force on the primary surface [N]
  double area = 0;             ///< area in contact [mm^2]
  VectorXd flow;               ///< flow out of the primary body per exchanged field [mm^3/s] or [nmol/s]
  Vector3d friction{0, 0, 0};  ///< the part of the force that is friction [N]
  double dissipation = 0;  ///< energy that friction has dissipated since the step began [mJ]; of both sides together
  BondEnergy bonds;
};

/// Status of a node with regard to friction.
enum class Sliding { open = 0, sticks = 1, slips = 2 };

/// Values of friction at the nodes of a surface; empty without friction.
struct FrictionOutput {
  Matrix3Xd traction;  ///< on this surface [MPa]
  Matrix3Xd slip;      ///< of this surface over the other since the step began, in the present tangent plane [mm]
  VectorXd bound;      ///< T_max [MPa]
  VectorXd fluid;      ///< p~ - p*: the load that the fluid bears [MPa]
  VectorXd status;     ///< a Sliding each
};

inline Sliding status_of(const FrictionOutput& friction, Index node) {
  return node < friction.status.size() ? static_cast<Sliding>(static_cast<int>(friction.status[node])) : Sliding::open;
}

/// The state of the bonds at the nodes of a surface; empty if they cannot break.
struct BreakingOutput {
  VectorXd damage;     ///< [-]
  VectorXd opening;    ///< distance of the tied points [mm]
  VectorXd energy;     ///< dissipated by damage [mJ/mm^2]
  VectorXd broken_at;  ///< time at which the last bond of the node broke [s]; negative before
};

/// Values at the nodes of a surface for output, from the points in contact around each.
struct NodalOutput {
  VectorXd gap;             ///< [mm]
  VectorXd pressure;        ///< -t_n [MPa]
  MatrixXd flux;            ///< (fields, nodes), out of this surface's body
  MatrixXd jump;            ///< (fields, nodes), this side minus the other
  VectorXd tributary_area;  ///< area in contact that belongs to the node [mm^2]
  FrictionOutput friction;
  BreakingOutput breaking;

  /// T_max/|t_n| and (p~ - p*)/|t_n| at a node; 0 where there is no load.
  double effective_friction(Index node) const { return over_pressure(friction.bound, node); }
  double fluid_load_support(Index node) const { return over_pressure(friction.fluid, node); }

 private:
  double over_pressure(const VectorXd& values, Index node) const {
    return values.size() > node && pressure[node] > 0 ? values[node] / pressure[node] : 0.0;
  }
};

/// All output at a projected state.
struct InterfaceOutput {
  Balance balance;
  PerSide<NodalOutput> nodes;
};
InterfaceOutput output(const ContactInterface& contact, const PerSide<SurfaceFields>& fields);

}  // namespace mixture_contact
