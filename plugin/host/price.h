/// What a contact cost, as hosts write it at the end of a run.
#pragma once

#include "contact/interface/interface.h"

#include <string>
#include <vector>

/// The lines of a table: seconds by task (rows) and effect (columns), their share of the run, and memory.
///
/// `name`: of the contact; `run`: seconds since the run began.
std::vector<std::string> price_table(const std::string& name, const mixture_contact::ContactInterface& contact,
                                     double run);
