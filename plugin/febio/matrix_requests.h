/// The requests of a contact for the matrices of the model's steps.
#pragma once

#include "contact_log.h"

#include <FECore/FEModel.h>

/// Makes the matrices non-symmetric from the present step on, and says so.
void ask_for_nonsymmetric_matrix(FEModel& model, const ContactLog& log);

/// Whether the present step's matrices may have any structure; those that are to have a symmetric one may not.
bool takes_any_structure(FEModel& model);

/// Whether the present step takes loads at nodes as further unknowns of its matrices (host/mixed_form.h).
bool takes_mixed_form(FEModel& model);

/// Says in the log where a linear solver cannot solve the matrix with this contact.
void judge_linear_solver(FEModel& model, bool has_unknown_multipliers, const ContactLog& log);
