/// The data that a model may ask for in its log section, under FEBio's names.
#pragma once

#include "problem.h"

#include <functional>
#include <map>
#include <string>

namespace standalone {

/// What a column of node data shows at a node.
using NodeColumn = std::function<double(const Problem&, int node)>;
/// What a column of element data shows, from the means over an element of a material.
using ElementColumn = std::function<double(const Bodies::Average&, const Material&)>;

/// Node data x y z, ux uy uz, p, c1 ..., Rx Ry Rz.
std::map<std::string, NodeColumn> node_columns(int solutes);

/// Element data p, wx wy wz, sx sy sz, c1 ..., j1x ..., and c, jx jy jz of the first solute.
std::map<std::string, ElementColumn> element_columns(int solutes);

}  // namespace standalone
