/// Active-set prediction: the nodes in contact at the end of an iteration, from solutions with its matrix.
///
/// An iteration begins with the nodes that overlap at its state. These are more than will be in contact at its end,
/// because each closing node reduces the load of its neighbours; nodes that come into contact within the iteration are
/// missing. The factorised matrix gives the tractions and gaps at the end of the iteration. Each node with a tensile
/// traction opens, each node with an overlap closes, and the system is solved again until no node changes. The result
/// is the active set of the linearised problem, by the same rule as from iteration to iteration
/// (contact/active_set/active_set.h). Each change of a node takes a back substitution; the host
/// performs those of many nodes together.
#pragma once

#include "contact_in_model.h"
#include "solver/febio/kept_matrix.h"

#include <functional>
#include <vector>

/// The data of a model for active-set prediction.
struct SettledModel {
  std::vector<ContactInModel*> contacts;    ///< all active contacts
  std::function<void()> evaluate_residual;  ///< evaluates the residual after loads have changed
  double time_increment;                    ///< time increment [s]
};

/// Before FEBio solves, opens the nodes that the prediction finds in tension at the end of the iteration, and closes
/// those that it finds overlapping. If the prediction does not converge, no node changes. Returns true if any node has
/// opened or closed.
bool settle(const SettledModel& model, newton::KeptMatrix& matrix);

/// The conditions that correct the matrix for the present status of these contacts (see Assembly::conditions()).
std::vector<newton::Condition> conditions(const std::vector<ContactInModel*>& contacts, double dt);
/// The equations on which the conditions and deferred parts of these contacts depend (see Assembly::equations()).
std::vector<int> equations(const std::vector<ContactInModel*>& contacts);
/// The deferred coupling terms of these contacts.
newton::MatrixParts matrix_parts(const std::vector<ContactInModel*>& contacts);
