#include "contact_parameters.h"

#include "contact/geometry/quadrature.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

using mixture_contact::PenaltyRule;

/// A penalty that is not given is automatic and accurate; one that is given is a value, or with auto_penalty a factor.
PenaltyRule penalty_rule(bool given, double value, bool auto_penalty, double default_factor) {
  return given ? PenaltyRule{auto_penalty, value} : PenaltyRule{true, default_factor};
}

void require_not_negative(std::vector<std::string>& list, const char* name, double value) {
  if (std::isfinite(value) && value >= 0) return;
  list.emplace_back("<" + std::string(name) + "> is " + std::to_string(value) +
                    "; it must be a number that is not negative.");
}

constexpr int lagmult = 2;

mixture_contact::Enforcement enforcement(int laugon) {
  using mixture_contact::Enforcement;
  if (laugon == lagmult) return Enforcement::lagrange_multipliers;
  return laugon == 1 ? Enforcement::augmented_lagrangian : Enforcement::penalty;
}

/// Whether each of two surfaces that face each other has conditions of its own.
bool sees_both_ways(const ContactParameters& p) { return p.two_pass || p.self_contact; }

mixture_contact::Integration integration(const ContactParameters& p) {
  using mixture_contact::Integration;
  if (!p.integration_given) return sees_both_ways(p) ? Integration::gauss : Integration::segments;
  return p.integration == 1 ? Integration::segments : Integration::gauss;
}

/// The default traction factor that a solver without a tangent bears.
///
/// Conjugate gradients: what users of FEBio's interfaces choose. Explicit: two halves of a bar of equal elements
/// (stiffness k, mass m) joined by a contact of stiffness factor k have a mode at the contact with m w^2/k = 2 + r +
/// 1/r, where 1/r - r = 4 factor; the bar itself has 4. At 1/2 that shortens the critical time step by 9 percent, at 1
/// by 21.
double largest_traction_factor(SolverKind solver) {
  if (solver == SolverKind::newton) return std::numeric_limits<double>::infinity();
  return solver == SolverKind::conjugate_gradient ? 10 : 0.5;
}

/// What of a reduction an automatic traction factor bears: down to 1, the stiffness of the bodies.
double borne_reduction(const ContactParameters& p, double factor, double reduction) {
  const bool is_automatic = !p.penalty_given && p.laugon != lagmult;
  return is_automatic ? std::min(reduction, std::max(1.0, factor)) : 1.0;
}

/// Parameters of other interfaces, and of former versions, that mean nothing here.
void complain_of_unknown(std::vector<std::string>& list, const ContactParameters& p) {
  if (p.extrapolation_given) {
    list.emplace_back(
        "<extrapolation> is now called <predictor>, and it is off unless it is asked for: write "
        "<predictor>1</predictor> to have it, and leave <extrapolation> out.");
  }
}

void complain_of_friction(std::vector<std::string>& list, const ContactParameters& p) {
  require_not_negative(list, "fric_coeff", p.fric_coeff);
  const bool is_part = p.contact_frac >= 0 && p.contact_frac <= 1;
  if (!is_part) {
    list.emplace_back("<contact_frac> is " + std::to_string(p.contact_frac) + "; it must lie between 0 and 1.");
  }
  const bool is_positive = std::isfinite(p.tangential_penalty) && p.tangential_penalty > 0;
  if (!is_positive) {
    list.emplace_back(
        "<tangential_penalty> is " + std::to_string(p.tangential_penalty) +
        "; it must be a positive number, the factor of the tangential penalty over that of the traction.");
  }
  if (p.laugon == lagmult && has_friction(p)) {
    list.emplace_back(
        "<fric_coeff> is set with <laugon>LAGMULT</laugon>: multipliers that are unknowns hold the normal direction alone. "
        "Use AUGLAG, which makes stick as exact as its tolerance, or PENALTY.");
  }
}

void note_friction(std::vector<std::string>& list, const ContactParameters& p) {
  if (!has_friction(p)) {
    const auto note = [&](bool given, const std::string& name) {
      if (given) list.push_back("<" + name + "> has no effect: <fric_coeff> is 0.");
    };
    note(p.contact_frac_given, "contact_frac");
    note(p.tangential_penalty_given, "tangential_penalty");
    note(p.smooth_fls_given && p.smooth_fls, "smooth_fls");
    return;
  }
  if (p.smooth_fls_given && p.smooth_fls)
    list.emplace_back("<smooth_fls> has no effect: the load that the fluid bears is averaged around nodes as it is.");
  if (p.symmetric_stiffness) {
    list.emplace_back(
        "<symmetric_stiffness> is 1, and the tangent of friction is not symmetric: its symmetric part is used, and "
        "convergence is slower.");
  }
}

}  // namespace

