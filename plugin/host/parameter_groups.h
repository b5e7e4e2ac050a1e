/// Under which headings a user finds the parameters of a contact.
#pragma once

#include <string>

/// The heading of a parameter in FEBio Studio, which is that of the documentation; null for a parameter of old models
/// that FEBio Studio does not offer.
const char* parameter_group(const std::string& name);
