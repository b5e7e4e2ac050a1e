/// The data that a model may ask for in its log section, under FEBio's names.
#pragma once

#include "bodies.h"

#include <string>
#include <variant>

namespace standalone {

/// Where a column of node data comes from.
struct NodeColumn {
  enum class Kind { position, value, reaction } kind;
  int dof;  ///< row of nodal values, or the axis of a position
};

/// Where a column of element data comes from: a mean over the element's points.
struct ElementColumn {
  enum class Kind { pressure, solvent_flux, concentration, solute_flux, stress } kind;
  int solute;  ///< index in the model's list
  int axis;
};

/// Node data x y z, ux uy uz, p, c1 ..., Rx Ry Rz; empty for other names.
std::optional<NodeColumn> node_column(const std::string& name, int solutes);

/// Element data p, wx wy wz, c, jx jy jz (of the first solute), c1 ..., j1x ..., sx sy sz; empty for other names.
std::optional<ElementColumn> element_column(const std::string& name, int solutes);

}  // namespace standalone
