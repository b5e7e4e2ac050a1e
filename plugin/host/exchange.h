/// The effects that a contact exchanges: those that the materials on both sides allow and the model requests.
#pragma once

#include "contact/base/effects.h"
#include "contact_parameters.h"

#include <string>
#include <vector>

/// A scalar field of a model, as one contact finds it.
struct FieldAtContact {
  int solute = -1;                     ///< index of the solute; -1: the solvent
  std::string name;                    ///< the solute's own name in the model, if it has one
  std::vector<std::string> obstacles;  ///< why this contact cannot exchange it, a clause each; empty if it can
};

/// The outcome of decide_exchange().
struct Exchange {
  mixture_contact::Effects effects;
  std::string summary;                  ///< "traction, solvent. No solute 1: ..."
  std::vector<std::string> complaints;  ///< faults of the request, one sentence each
};

/// The motion of the nodes of both surfaces, as far as it is known.
enum class Motion {
  undecided,   ///< nothing yet
  possible,    ///< at least one can move
  impossible,  ///< every displacement is fixed
  untouched,   ///< the surfaces never touch: their traction has no penalty
  tied         ///< a tie holds them together: traction is exchanged as other effects are
};

/// Adds penalties of 0, and membranes that stop a field, to the obstacles of the fields.
void leave_out(const LeftOut& left_out, std::vector<FieldAtContact>& fields);

/// The friction that a model requests.
struct FrictionRequest {
  bool has_coefficient = false;  ///< it is not 0, or a load curve changes it
  bool has_fluid = false;        ///< the pressure of a fluid on either side bears a part of the load
};

/// Decides which of the fields, ordered solvent first and solutes ascending, a contact exchanges. `asked` is the
/// parameter <effects>: "all", or names with commas between them; "solutes" stands for every solute that both sides
/// have. Traction is exchanged unless no node can move or touch; leaving it out elsewhere is a complaint. Friction is
/// an effect where it has a coefficient.
Exchange decide_exchange(const std::string& asked, const std::vector<FieldAtContact>& fields, Motion motion,
                         const FrictionRequest& friction = {});