std::vector<std::string> complaints(const ContactParameters& p) {
  std::vector<std::string> list;
  require_not_negative(list, "tolerance", p.tolerance);
  require_not_negative(list, "traction_tolerance", p.traction_tolerance);
  require_not_negative(list, "solvent_tolerance", p.solvent_tolerance);
  require_not_negative(list, "solute_tolerance", p.solute_tolerance);
  require_not_negative(list, "gaptol", p.gaptol);
  require_not_negative(list, "ptol", p.ptol);
  require_not_negative(list, "ctol", p.ctol);
  require_not_negative(list, "search_tol", p.search_tol);
  require_not_negative(list, "penalty", p.penalty);
  require_not_negative(list, "pressure_penalty", p.pressure_penalty);
  require_not_negative(list, "concentration_penalty", p.concentration_penalty);
  require_not_negative(list, "search_radius", p.search_radius);
  if (p.integration < 0 || p.integration > 1) list.emplace_back("<integration> must be gauss or segments (0 or 1).");
  if (p.integration_order < 0 || p.integration_order > mixture_contact::max_quadrature_order) {
    list.emplace_back("<integration_order> is " + std::to_string(p.integration_order) + "; it must lie between 1 and " +
                      std::to_string(mixture_contact::max_quadrature_order) + ", or be 0 for the default.");
  }
  if (p.laugon == lagmult && p.two_pass) {
    list.emplace_back(
        "<two_pass> is set with <laugon>LAGMULT</laugon>: conditions on both surfaces would be twice as many as can be "
        "met. Leave <two_pass> out, or use AUGLAG.");
  }
  if (p.laugon == lagmult && p.self_contact) {
    list.emplace_back(
        "<laugon>LAGMULT</laugon> is set for surfaces that have facets in common: where a body meets itself there would be "
        "conditions on both sides, twice as many as can be met. Use PENALTY or AUGLAG.");
  }
  if (p.seg_up < 0) list.emplace_back("<seg_up> is negative; it must be a number of iterations, or 0 for no limit.");
  if (p.minaug < 0) list.emplace_back("<minaug> is negative; it must be a number of augmentations.");
  if (p.maxaug < p.minaug) list.emplace_back("<maxaug> is less than <minaug>.");
  if (!std::isfinite(p.ambient_pressure)) list.emplace_back("<ambient_pressure> is not a finite number.");
  if (!std::isfinite(p.offset)) list.emplace_back("<offset> is not a finite number.");
  complain_of_friction(list, p);
  complain_of_unknown(list, p);
  return list;
}

std::vector<std::string> notices(const ContactParameters& p) {
  std::vector<std::string> list;
  const auto note_zero = [&](bool given, double value, const std::string& name, const std::string& meaning) {
    if (given && value == 0) list.push_back("<" + name + "> is 0: " + meaning);
  };
  const std::string instead = " while it is. Leave it out to have it chosen automatically.";
  note_zero(p.penalty_given, p.penalty, "penalty", "no traction is transmitted" + instead);
  note_zero(p.pressure_penalty_given, p.pressure_penalty, "pressure_penalty", "no solvent passes" + instead);
  note_zero(p.concentration_penalty_given, p.concentration_penalty, "concentration_penalty",
            "no solute passes" + instead);
  note_zero(p.search_radius_given, p.search_radius, "search_radius", "it is chosen automatically.");
  if (p.knmult_given) list.emplace_back("<knmult> has no effect: the linearisation is always complete.");
  if (p.smooth_aug_given && p.smooth_aug)
    list.emplace_back("<smooth_aug> has no effect: multipliers take the contact's own loads.");
  if (p.search_tol_given && integration(p) == mixture_contact::Integration::segments) {
    list.emplace_back("<search_tol> has no effect with segments: they end where facets end.");
  }
  note_friction(list, p);
  return list;
}

bool has_friction(const ContactParameters& p) { return p.fric_coeff != 0 || p.fric_coeff_varies; }

LeftOut left_out(const ContactParameters& p) {
  const auto is_zero = [](bool given, double value, bool varies) { return given && value == 0 && !varies; };
  return {is_zero(p.penalty_given, p.penalty, p.penalty_varies),
          is_zero(p.pressure_penalty_given, p.pressure_penalty, p.pressure_penalty_varies),
          is_zero(p.concentration_penalty_given, p.concentration_penalty, p.concentration_penalty_varies)};
}

bool reads_properties_again(const ContactParameters& parameters) {
  return parameters.update_penalty || !parameters.concentration_penalty_given;
}

mixture_contact::Settings core_settings(const ContactParameters& p, SolverKind solver, double reduction) {
  using namespace mixture_contact;
  Settings settings;
  settings.enforcement = enforcement(p.laugon);
  const double factor = std::min(traction_factor(sees_both_ways(p), p.tension), largest_traction_factor(solver));
  const double flux_factor = sees_both_ways(p) ? two_pass_flux_factor : default_flux_factor;
  settings.traction = penalty_rule(p.penalty_given, p.penalty, p.auto_penalty, factor);
  settings.traction_reduction = borne_reduction(p, factor, reduction);
  settings.solvent = penalty_rule(p.pressure_penalty_given, p.pressure_penalty, p.auto_penalty, flux_factor);
  settings.solute = penalty_rule(p.concentration_penalty_given, p.concentration_penalty, p.auto_penalty, flux_factor);
  settings.tolerances.traction = {p.traction_tolerance_given ? p.traction_tolerance : p.tolerance, p.gaptol};
  settings.tolerances.solvent = {p.solvent_tolerance_given ? p.solvent_tolerance : p.tolerance, p.ptol};
  settings.tolerances.solute = {p.solute_tolerance_given ? p.solute_tolerance : p.tolerance, p.ctol};
  settings.friction = {p.fric_coeff, p.contact_frac, p.ambient_pressure, p.tangential_penalty};
  settings.min_augmentations = p.minaug;
  settings.max_augmentations = p.maxaug;
  settings.two_pass = p.two_pass;
  settings.symmetric = p.symmetric_stiffness;
  settings.integration = integration(p);
  settings.integration_order = p.integration_order;
  settings.tension = p.tension;
  settings.offset = p.offset;
  settings.may_touch = !left_out(p).contact;
  settings.search_radius = p.search_radius_given ? p.search_radius : 0;
  settings.search_tolerance = p.search_tol;
  return settings;
}
