/// The state of a contact between time steps.
#pragma once

#include "conditions/nodal_laws.h"
#include "mortar/boundary_weights.h"

namespace mixture_contact {

/// All data of a contact that are kept between time steps, for the host to store and restore.
struct ContactState {
  std::vector<int> check_nodes;          ///< secondary nodes to which a second pass is restricted, ascending
  std::vector<Multipliers> multipliers;  ///< multipliers per pass
  PerSide<Matrix3Xd> slips_from;         ///< positions from which slips are measured; empty without friction
  std::vector<LoadCarriers> carriers;    ///< load carriers per pass, on which those of the next step depend
  std::vector<NodeFlags> faced;          ///< nodes of the other surface that face contact, per pass; empty if unknown
  double overlap = 0;                    ///< deepest accepted overlap, if it extends a given search radius [length]
};

/// Throws std::invalid_argument unless a state has the nodes, fields and passes of a contact.
void check(const ContactState& state, const PerSide<SurfaceMesh>& mesh, const Effects& effects, bool two_pass);

}  // namespace mixture_contact
