#include "conditions/nodal_loads.h"

namespace mixture_contact {

NodalLoads change(const NodalLoads& from, const NodalLoads& to) {
  NodalLoads difference = to;
  difference.traction -= from.traction;
  difference.flux -= from.flux;
  difference.friction.traction -= from.friction.traction;
  for (Index node = 0; node < from.in_contact.count(); ++node) {
    if (from.in_contact[node]) difference.in_contact[node] = true;
  }
  return difference;
}

}  // namespace mixture_contact
