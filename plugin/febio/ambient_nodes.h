/// Ambient (free-draining) conditions on the nodes of contact surfaces that are not in contact.
///
/// FEBio's solvers switch ambient nodes only for contact classes that they know by name, so the plugin does it, in
/// FEBio's own way: a degree of freedom with equation n counts as prescribed while its id is -n-2.
#pragma once

#include <FECore/FENewtonSolver.h>
#include <FECore/FENode.h>

#include <utility>
#include <vector>

class FEModel;

/// Switches degrees of freedom between free and ambient, and keeps FEBio's solution vector in step with the nodal
/// values.
class AmbientNodes {
 public:
  explicit AmbientNodes(FEModel& fem) : fem_(fem) {}

  /// Whether ambient conditions may act on a degree of freedom: it exists and no boundary condition holds it.
  static bool is_free(const FENode& node, int dof);

  /// Makes a held degree of freedom free; the solver's solution vector is left as it is. Returns whether it was held.
  static bool make_free(FENode& node, int dof);

  /// Makes a held degree of freedom free, with the value it has now, in the node and in the solver's solution vector.
  /// Returns whether it was held.
  static bool release_with_value(FENewtonSolver& newton, FENode& node, int dof);

  /// Brings the solver's solution vector in step with the nodal value of a free degree of freedom.
  static void synchronise(FENewtonSolver& newton, const FENode& node, int dof);

  /// Holds a degree of freedom at a value. Returns whether anything changed.
  static bool hold_at(FENode& node, int dof, double value);

  /// Makes a degree of freedom free again, with the value it has now: without this, FEBio would set it to what its
  /// solution vector last knew, which is its value before it became ambient. Not to be called while a trial increment
  /// is evaluated. Returns whether anything changed.
  bool release(FENode& node, int dof);

  /// Brings the solution vector in step with the nodal values at the start of a step, where an attempt that was cut
  /// back may have left it changed.
  void synchronise();

 private:
  FENewtonSolver* solver() const;

  FEModel& fem_;
  std::vector<std::pair<FENode*, int>> released_;  ///< since the last synchronise()
};
