/// The contact types of this plugin and their parameters, for programs that check, convert, write and document models.
#pragma once

#include <string>

/// The types in the order of the documentation, as JSON: for each name a list of its parameters in their order, each
/// with name, long_name, group (the heading in FEBio Studio, null if it offers none), unit, kind (switch,
/// integer, number, word or values per solute), default, choices (names of the values 0, 1, ...) and curve (whether a
/// load curve may change it).
std::string contact_types_json();
