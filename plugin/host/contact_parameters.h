/// The parameters of <contact type="sliding-mixture"> in a model file, and what they mean to the contact core. Shared
/// by the hosts.
#pragma once

#include "contact/settings.h"

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
  bool auto_penalty = false;
  bool update_penalty = false;

  bool two_pass = false;
  bool symmetric_stiffness = false;
  int integration = 0;  ///< 0: gauss, 1: segments
  int integration_order = 0;
  double search_tol = 0.01;
  double search_radius = 0;  ///< [length]
  bool search_radius_given = false;
  int seg_up = 0;
  bool extrapolation = false;
  bool node_reloc = false;
  int minaug = 0;
  int maxaug = 10;
  double ambient_pressure = 0;

  bool flip_primary = false;
  bool flip_secondary = false;

  // Parameters of FEBio's interfaces that this one has no use for, or not yet.
  double fric_coeff = 0;
  double contact_frac = 0;
  double offset = 0;
  bool tension = false;
  bool shell_bottom_primary = false;
  bool shell_bottom_secondary = false;
  int knmult = 1;
  bool smooth_aug = false;
  bool smooth_fls = false;
  bool contact_frac_given = false;
  bool knmult_given = false;
  bool smooth_aug_given = false;
  bool smooth_fls_given = false;
};

/// What is wrong with the parameters, one sentence each that names the parameter and what is allowed; empty if nothing
/// is.
std::vector<std::string> complaints(const ContactParameters& parameters);

/// What a user should know of parameters that have no effect here, one sentence each.
std::vector<std::string> notices(const ContactParameters& parameters);

/// Whether stiffness and conductance are read again at each time step: where asked for, and where the penalty of
/// solutes is not given, so that it follows the convection.
bool reads_properties_again(const ContactParameters& parameters);

/// The core's settings.
mixture_contact::Settings core_settings(const ContactParameters& parameters);
