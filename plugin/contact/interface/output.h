/// What a contact says about itself: balances and values at nodes.
#pragma once

#include "interface/facing_nodes.h"

namespace mixture_contact {

/// What crosses the interface, as it acts on the primary surface; the secondary surface gets the exact opposite.
struct Balance {
  Vector3d force{0, 0, 0};  ///< contact force on the primary surface [N]
  double area = 0;          ///< area in contact [mm^2]
  VectorXd flow;            ///< flow out of the primary body per exchanged field [mm^3/s] or [nmol/s]
};

/// Values at the nodes of a surface for output, from the points in contact around each.
struct NodalOutput {
  VectorXd gap;       ///< [mm]
  VectorXd pressure;  ///< -t_n [MPa]
  MatrixXd flux;      ///< (fields, nodes), out of this surface's body
  MatrixXd jump;      ///< (fields, nodes), this side minus the other
  VectorXd coverage;  ///< area in contact that belongs to the node [mm^2]
};

/// All passes of a contact, and what their outcomes are put together by.
struct AllPasses {
  const std::vector<SidedPass>& passes;
  const PerSide<SurfaceMesh>& mesh;
  Index fields;
  bool two_pass;  ///< two full ones, instead of one and a part of the other
};

Balance balance_of(const AllPasses& all, const PerSide<SurfaceFields>& fields);
NodalOutput nodal_output_of(const AllPasses& all, Side side, const PerSide<SurfaceFields>& fields);

}  // namespace mixture_contact
