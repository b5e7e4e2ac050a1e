/// The effects that a contact exchanges: those that the materials on both sides permit and the model requests.
#pragma once

#include "contact/base/effects.h"
#include "contact_parameters.h"

#include <string>
#include <vector>

/// A scalar field of the model at a contact.
struct FieldAtContact {
  int solute = -1;   ///< index of the solute; -1: the solvent
  std::string name;  ///< name of the solute in the model, if it has one
  /// Reasons why this contact cannot exchange the field, one clause each; empty if it can.
  std::vector<std::string> obstacles;
};

/// The outcome of decide_exchange().
struct Exchange {
  mixture_contact::Effects effects;
  std::string summary;                  ///< summary for the log, for example "traction, solvent. No solute 1: ..."
  std::vector<std::string> complaints;  ///< faults of the request, one sentence each
};

/// The possible motion of the nodes of both surfaces.
enum class Motion {
  undecided,   ///< not known yet
  possible,    ///< at least one node can move
  impossible,  ///< all displacements are fixed
  untouched,   ///< the surfaces never touch, because the traction has no penalty
  tied         ///< a tie joins the surfaces; traction is exchanged if the other effects are requested in the same way
};

/// Adds penalties of 0, and membranes that stop a field, to the obstacles of the fields.
void leave_out(const LeftOut& left_out, std::vector<FieldAtContact>& fields);

/// Decides which effects a contact exchanges.
///
/// `asked`: the parameter <effects>: "all", or names separated by commas, in which "solutes" means all solutes of both
/// sides. `fields`: solvent first, then solutes, ascending. Traction is exchanged unless no node can move or touch; to
/// leave it out otherwise is a fault. `friction`: the friction that the model requests.
Exchange decide_exchange(const std::string& asked, const std::vector<FieldAtContact>& fields, Motion motion,
                         mixture_contact::FrictionKind friction = mixture_contact::FrictionKind::none);
