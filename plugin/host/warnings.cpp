#include "warnings.h"

#include <iomanip>
#include <sstream>

using mixture_contact::UndetectedPenetration;

namespace {

/// The start of a sentence: "contact: n nodes of the secondary surface ... inside the body of ..., up to a depth of
/// ...".
std::ostringstream nodes_inside(const std::string& contact, const std::string& primary, const std::string& secondary,
                                const UndetectedPenetration& overlap) {
  std::ostringstream text;
  text << std::setprecision(3) << "sliding-mixture \"" << contact << "\": " << overlap.nodes
       << (overlap.nodes == 1 ? " node" : " nodes") << " of the secondary surface \"" << secondary
       << "\" inside the body of \"" << primary << "\", up to a depth of " << overlap.depth << ", which is "
       << overlap.share << " of a facet's edge, ";
  return text;
}

}  // namespace

std::string penetration_line(const std::string& contact, const std::string& primary, const std::string& secondary,
                             const UndetectedPenetration& overlap) {
  std::ostringstream text = nodes_inside(contact, primary, secondary, overlap);
  text << "away from contact: primary facets do not resolve smaller features. From now on these nodes, and other nodes "
       << "that penetrate in this way, have contact conditions of their own. The log reports this once in a run.";
  return text.str();
}

std::string overlap_warning(const std::string& contact, const std::string& primary, const std::string& secondary,
                            const UndetectedPenetration& overlap) {
  std::ostringstream text = nodes_inside(contact, primary, secondary, overlap);
  text << "without any load there: the averages over the facets around these nodes are open on both sides. Refine both "
       << "surfaces there, or take the finer or sharper one as the primary one. The log reports this once in a run.";
  return text.str();
}

std::string open_contact_line(const std::string& contact) {
  return "sliding-mixture \"" + contact +
         "\": the failed step began without a node in contact. A body that this contact alone supports moves freely "
         "without contact. Gaps are averages around the nodes of the primary surface, and may be open although single "
         "points overlap. The next attempt begins with the nodes around overlapping points in contact, or with the nearest "
         "nodes if nothing overlaps. If it fails too, "
         "let the surfaces overlap more at the start, bring them together by a prescribed displacement first, or refine "
         "the primary surface. The log reports this once in a run.";
}

std::string reduction_line(double time) {
  std::ostringstream text;
  text << "sliding-mixture: the step to time " << time
       << " has failed. The next attempt divides automatic penalties of the "
       << "traction by up to 1000, down to the stiffness of the elements. They recover tenfold with each accepted "
       << "step. A <penalty> of the model does not change. The log reports this once in a run.";
  return text.str();
}

std::string accepted_overlap_line(const AcceptedOverlap& accepted, double divisor) {
  std::ostringstream text;
  text << std::setprecision(3) << "sliding-mixture: while automatic penalties were reduced, the largest overlap of an "
       << "accepted step was " << accepted.overlap.depth << ", which is " << accepted.overlap.share
       << " of an element's edge, in \"" << accepted.contact << "\" at time " << accepted.time << ". ";
  if (divisor > 1) text << "At the end of the run these penalties are still divided by " << divisor << ".";
  return text.str();
}
