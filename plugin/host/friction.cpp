#include "friction.h"

#include <cmath>

using mixture_contact::FrictionKind;

namespace {

/// True if the contact has friction, or may get friction by a load curve.
bool has_friction(const ContactParameters& p) {
  return p.friction.fric_coeff.value != 0 || p.friction.fric_coeff.varies;
}

/// The tangential penalty divided by a traction penalty of `factor` times the stiffness. If the model sets the traction
/// penalty, the default is 1, as in FEBio's interfaces.
double tangential_factor(const ContactParameters& p, double factor) {
  const Given<double>& own = p.friction.tangential_penalty;
  if (own.given || p.penalties.traction.given) return own.value;
  return mixture_contact::friction_factor(factor);
}

}  // namespace

void complain_of_friction(const ContactParameters& p, std::vector<std::string>& list) {
  const bool is_part = p.friction.contact_frac.value >= 0 && p.friction.contact_frac.value <= 1;
  if (!is_part) {
    list.emplace_back("<contact_frac> is " + std::to_string(p.friction.contact_frac.value) +
                      "; it must lie between 0 and 1.");
  }
  const bool is_positive = std::isfinite(p.friction.tangential_penalty.value) &&
                           p.friction.tangential_penalty.value > 0;
  if (!is_positive) {
    list.emplace_back(
        "<tangential_penalty> is " + std::to_string(p.friction.tangential_penalty.value) +
        "; it must be a positive number, the factor of the tangential penalty over that of the traction.");
  }
  if (p.enforcement.laugon == lagmult && has_friction(p)) {
    list.emplace_back(
        "<fric_coeff> is set with <laugon>LAGMULT</laugon>: unknown multipliers act in the normal direction alone. Use "
        "AUGLAG, which meets stick within its tolerance, or PENALTY.");
  }
}

void note_friction(const ContactParameters& p, std::vector<std::string>& list) {
  if (!has_friction(p)) {
    const auto note = [&](bool given, const std::string& name) {
      if (given) list.push_back("<" + name + "> has no effect: <fric_coeff> is 0.");
    };
    note(p.friction.contact_frac.given, "contact_frac");
    note(p.friction.tangential_penalty.given, "tangential_penalty");
    note(p.unused.smooth_fls.given && p.unused.smooth_fls.value, "smooth_fls");
    return;
  }
  if (p.unused.smooth_fls.given && p.unused.smooth_fls.value)
    list.emplace_back("<smooth_fls> has no effect: the contact always averages the fluid load support around nodes.");
  if (p.enforcement.symmetric_stiffness) {
    list.emplace_back(
        "<symmetric_stiffness> is 1, and the tangent of friction is not symmetric. The contact uses its symmetric part, "
        "and convergence is slower.");
  }
}

FrictionKind requested_friction(const ContactParameters& p, bool has_fluid) {
  if (!has_friction(p)) return FrictionKind::none;
  const bool is_relieved = p.friction.contact_frac.value < 1 || p.friction.contact_frac.varies;
  return has_fluid && is_relieved ? FrictionKind::on_solid_part : FrictionKind::on_traction;
}

void decide_friction(FrictionKind requested, bool named, bool wanted, Exchange& result,
                     std::vector<std::string>& present, std::string& absent) {
  if (requested == FrictionKind::none) {
    if (named) result.complaints.emplace_back("<effects> includes friction, but <fric_coeff> is 0.");
    return;
  }
  if (!wanted) {
    absent += " No friction: <effects> omits it.";
    return;
  }
  result.effects.friction_kind = requested;
  if (result.effects.traction) {
    present.emplace_back("friction");
  } else {
    absent += " No friction: there is no traction.";
  }
}

bool reads_ambient_values(const ContactParameters& p) { return p.ambient.free_draining || has_friction(p); }

mixture_contact::FrictionRule friction_rule(const ContactParameters& p, double factor) {
  return {p.friction.fric_coeff.value, p.friction.contact_frac.value, p.ambient.pressure, tangential_factor(p, factor)};
}
