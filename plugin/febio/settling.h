/// Active-set prediction: the nodes in contact at the end of an iteration, by solutions with its matrix.
///
/// An iteration begins with the nodes that overlap at its state: more than will be in contact at its end, since each
/// that closes takes load from those around it, and without those that come into contact within it. The factorised
/// matrix gives the tractions and gaps at the end of the iteration. Each node that would pull opens, each that would
/// overlap closes, and the matrix is asked once more, until all stay: the active set of the linearised problem, by the
/// rule that leads from iteration to iteration (contact/active_set/active_set.h). Each change of a node takes a back
/// substitution.
#pragma once

#include "contact_in_model.h"
#include "solver/febio/kept_matrix.h"

#include <functional>
#include <vector>

/// The data of a model for active-set prediction.
struct SettledModel {
  std::vector<ContactInModel*> contacts;    ///< all that are active
  std::function<void()> evaluate_residual;  ///< with loads that have changed
  double time_increment;                    ///< [s]
};

/// Opens nodes that would pull and closes those that would overlap, before FEBio solves. If that does not converge,
/// nothing changes. Returns whether any has opened or closed.
bool settle(const SettledModel& model, newton::KeptMatrix& matrix);

/// The conditions that matrices lack with the loads of another status (see Assembly::conditions()).
std::vector<newton::Condition> conditions(const std::vector<ContactInModel*>& contacts, double dt);
/// The deferred coupling terms of these contacts.
newton::MatrixParts matrix_parts(const std::vector<ContactInModel*>& contacts);
