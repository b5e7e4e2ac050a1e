/// What a host's log warns of.
#pragma once

#include "contact/interface.h"

#include <string>

/// Says that a contact does not notice an overlap, and what a user can do about it; a contact's name and those of its
/// surfaces.
std::string overlap_warning(const std::string& contact, const std::string& primary, const std::string& secondary,
                            const mixture_contact::UnnoticedOverlap& overlap);
