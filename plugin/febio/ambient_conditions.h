/// Ambient (free-draining) conditions on the nodes of contact surfaces that are not in contact.
///
/// FEBio's solvers switch ambient nodes only for contact classes that they know by name, so the plugin does it, once
/// for all contacts of a model: a node has ambient values only if it is open in all contacts.
#pragma once

#include "contact_in_model.h"
#include "solver/febio/febio_solver.h"
#include "solver/helper.h"

#include <map>
#include <utility>
#include <vector>

class FEModel;

class AmbientConditions {
 public:
  AmbientConditions(FEModel& fem, newton::Solver& solver, newton::Helpers& helpers)
      : fem_(fem), solver_(solver), helpers_(helpers) {}

  /// Holds nodes outside contact at ambient values, and frees the others with the value that they have. It must not be
  /// called while a trial increment is evaluated. Returns whether anything changed.
  bool apply(const std::vector<ContactInModel*>& contacts);

  /// Brings the solver in step with nodes freed since the last call: an attempt that was cut back may have left it
  /// changed.
  void begin_step();

 private:
  struct NodeStatus {
    bool in_contact;
    const ContactInModel* ambient;  ///< the first free-draining contact of the node, which gives its ambient values
  };
  /// A node, or that of the back face of a shell.
  using Face = std::pair<int, bool>;
  /// The status of the nodes of free-draining contacts on which ambient conditions may act; any contact may have them
  /// in contact.
  static std::map<Face, NodeStatus> status_of_nodes(const std::vector<ContactInModel*>& contacts);
  bool apply(const DofMap& dofs, const Face& face, const NodeStatus& status);
  bool apply(newton::Place place, const NodeStatus& status);
  bool is_free(newton::Place place) const;
  bool release(newton::Place place);

  FEModel& fem_;
  newton::Solver& solver_;
  newton::Helpers& helpers_;
  std::vector<newton::Place> released_;  ///< since the last begin_step()
};
