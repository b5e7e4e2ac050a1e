/// A contact surface as data: facets, what may pass through them, and the fields on its nodes.
#pragma once

#include "base/effects.h"
#include "geometry/facet.h"

#include <vector>

namespace mixture_contact {

/// What does not change in a run: facets, and the properties of the material behind each.
struct SurfaceMesh {
  int nodes = 0;
  std::vector<Facet> facets;
  std::vector<FieldMask> permeable;  ///< per facet: the exchanged scalar fields that the material behind it knows
  VectorXd stiffness;    ///< per facet: normal stiffness modulus over element thickness [N/mm^3]; infinite if rigid
  MatrixXd conductance;  ///< (scalar fields, facets): conductance over thickness; 0 where sealed
};

/// The current state of a surface: one column or row per node.
struct SurfaceFields {
  Matrix3Xd position;  ///< current positions, shape (3, nodes) [mm]
  MatrixXd scalar;     ///< exchanged scalar fields, shape (nodes, fields): p~ [MPa] and c~ [mM] in the order of Effects
};

/// INT psi_a da over one facet, shape (n) [mm^2].
FacetVector areas_of_nodes(const Facet& facet, const Matrix3Xd& position);

/// INT psi_a da over all facets around each node [mm^2].
VectorXd nodal_areas(const SurfaceMesh& mesh, const Matrix3Xd& position);

/// Half the diagonal of the box around all nodes [length].
double half_diagonal(const Matrix3Xd& position);

}  // namespace mixture_contact
