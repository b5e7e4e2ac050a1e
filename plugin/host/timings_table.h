/// The times of a contact, as hosts write them at the end of a run.
#pragma once

#include "contact/interface/interface.h"

#include <string>
#include <vector>

/// The lines of a table: seconds by task (rows) and effect (columns), their share of the run, and memory.
///
/// `name`: of the contact; `run`: seconds since the run began.
std::vector<std::string> timings_table(const std::string& name, const mixture_contact::ContactInterface& contact,
                                       double run);
