/// Lines for the log about overlaps and reduced penalties.
#pragma once

#include "contact/interface/overlap.h"

#include <string>

/// Reports that secondary nodes which primary facets do not resolve now have conditions of their own. Arguments: names
/// of the contact and of its surfaces, and the overlap.
std::string penetration_line(const std::string& contact, const std::string& primary, const std::string& secondary,
                             const mixture_contact::UndetectedPenetration& overlap);

/// Reports that a step failed that began without a node in contact, with a remedy. `contact`: name of the contact.
std::string open_contact_line(const std::string& contact);

/// Reports that automatic penalties are reduced from the next attempt at a step on. `time`: end of the failed step [s].
std::string reduction_line(double time);

/// The largest overlap of the accepted steps with reduced penalties.
struct AcceptedOverlap {
  std::string contact;
  mixture_contact::Overlap overlap;
  /// Time of the step [s].
  double time = 0;
};
/// Reports the largest overlap that was accepted with reduced penalties. `divisor`: divisor of the penalties at the end
/// of the run.
std::string accepted_overlap_line(const AcceptedOverlap& accepted, double divisor);

/// Reports an overlap that a contact does not resolve, with a remedy. Arguments: names of the contact and of its
/// surfaces, and the overlap.
std::string overlap_warning(const std::string& contact, const std::string& primary, const std::string& secondary,
                            const mixture_contact::UndetectedPenetration& overlap);
