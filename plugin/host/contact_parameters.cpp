#include "contact_parameters.h"

#include "contact/conditions/normal.h"
#include "contact/geometry/quadrature.h"
#include "friction.h"
#include "membrane.h"
#include "penalty_reduction.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

using mixture_contact::PenaltyRule;

/// The rule of a penalty: automatic with a large factor by default. A penalty that the model sets is a value, or with
/// auto_penalty a factor.
PenaltyRule penalty_rule(const Varying& penalty, bool auto_penalty, double default_factor) {
  return penalty.given ? PenaltyRule{auto_penalty, penalty.value} : PenaltyRule{true, default_factor};
}

void require_not_negative(std::vector<std::string>& list, const char* name, double value) {
  if (std::isfinite(value) && value >= 0) return;
  list.emplace_back("<" + std::string(name) + "> is " + std::to_string(value) + "; it must be zero or positive.");
}

mixture_contact::Enforcement enforcement(int laugon) {
  using mixture_contact::Enforcement;
  if (laugon == lagmult) return Enforcement::lagrange_multipliers;
  return laugon == 1 ? Enforcement::augmented_lagrangian : Enforcement::penalty;
}

/// True if both of two facing surfaces have conditions of their own.
bool sees_both_ways(const ContactParameters& p) { return p.enforcement.two_pass || p.self_contact; }

mixture_contact::Integration integration(const ContactParameters& p) {
  using mixture_contact::Integration;
  if (!p.integration.rule.given) return Integration::segments;
  return p.integration.rule.value == 1 ? Integration::segments : Integration::gauss;
}

/// The largest default factor of the traction penalty for a solver.
///
/// Conjugate gradients: the usual choice in models with FEBio's interfaces. Dynamics: two halves of a bar of equal
/// elements (stiffness k, mass m), joined by a contact of `factor` k, have a mode at the contact with m w^2/k = 2 + r +
/// 1/r, where 1/r - r = 4 factor; the bar itself has 4. Explicit dynamics: a factor of 1/2 reduces the critical time
/// step by 9 percent, a factor of 1 by 21 percent. Implicit dynamics: with a factor of 3, the mode has twice the
/// largest frequency of the bar, and steps that resolve the elements resolve the contact. Augmentations make the
/// contact hard for any penalty.
double largest_traction_factor(SolverKind solver, mixture_contact::Enforcement enforcement) {
  const double any = std::numeric_limits<double>::infinity();
  switch (solver) {
    case SolverKind::conjugate_gradient:
      return 10;
    case SolverKind::explicit_dynamics:
      return 0.5;
    case SolverKind::implicit_dynamics:
      return enforcement == mixture_contact::Enforcement::penalty ? 3 : any;
    default:
      return any;
  }
}

/// The divisor of an automatic traction penalty with this factor: limited such that the penalty is at least the
/// stiffness of the bodies.
double borne_reduction(const ContactParameters& p, double factor, double reduction) {
  const bool is_automatic = !p.penalties.traction.given && p.enforcement.laugon != lagmult;
  return is_automatic ? std::min(reduction, std::max(1.0, factor)) : 1.0;
}

/// Adds complaints about parameters of other interfaces, or of former versions, that have no meaning here.
void complain_of_unknown(std::vector<std::string>& list, const ContactParameters& p) {
  if (p.unused.extrapolation.given) {
    list.emplace_back(
        "<extrapolation> is now called <predictor>, and it is off by default: write "
        "<predictor>1</predictor> to use it, and delete <extrapolation>.");
  }
}

void complain_of_devices(std::vector<std::string>& list, const ContactParameters& p) {
  for (const std::string& word : newton::named_devices(p.helpers.devices.value).unknown)
    list.push_back("<solver_devices> names \"" + word + "\"; allowed: " + newton::allowed_devices() + ".");
}

}  // namespace

std::vector<std::string> complaints(const ContactParameters& p) {
  std::vector<std::string> list;
  require_not_negative(list, "tolerance", p.tolerances.all.value);
  require_not_negative(list, "traction_tolerance", p.tolerances.traction.value);
  require_not_negative(list, "solvent_tolerance", p.tolerances.solvent.value);
  require_not_negative(list, "solute_tolerance", p.tolerances.solute.value);
  require_not_negative(list, "gaptol", p.tolerances.gaptol.value);
  require_not_negative(list, "ptol", p.tolerances.ptol.value);
  require_not_negative(list, "ctol", p.tolerances.ctol.value);
  require_not_negative(list, "search_tol", p.search.tolerance.value);
  require_not_negative(list, "penalty", p.penalties.traction.value);
  require_not_negative(list, "pressure_penalty", p.penalties.solvent.value);
  require_not_negative(list, "concentration_penalty", p.penalties.solute.value);
  require_not_negative(list, "search_radius", p.search.radius.value);
  if (p.integration.rule.value < 0 || p.integration.rule.value > 1)
    list.emplace_back("<integration> must be gauss or segments (0 or 1).");
  if (p.integration.order < 0 || p.integration.order > mixture_contact::max_quadrature_order) {
    list.emplace_back("<integration_order> is " + std::to_string(p.integration.order) + "; it must lie between 1 and " +
                      std::to_string(mixture_contact::max_quadrature_order) + ", or be 0 for the default.");
  }
  if (p.enforcement.laugon == lagmult && p.enforcement.two_pass) {
    list.emplace_back(
        "<two_pass> is set with <laugon>LAGMULT</laugon>: the surfaces can meet only half of the conditions on both of "
        "them. Delete <two_pass>, or use AUGLAG.");
  }
  if (p.enforcement.laugon == lagmult && p.self_contact) {
    list.emplace_back(
        "<laugon>LAGMULT</laugon> is set for surfaces that have facets in common: both sides of self-contact have "
        "conditions, and the sides can meet only half of these. Use PENALTY or AUGLAG.");
  }
  if (p.search.seg_up < 0)
    list.emplace_back("<seg_up> is negative; it must be a number of iterations, or 0 for no limit.");
  if (p.enforcement.minaug < 0) list.emplace_back("<minaug> is negative; it must be a number of augmentations.");
  if (p.enforcement.maxaug < p.enforcement.minaug) list.emplace_back("<maxaug> is less than <minaug>.");
  if (!std::isfinite(p.ambient.pressure)) list.emplace_back("<ambient_pressure> is not a finite number.");
  if (!std::isfinite(p.gap.offset.value)) list.emplace_back("<offset> is not a finite number.");
  require_not_negative(list, "fric_coeff", p.friction.fric_coeff.value);
  complain_of_friction(p, list);
  complain_of_devices(list, p);
  complain_of_unknown(list, p);
  return list;
}

