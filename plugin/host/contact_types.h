/// The contact types of this plugin and their parameters, for programs that check, convert, write and document models.
#pragma once

#include <string>

/// The contact types in the order of the documentation, as JSON. Each name has a list of its parameters in order, each
/// with name, long_name, group (heading in FEBio Studio, null if not shown), unit, kind (switch, integer, number, word
/// or values per solute), default, choices (names of the values 0, 1, ...) and curve (true if a load curve may change
/// it).
std::string contact_types_json();
