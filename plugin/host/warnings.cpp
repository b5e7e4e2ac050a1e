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
  text
      << "away from contact: primary facets do not resolve what is smaller than they are. From now on these nodes, and "
      << "others like them, have contact conditions of their own. This is said once in a run.";
  return text.str();
}

std::string overlap_warning(const std::string& contact, const std::string& primary, const std::string& secondary,
                            const UndetectedPenetration& overlap) {
  std::ostringstream text = nodes_inside(contact, primary, secondary, overlap);
  text << "without any load there: means over the facets around nodes are open on both sides. Refine both surfaces "
       << "there, or take the finer or more pointed one as the primary one. This is said once in a run.";
  return text.str();
}

std::string open_contact_line(const std::string& contact) {
  return "sliding-mixture \"" + contact +
         "\": the step that has failed began without a node in contact. A body that this contact alone holds moves "
         "freely until then. Gaps are averages around the nodes of the primary surface: they may be open though single "
         "points overlap. The next attempt begins in contact around points that do. If it fails, too: let the surfaces "
         "overlap more at the start, bring them together by a prescribed displacement first, or refine the primary "
         "surface. This is said once in a run.";
}

std::string reduction_line(double time) {
  std::ostringstream text;
  text << "sliding-mixture: the step to time " << time
       << " has failed. The next attempt has automatic penalties of the "
       << "traction divided by up to 1000, down to the stiffness of the elements; they recover tenfold with accepted "
       << "steps. A <penalty> that is set stays as it is. This is said once in a run.";
  return text.str();
}

std::string accepted_overlap_line(const AcceptedOverlap& accepted, double divisor) {
  std::ostringstream text;
  text << std::setprecision(3) << "sliding-mixture: while automatic penalties were reduced, the largest overlap of an "
       << "accepted step was " << accepted.overlap.depth << ", which is " << accepted.overlap.share
       << " of an element's edge, in \"" << accepted.contact << "\" at time " << accepted.time << ". ";
  if (divisor > 1) text << "At the end of the run they are still divided by " << divisor << ".";
  return text.str();
}
