/// The parameters of <contact type="sliding-mixture"> in a model file, and what they mean to the contact core. Shared
/// by the hosts.
#pragma once

#include "contact/base/settings.h"

#include <array>
#include <string>
#include <vector>

/// Values under FEBio's own names. A `_given` flag tells whether the model sets the parameter.
struct ContactParameters {
  std::string effects = "all";  ///< see decide_exchange()
  int laugon = 0;               ///< 0: PENALTY, 1: AUGLAG, 2: LAGMULT
  double tolerance = 2e-3;      ///< relative tolerance of every field [-]
  double traction_tolerance = 0;
  double solvent_tolerance = 0;
  double solute_tolerance = 0;
  bool traction_tolerance_given = false;
  bool solvent_tolerance_given = false;
  bool solute_tolerance_given = false;
  double gaptol = 0;  ///< [length]
  double ptol = 0;    ///< [pressure]
  double ctol = 0;    ///< [concentration]

  double penalty = 1;
  double pressure_penalty = 1;
  double concentration_penalty = 1;
  bool penalty_given = false;
  bool pressure_penalty_given = false;
  bool concentration_penalty_given = false;
  // Whether a load curve changes them.
  bool penalty_varies = false;
  bool pressure_penalty_varies = false;
  bool concentration_penalty_varies = false;
  bool self_contact = false;  ///< whether the surfaces have facets in common, as a host finds
  bool auto_penalty = false;
  bool update_penalty = false;

  bool two_pass = false;
  bool symmetric_stiffness = false;
  int integration = 0;  ///< 0: gauss, 1: segments
  bool integration_given = false;
  int integration_order = 0;
  double search_tol = 0.01;
  bool search_tol_given = false;
  double search_radius = 0;  ///< [length]
  bool search_radius_given = false;
  int seg_up = 0;
  bool node_reloc = false;
  int minaug = 0;
  int maxaug = 10;
  bool free_draining = true;  ///< whether open nodes have the ambient values
  double ambient_pressure = 0;

  double offset = 0;  ///< gap at which the surfaces are in contact without load [length]
  bool tension = false;
  bool flip_primary = false;
  bool flip_secondary = false;

  // Whether helpers of the solver (newton/helper.h) are on. They act on the whole model.
  bool predictor = false;
  bool predictor_given = false;
  bool non_negative_concentrations = true;
  bool non_negative_concentrations_given = false;
  bool line_search_guard = true;
  bool line_search_guard_given = false;

  double fric_coeff = 0;          ///< [-]
  double contact_frac = 0;        ///< [-]
  double tangential_penalty = 1;  ///< over the traction penalty [-]
  bool smooth_aug = false;
  bool smooth_fls = false;
  bool contact_frac_given = false;
  bool tangential_penalty_given = false;
  bool smooth_aug_given = false;
  bool smooth_fls_given = false;
  bool fric_coeff_varies = false;  ///< whether a load curve changes it

  // Parameters of FEBio's interfaces that this one has no use for, or not yet.
  bool shell_bottom_primary = false;
  bool shell_bottom_secondary = false;
  int knmult = 1;
  bool knmult_given = false;

  // The former name of predictor.
  bool extrapolation = false;
  bool extrapolation_given = false;
};

/// The switch of one of the solver's helpers.
struct HelperSwitch {
  const char* name;
  bool ContactParameters::* on;
  bool ContactParameters::* given;
};
inline constexpr HelperSwitch predictor{"predictor", &ContactParameters::predictor,
                                        &ContactParameters::predictor_given};
inline constexpr HelperSwitch non_negative_concentrations{"non_negative_concentrations",
                                                          &ContactParameters::non_negative_concentrations,
                                                          &ContactParameters::non_negative_concentrations_given};
inline constexpr HelperSwitch line_search_guard{"line_search_guard", &ContactParameters::line_search_guard,
                                                &ContactParameters::line_search_guard_given};
inline constexpr std::array<HelperSwitch, 3> helper_switches{predictor, non_negative_concentrations, line_search_guard};

/// What a parameter is measured in.
enum class Unit { none, length, pressure, concentration };

/// How a parameter stands in a model file.
struct ParameterTag {
  const char* name = "";
  const char* long_name = "";  ///< what a user reads in FEBio Studio
  bool* given = nullptr;       ///< to be set where the model has the tag
  Unit unit = Unit::none;
  const char* choices = nullptr;  ///< names of the values 0, 1, ..., each ended by a zero character
};

