/// Equations of FEBio's matrix for loads at nodes in mixed form (host/mixed_form.h).
///
/// Their unknowns serve the linear solver alone: the loads themselves follow from displacements and fields.
#pragma once

#include "node_equations.h"

#include <vector>

/// A load that is an unknown of the linear system.
struct UnknownLoad {
  int equation = -1;      ///< its own; -1: it is none
  std::vector<int> node;  ///< all equations of its own node
};

/// A traction that follows from an unknown of the matrix.
struct UnknownTraction {
  mixture_contact::Side surface;
  int node;
  int equation;
  double of_one;  ///< unit of the unknown [MPa]
};

class LoadEquations {
 public:
  using Side = mixture_contact::Side;

  /// Takes equations for the loads of these surfaces' nodes from this number on. Returns how many.
  int number(int first, const mixture_contact::ContactInterface& core, mixture_contact::PerSide<bool> surfaces);
  /// The equation of a load; -1 where it has none, and is no part of a mixed form: on a surface that took no equations,
  /// and where the load depends on a rigid body, whose equations FEBio brings in by blocks of nodes.
  int of(const NodeEquations& equations, const mixture_contact::ContactInterface& core, Side surface,
         const mixture_contact::LoadPlace& load) const;
  /// The unknown that a load is: its equation, as of() finds it, and those of its node.
  UnknownLoad unknown(const NodeEquations& equations, const mixture_contact::ContactInterface& core, Side surface,
                      const mixture_contact::LoadPlace& load) const;
  /// Whether the loads of a surface's nodes have any.
  bool has(Side surface) const { return start_[surface] >= 0; }
  /// The first of all.
  int first() const { return first_; }
  int count() const { return count_; }
  void serialize(DumpStream& ar);

 private:
  int first_ = 0;
  int count_ = 0;
  mixture_contact::PerSide<int> start_{{-1, -1}};  ///< the first of a surface; -1 where it has none
};
