/// Warnings of overlap in a host's log.
#pragma once

#include "contact/interface/overlap.h"

#include <string>

/// Reports that secondary nodes which primary facets do not resolve now have conditions of their own. Takes the names
/// of a contact and of its surfaces.
std::string penetration_line(const std::string& contact, const std::string& primary, const std::string& secondary,
                             const mixture_contact::UndetectedPenetration& overlap);

/// Reports that a step without a node in contact at its start has failed, with a remedy. Takes the name of a contact.
std::string open_contact_line(const std::string& contact);

/// Reports that automatic penalties are reduced from the next attempt at a step on.
std::string reduction_line(double time);

/// The largest overlap of accepted steps under reduced penalties.
struct AcceptedOverlap {
  std::string contact;
  mixture_contact::Overlap overlap;
  double time = 0;
};
/// `divisor`: of the penalties at the end of the run.
std::string accepted_overlap_line(const AcceptedOverlap& accepted, double divisor);

/// Reports an overlap that a contact does not resolve, with a remedy. Takes the names of a contact and of its surfaces.
std::string overlap_warning(const std::string& contact, const std::string& primary, const std::string& secondary,
                            const mixture_contact::UndetectedPenetration& overlap);