/// Calls take(tag, value) for each parameter, with the variable that holds its value; but not for ambient_pressure,
/// which hosts read with its load curve.
template <class Take>
void for_each_parameter(ContactParameters& p, const Take& take) {
  take({"effects", "effects exchanged"}, p.effects);
  take({"laugon", "enforcement method", nullptr, Unit::none, "PENALTY\0AUGLAG\0LAGMULT\0"}, p.laugon);
  take({"tolerance", "tolerance of all fields"}, p.tolerance);
  take({"traction_tolerance", "tolerance of the gap", &p.traction_tolerance_given}, p.traction_tolerance);
  take({"solvent_tolerance", "tolerance of the pressure jump", &p.solvent_tolerance_given}, p.solvent_tolerance);
  take({"solute_tolerance", "tolerance of the concentration jumps", &p.solute_tolerance_given}, p.solute_tolerance);
  take({"gaptol", "gap tolerance", nullptr, Unit::length}, p.gaptol);
  take({"ptol", "pressure jump tolerance", nullptr, Unit::pressure}, p.ptol);
  take({"ctol", "concentration jump tolerance", nullptr, Unit::concentration}, p.ctol);
  take({"penalty", "normal penalty", &p.penalty_given}, p.penalty);
  take({"pressure_penalty", "solvent penalty", &p.pressure_penalty_given}, p.pressure_penalty);
  take({"concentration_penalty", "solute penalty", &p.concentration_penalty_given}, p.concentration_penalty);
  take({"auto_penalty", "automatic penalty"}, p.auto_penalty);
  take({"update_penalty", "update penalty each step"}, p.update_penalty);
  take({"two_pass", "two passes"}, p.two_pass);
  take({"symmetric_stiffness", "symmetric stiffness"}, p.symmetric_stiffness);
  take({"integration", "integration rule", &p.integration_given, Unit::none, "gauss\0segments\0"}, p.integration);
  take({"integration_order", "integration order"}, p.integration_order);
  take({"search_tol", "projection tolerance", &p.search_tol_given}, p.search_tol);
  take({"search_radius", "search radius", &p.search_radius_given, Unit::length}, p.search_radius);
  take({"seg_up", "iterations with a new search"}, p.seg_up);
  take({"predictor", "predict the start of a step", &p.predictor_given}, p.predictor);
  take({"non_negative_concentrations", "non-negative concentrations", &p.non_negative_concentrations_given},
       p.non_negative_concentrations);
  take({"line_search_guard", "guard the line search", &p.line_search_guard_given}, p.line_search_guard);
  take({"node_reloc", "relocate primary nodes"}, p.node_reloc);
  take({"minaug", "minimum augmentations"}, p.minaug);
  take({"maxaug", "maximum augmentations"}, p.maxaug);
  take({"free_draining", "drain outside contact"}, p.free_draining);
  take({"flip_primary", "flip primary surface"}, p.flip_primary);
  take({"flip_secondary", "flip secondary surface"}, p.flip_secondary);
  take({"fric_coeff", "friction coefficient"}, p.fric_coeff);
  take({"contact_frac", "solid contact fraction", &p.contact_frac_given}, p.contact_frac);
  take({"tangential_penalty", "tangential penalty factor", &p.tangential_penalty_given}, p.tangential_penalty);
  take({"offset", "gap offset", nullptr, Unit::length}, p.offset);
  take({"tension", "allow tension"}, p.tension);
  take({"shell_bottom_primary", "shell bottom of primary surface"}, p.shell_bottom_primary);
  take({"shell_bottom_secondary", "shell bottom of secondary surface"}, p.shell_bottom_secondary);
  take({"knmult", "stiffness factor", &p.knmult_given}, p.knmult);
  take({"smooth_aug", "smoothed augmentation", &p.smooth_aug_given}, p.smooth_aug);
  take({"smooth_fls", "smoothed fluid load support", &p.smooth_fls_given}, p.smooth_fls);
  take({"extrapolation", "predictor (former name)", &p.extrapolation_given}, p.extrapolation);
}

/// What is wrong with the parameters, one sentence each that names the parameter and what is allowed; empty if nothing
/// is.
std::vector<std::string> complaints(const ContactParameters& parameters);

/// What a user should know of parameters that have no effect here, one sentence each.
std::vector<std::string> notices(const ContactParameters& parameters);

/// Whether the surfaces resist sliding; a load curve may bring friction later.
bool has_friction(const ContactParameters& parameters);

/// What penalties of 0 leave out of the contact; one that a load curve changes leaves out nothing.
struct LeftOut {
  bool contact = false;  ///< without a penalty of the traction surfaces never touch
  bool solvent = false;
  bool solutes = false;
};
LeftOut left_out(const ContactParameters& parameters);

/// Whether stiffness and conductance are read again at each time step: where asked for, and where the penalty of
/// solutes is not given, so that it follows the convection.
bool reads_properties_again(const ContactParameters& parameters);

/// How the host's solver finds equilibrium, which bounds the traction penalty that it can bear where none is given.
enum class SolverKind {
  newton,              ///< with the tangent: any
  conjugate_gradient,  ///< without: convergence takes the longer the stiffer the contact is
  explicit_dynamics    ///< the stiffer the contact, the shorter the critical time step
};

/// The core's settings. `reduction`: what an automatic penalty of the traction is divided by, but not below the
/// stiffness of the bodies; one that is given stays as it is.
mixture_contact::Settings core_settings(const ContactParameters& parameters, SolverKind solver = SolverKind::newton,
                                        double reduction = 1);
