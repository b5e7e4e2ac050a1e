/// The times of a contact as a table for the end of the log.
#pragma once

#include "contact/interface/interface.h"

#include <string>
#include <vector>

/// The lines of the table: seconds by task (rows) and effect (columns), their fraction of the run, and memory.
///
/// `name`: name of the contact. `run`: seconds since the start of the run.
std::vector<std::string> timings_table(const std::string& name, const mixture_contact::ContactInterface& contact,
                                       double run);
