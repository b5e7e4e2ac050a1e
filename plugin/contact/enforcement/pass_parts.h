/// The parts of a pass on which its evaluation depends.
#pragma once

#include "active_set/active_set.h"
#include "enforcement/enforcement_method.h"

namespace mixture_contact {

/// The nodes, active set and enforcement method of a pass. A geometry evaluates all of them.
struct PassParts : PassNodes {
  /// Keeps references to both meshes, the effects and the settings.
  PassParts(const SurfaceMesh& primary, const SurfaceMesh& secondary, const Effects& effects, const Settings& settings)
      : PassNodes{{primary, secondary, effects, settings}, {primary, secondary, effects, settings}},
        active_set(laws),
        method(enforcement_method(settings.enforcement, effects.friction_kind)) {}

  /// True if tangents of nodes consist of load blocks only. The symmetric part of such a tangent is no product of two
  /// vectors.
  bool has_load_blocks() const { return method->has_load_blocks() && !space.symmetric(); }

  ActiveSet active_set;
  std::unique_ptr<EnforcementMethod> method;
};

}  // namespace mixture_contact
