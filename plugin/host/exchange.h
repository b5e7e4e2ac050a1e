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

/// Friction as the model requests it.
struct FrictionRequest {
  bool has_coefficient = false;  ///< true if the coefficient of friction is not 0 or a load curve changes it
  bool has_fluid = false;        ///< true if fluid pressure on either side bears a part of the load
};

/// The friction that the parameters request. `has_fluid`: true if a body has fluid whose pressure is an unknown.
FrictionRequest friction_request(const ContactParameters& parameters, bool has_fluid);

/// Decides which effects a contact exchanges.
///
/// `asked`: the parameter <effects>: "all", or names separated by commas, in which "solutes" means all solutes of both
/// sides. `fields`: solvent first, then solutes, ascending. Traction is exchanged unless no node can move or touch; to
/// leave it out otherwise is a fault. Friction is an effect if it has a coefficient.
Exchange decide_exchange(const std::string& asked, const std::vector<FieldAtContact>& fields, Motion motion,
                         const FrictionRequest& friction = {});
