/// What a contact cost, as hosts write it at the end of a run.
#pragma once

#include "contact/effects.h"
#include "contact/times.h"

#include <string>
#include <vector>

/// The lines of a table: seconds by task (rows) and effect (columns), and their share of the run.
///
/// `run`: seconds since the run began.
std::vector<std::string> price_table(const std::string& contact, const mixture_contact::Effects& effects,
                                     const mixture_contact::Times& times, double run);
