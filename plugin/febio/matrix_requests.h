/// The requests of a contact for the matrices of the model's steps.
#pragma once

#include "contact_log.h"

#include <FECore/FEModel.h>

/// Makes the matrices non-symmetric from the present step on, and logs this.
void ask_for_nonsymmetric_matrix(FEModel& model, const ContactLog& log);

/// Whether the present step accepts any matrix structure; false if it requires a symmetric one.
bool takes_any_structure(FEModel& model);

/// Whether the matrices of the present step may have loads at nodes as further unknowns (host/mixed_form.h).
bool takes_mixed_form(FEModel& model);

/// Warns in the log of a linear solver that cannot solve the matrix with this contact.
void judge_linear_solver(FEModel& model, bool has_unknown_multipliers, const ContactLog& log);
