/// Requirements of a contact on the matrices of the model's steps.
#pragma once

#include "contact_log.h"

#include <FECore/FEModel.h>

/// Makes the matrices from the present step on non-symmetric, and logs this.
void ask_for_nonsymmetric_matrix(FEModel& model, const ContactLog& log);

/// True if the present step accepts matrices of any structure; false if it requires symmetric ones.
bool takes_any_structure(FEModel& model);

/// True if the matrices of the present step may have nodal loads as further unknowns (host/mixed_form.h).
bool takes_mixed_form(FEModel& model);

/// Logs a warning if the linear solver cannot solve a matrix with this contact.
void judge_linear_solver(FEModel& model, bool has_unknown_multipliers, const ContactLog& log);
