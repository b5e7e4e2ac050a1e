/// The parts of a pass on which its evaluation depends.
#pragma once

#include "active_set/active_set.h"
#include "enforcement/enforcement_method.h"

namespace mixture_contact {

/// The averages, laws, active set and enforcement method of a pass. They belong together: laws and method refer to the
/// same nodes, and a geometry evaluates all of them.
struct PassParts {
  /// Keeps references to both meshes, the effects and the settings.
  PassParts(const SurfaceMesh& primary, const SurfaceMesh& secondary, const Effects& effects, const Settings& settings)
      : space(primary, secondary, effects, settings),
        laws(primary, secondary, effects, settings),
        active_set(laws),
        method(enforcement_method(settings.enforcement, space, laws)) {}

  MortarSpace space;
  NodalLaws laws;
  ActiveSet active_set;
  std::unique_ptr<EnforcementMethod> method;
};

}  // namespace mixture_contact
