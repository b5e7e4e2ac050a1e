/// Warnings of overlap in a host's log.
#pragma once

#include "contact/interface/overlap.h"

#include <string>

/// Says that secondary nodes which primary facets do not resolve have conditions of their own from now on; a contact's
/// name and those of its surfaces.
std::string penetration_line(const std::string& contact, const std::string& primary, const std::string& secondary,
                             const mixture_contact::UndetectedPenetration& overlap);

/// Says that a step has failed which began without a node in contact, and what a user can do about it; a contact's
/// name.
std::string open_contact_line(const std::string& contact);

/// Says that automatic penalties are reduced from the next attempt at a step on.
std::string reduction_line(double time);

/// The largest overlap of accepted steps under reduced penalties.
struct AcceptedOverlap {
  std::string contact;
  mixture_contact::Overlap overlap;
  double time = 0;
};
/// `divisor`: of the penalties at the end of the run.
std::string accepted_overlap_line(const AcceptedOverlap& accepted, double divisor);

/// Says that a contact does not resolve an overlap, and what a user can do about it; a contact's name and those of its
/// surfaces.
std::string overlap_warning(const std::string& contact, const std::string& primary, const std::string& secondary,
                            const mixture_contact::UndetectedPenetration& overlap);