std::vector<std::string> notices(const ContactParameters& p) {
  std::vector<std::string> list;
  const auto note_zero = [&](const Given<double>& parameter, const std::string& name, const std::string& meaning) {
    if (parameter.given && parameter.value == 0) list.push_back("<" + name + "> is 0: " + meaning);
  };
  const std::string instead = ". Delete this parameter for an automatic value.";
  note_zero(p.penalties.traction, "penalty", "the contact transmits no traction" + instead);
  note_zero(p.penalties.solvent, "pressure_penalty", "no solvent passes" + instead);
  note_zero(p.penalties.solute, "concentration_penalty", "no solute passes" + instead);
  note_zero(p.search.radius, "search_radius", "the contact computes it automatically.");
  if (p.unused.knmult.given) list.emplace_back("<knmult> has no effect: the linearisation is always complete.");
  if (p.unused.smooth_aug.given && p.unused.smooth_aug.value)
    list.emplace_back("<smooth_aug> has no effect: multipliers come from the nodal loads of the contact.");
  if (p.search.tolerance.given && integration(p) == mixture_contact::Integration::segments) {
    list.emplace_back("<search_tol> has no effect with segments, which end at the edges of facets.");
  }
  note_friction(p, list);
  return list;
}

std::string load_curve_complaint(const ParameterTag& tag) {
  if (tag.varies != nullptr) return "";
  return "<" + std::string(tag.name) +
         "> has a load curve, and this parameter cannot change during a run. Give a value without the attribute lc. Load curves "
         "may change penalties, tolerances, the offset, friction and ambient values.";
}

LeftOut left_out(const ContactParameters& p) {
  const auto is_zero = [](const Varying& penalty) { return penalty.given && penalty.value == 0 && !penalty.varies; };
  LeftOut out{is_zero(p.penalties.traction), "", is_zero(p.penalties.solute), {}};
  if (is_zero(p.penalties.solvent)) out.solvent = "pressure_penalty";
  if (is_zero(p.membrane.conductance)) out.solvent = "hydraulic_conductance";
  for (const auto& [solute, film] : membrane_rule(p.membrane).solutes) {
    if (film.permeance == 0 && film.reflection == 1) out.stopped_solutes.push_back(solute);
  }
  return out;
}

bool reads_properties_again(const ContactParameters& parameters, const mixture_contact::Effects& effects) {
  const bool follows_convection = !effects.solutes.empty() && !parameters.penalties.solute.given;
  return parameters.penalties.update_penalty || follows_convection;
}

mixture_contact::Settings core_settings(const ContactParameters& p, SolverKind solver,
                                        const mixture_contact::ReducedPenalty& reduction) {
  using namespace mixture_contact;
  Settings settings;
  settings.enforcement = enforcement(p.enforcement.laugon);
  const GapRule gap{p.gap.offset.value, p.gap.tension, !left_out(p).contact};
  const double factor = std::min(normal_condition(gap).penalty_factor(sees_both_ways(p)),
                                 largest_traction_factor(solver, settings.enforcement));
  const double flux_factor = sees_both_ways(p) ? two_pass_flux_factor : default_flux_factor;
  settings.traction = penalty_rule(p.penalties.traction, p.penalties.auto_penalty, factor);
  settings.traction.softens_fixed_gaps = !p.penalties.traction.given ||
                                         settings.enforcement == Enforcement::lagrange_multipliers;
  settings.reduced_traction = {borne_reduction(p, factor, reduction.divisor), reduction.kept};
  settings.solvent = penalty_rule(p.penalties.solvent, p.penalties.auto_penalty, flux_factor);
  settings.solute = penalty_rule(p.penalties.solute, p.penalties.auto_penalty, flux_factor);
  const auto relative = [&p](const Given<double>& own) { return own.given ? own.value : p.tolerances.all.value; };
  settings.tolerances.traction = {relative(p.tolerances.traction), p.tolerances.gaptol.value};
  settings.tolerances.solvent = {relative(p.tolerances.solvent), p.tolerances.ptol.value};
  settings.tolerances.solute = {relative(p.tolerances.solute), p.tolerances.ctol.value};
  settings.friction = friction_rule(p, factor);
  settings.membrane = membrane_rule(p.membrane);
  settings.tolerances.augmentations = {p.enforcement.minaug, p.enforcement.maxaug};
  settings.two_pass = p.enforcement.two_pass;
  settings.symmetric = p.enforcement.symmetric_stiffness;
  settings.integration = integration(p);
  settings.integration_order = p.integration.order;
  settings.gap = gap;
  settings.search = {p.search.radius.given ? p.search.radius.value : 0, p.search.tolerance.value};
  return settings;
}

bool is_reducible(const ContactParameters& p, SolverKind solver) {
  return core_settings(p, solver, {mixture_contact::PenaltyReduction::per_level}).reduced_traction.divisor > 1;
}
