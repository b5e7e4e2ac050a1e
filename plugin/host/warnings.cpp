#include "warnings.h"

#include <iomanip>
#include <sstream>

std::string overlap_warning(const std::string& contact, const std::string& primary, const std::string& secondary,
                            const mixture_contact::UnnoticedOverlap& overlap) {
  std::ostringstream text;
  text << std::setprecision(3) << "sliding-mixture \"" << contact << "\": " << overlap.nodes
       << (overlap.nodes == 1 ? " node" : " nodes") << " of the secondary surface \"" << secondary
       << "\" inside the body of \"" << primary << "\" without any load there, up to a depth of " << overlap.depth
       << ", which is " << overlap.share
       << " of a facet's edge. Primary facets do not notice what is smaller than they "
       << "are: take the finer or more pointed surface as the primary one, set <two_pass>1</two_pass>, or refine \""
       << primary << "\". This is said once in a run.";
  return text.str();
}
