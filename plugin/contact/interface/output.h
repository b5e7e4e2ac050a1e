/// What a contact says about itself: balances and values at nodes.
#pragma once

#include "interface/interface.h"

namespace mixture_contact {

/// What crosses the interface, as it acts on the primary surface; the secondary surface gets the exact opposite.
struct Balance {
  Vector3d force{0, 0, 0};  ///< contact force on the primary surface [N]
  double area = 0;          ///< area in contact [mm^2]
  VectorXd flow;            ///< flow out of the primary body per exchanged field [mm^3/s] or [nmol/s]
};

/// Values at the nodes of a surface for output, from the points in contact around each.
struct NodalOutput {
  VectorXd gap;             ///< [mm]
  VectorXd pressure;        ///< -t_n [MPa]
  MatrixXd flux;            ///< (fields, nodes), out of this surface's body
  MatrixXd jump;            ///< (fields, nodes), this side minus the other
  VectorXd tributary_area;  ///< area in contact that belongs to the node [mm^2]
};

Balance balance(const ContactInterface& contact, const PerSide<SurfaceFields>& fields);
NodalOutput nodal_output(const ContactInterface& contact, Side side, const PerSide<SurfaceFields>& fields);

}  // namespace mixture_contact
