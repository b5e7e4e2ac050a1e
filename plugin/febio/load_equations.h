/// Equations of FEBio's matrix for nodal loads in mixed form (host/mixed_form.h).
///
/// The unknowns exist in the linear system only; the loads themselves follow from displacements and fields.
#pragma once

#include "node_equations.h"

#include <vector>

/// A load that is an unknown of the linear system.
struct UnknownLoad {
  int equation = -1;      ///< equation of the load; -1 if the load is no unknown
  std::vector<int> node;  ///< all equations of the load's node
};

/// A traction that is proportional to an unknown of the matrix.
struct UnknownTraction {
  mixture_contact::Side surface;
  int node;
  int equation;
  double of_one;  ///< traction for a value of 1 of the unknown [MPa]
};

/// Assigns equations to nodal loads.
class LoadEquations {
 public:
  using Side = mixture_contact::Side;

  /// Assigns equations, from the number `first` on, to the loads of the nodes of these surfaces. Returns their number.
  int number(int first, const mixture_contact::ContactInterface& core, mixture_contact::PerSide<bool> surfaces);
  /// The equation of a load; -1 if it has none. Loads of surfaces without equations have none, and neither have loads
  /// that depend on a rigid body, because FEBio assembles the equations of rigid bodies in blocks of nodes.
  int of(const NodeEquations& equations, const mixture_contact::ContactInterface& core, Side surface,
         const mixture_contact::LoadPlace& load) const;
  /// The load as an unknown: its equation from of(), and the equations of its node.
  UnknownLoad unknown(const NodeEquations& equations, const mixture_contact::ContactInterface& core, Side surface,
                      const mixture_contact::LoadPlace& load) const;
  /// True if the loads of a surface have equations.
  bool has(Side surface) const { return start_[surface] >= 0; }
  /// The first equation of all loads.
  int first() const { return first_; }
  int count() const { return count_; }
  void serialize(DumpStream& ar);

 private:
  int first_ = 0;
  int count_ = 0;
  mixture_contact::PerSide<int> start_{{-1, -1}};  ///< first equation of a surface's loads; -1 if they have none
};
