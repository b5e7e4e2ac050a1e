/// Ambient (free-draining) conditions at nodes of contact surfaces that are not in contact.
///
/// FEBio's solvers set ambient values only for contact classes that they know. The plugin therefore sets them, once for
/// all contacts of a model: a node has ambient values only if it is open in all contacts.
#pragma once

#include "contact_in_model.h"
#include "solver/febio/febio_solver.h"
#include "solver/helper.h"

#include <map>
#include <utility>
#include <vector>

class FEModel;

/// Sets ambient values at the open nodes of a model.
class AmbientConditions {
 public:
  /// Prescribes ambient values at nodes out of contact, and frees the other nodes, which keep their values. It must not
  /// be called while a trial increment is evaluated. `helpers`: may keep the values of nodes. Returns true if anything
  /// changed.
  bool apply(FEModel& fem, newton::Solver& solver, newton::Helpers& helpers,
             const std::vector<ContactInModel*>& contacts);

  /// Sets the solver's vectors for nodes that were freed since the last call, because a failed attempt may have changed
  /// these vectors.
  void begin_step(newton::Solver& solver);

 private:
  struct NodeStatus {
    bool in_contact;
    const ContactInModel* ambient;  ///< first free-draining contact of the node, whose ambient values apply
  };
  /// A node of the mesh, and whether the back face of its shell is meant.
  using Face = std::pair<int, bool>;
  /// The status of the nodes to which ambient conditions may apply: those of free-draining contacts. The contact status
  /// takes all contacts into account.
  static std::map<Face, NodeStatus> status_of_nodes(const std::vector<ContactInModel*>& contacts);
  bool release(newton::Solver& solver, newton::Place place);

  std::vector<newton::Place> released_;  ///< values freed since the last begin_step()
};
