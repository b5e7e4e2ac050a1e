/// The parameters of <contact type="sliding-mixture"> in a model file, and the settings of the contact core that follow
/// from them. All hosts use them.
#pragma once

#include "contact/base/effects.h"
#include "contact/base/indexed_vector.h"
#include "contact/base/settings.h"
#include "contact/base/side.h"
#include "solute_values.h"
#include "solver/devices.h"

#include <array>
#include <string>
#include <vector>

/// A parameter's value, and whether the model sets it.
template <class T>
struct Given {
  T value{};
  bool given = false;
};

/// A value that may follow a load curve.
struct Varying : Given<double> {
  bool varies = false;
};

/// The value of <laugon> for unknown multipliers.
inline constexpr int lagmult = 2;

/// Parameters of the enforcement.
struct EnforcementParameters {
  int laugon = 0;  ///< 0: PENALTY, 1: AUGLAG, 2: LAGMULT
  int minaug = 0;
  int maxaug = 10;
  bool two_pass = false;
  bool symmetric_stiffness = false;
};

/// Parameters of the convergence of augmentations. An absolute tolerance is 0 if it is not used.
struct ToleranceParameters {
  Varying all{{2e-3}};  ///< <tolerance>: relative tolerance of all fields without a tolerance of their own [-]
  Varying traction;     ///< <traction_tolerance>: relative tolerance of the traction [-]
  Varying solvent;      ///< <solvent_tolerance>: relative tolerance of the solvent [-]
  Varying solute;       ///< <solute_tolerance>: relative tolerance of solutes [-]
  Varying gaptol;       ///< largest gap [length]
  Varying ptol;         ///< largest jump of the pressure [pressure]
  Varying ctol;         ///< largest jump of a concentration [concentration]
};

/// Penalties: factors on the automatic penalties, or values without auto_penalty.
struct PenaltyParameters {
  Varying traction{{1}};  ///< <penalty>: penalty of the traction
  Varying solvent{{1}};   ///< <pressure_penalty>: penalty of the solvent flux
  Varying solute{{1}};    ///< <concentration_penalty>: penalty of solute fluxes
  bool auto_penalty = false;
  bool update_penalty = false;
};

/// Parameters of the integration over the primary surface.
struct IntegrationParameters {
  Given<int> rule;  ///< <integration>: 0 for gauss, 1 for segments
  int order = 0;    ///< <integration_order>: order of the quadrature rule; 0: default
};

/// Parameters of the search for facing facets.
struct SearchParameters {
  Given<double> tolerance{0.01};  ///< <search_tol>: see SearchRule::tolerance [-]
  Given<double> radius;           ///< <search_radius>: see SearchRule::radius [length]
  int seg_up = 0;                 ///< <seg_up>: number of iterations of a step with a new search; 0: all
};

/// Changes of a surface before the first step.
struct SurfaceParameters {
  bool flip = false;
  bool shell_bottom = false;
};

/// Parameters of the gap.
struct GapParameters {
  Varying offset;  ///< gap at which the surfaces are in contact without load [length]
  bool tension = false;
  bool node_reloc = false;
};

/// Parameters of the nodes out of contact.
struct AmbientParameters {
  bool free_draining = true;  ///< true: open nodes have the ambient values
  double pressure = 0;        ///< <ambient_pressure> [pressure]
};

/// Parameters of friction.
struct FrictionParameters {
  Varying fric_coeff;               ///< coefficient of friction [-]
  Varying contact_frac;             ///< fraction of the contact area where solid touches solid [-]
  Varying tangential_penalty{{1}};  ///< tangential penalty divided by the traction penalty [-]
};

/// A membrane between the surfaces. Fields without a coefficient cross freely.
struct MembraneParameters {
  Varying conductance;                  ///< <hydraulic_conductance>: hydraulic conductance L_p [length^3/(force time)]
  std::vector<SoluteValue> permeance;   ///< <solute_permeance>: permeance P_k of each solute [length/time]
  std::vector<SoluteValue> reflection;  ///< <reflection>: reflection coefficient sigma_k of each solute [-]
  double thermal_energy = 0;            ///< thermal energy R T of the model [pressure/concentration]
};

/// Switches of the devices of the solver (solver/helper.h), which act on the whole model.
struct HelperParameters {
  Given<bool> predictor;
  Given<bool> non_negative_concentrations{true};
  Given<bool> line_search_guard{true};
  Given<std::string> devices{"all"};  ///< <solver_devices>: names of the devices, see newton::named_devices()
};

/// Parameters of FEBio's interfaces that have no effect here, and `extrapolation`, the former name of `predictor`.
struct UnusedParameters {
  Given<int> knmult{1};
  Given<bool> smooth_aug;
  Given<bool> smooth_fls;
  Given<bool> extrapolation;
};

/// All parameters of a contact, under FEBio's names where FEBio has them.
struct ContactParameters {
  std::string effects = "all";  ///< exchanged effects, see decide_exchange()
  EnforcementParameters enforcement;
  ToleranceParameters tolerances;
  PenaltyParameters penalties;
  IntegrationParameters integration;
  SearchParameters search;
  mixture_contact::PerSide<SurfaceParameters> surfaces;
  GapParameters gap;
  AmbientParameters ambient;
  FrictionParameters friction;
  MembraneParameters membrane;
  HelperParameters helpers;
  UnusedParameters unused;
  bool self_contact = false;  ///< true if the surfaces have facets in common, set by the host
};

/// A parameter that switches one device of the solver, in addition to <solver_devices>.
struct HelperSwitch {
  newton::Device device;
  Given<bool> HelperParameters::* parameter;

  /// The parameter of a contact.
  const Given<bool>& of(const ContactParameters& parameters) const { return parameters.helpers.*parameter; }
};
inline constexpr HelperSwitch predictor{newton::Device::predictor, &HelperParameters::predictor};
inline constexpr HelperSwitch non_negative_concentrations{newton::Device::non_negative_concentrations,
                                                          &HelperParameters::non_negative_concentrations};
inline constexpr HelperSwitch line_search_guard{newton::Device::line_search_guard,
                                                &HelperParameters::line_search_guard};
inline constexpr std::array<HelperSwitch, 3> helper_switches{non_negative_concentrations, line_search_guard, predictor};

/// The unit of a parameter in FEBio Studio.
enum class Unit { none, length, time, pressure, concentration, energy_per_area };

/// The subject of a parameter, in the order of the documentation.
enum class ParameterGroup {
  effects,
  enforcement,
  ambient,
  surfaces,
  solution,
  friction,
  membrane,
  breaking,
  old_models
};

/// The heading of a group in FEBio Studio and in the documentation; null if FEBio Studio does not show the group.
constexpr const char* heading(ParameterGroup group) {
  switch (group) {
    case ParameterGroup::effects:
      return "Effects";
    case ParameterGroup::enforcement:
      return "Enforcement";
    case ParameterGroup::ambient:
      return "Ambient values";
    case ParameterGroup::surfaces:
      return "Surfaces and integration";
    case ParameterGroup::solution:
      return "Solution";
    case ParameterGroup::friction:
      return "Friction";
    case ParameterGroup::membrane:
      return "Membrane";
    case ParameterGroup::breaking:
      return "Breaking";
    case ParameterGroup::old_models:
      return nullptr;
  }
  return nullptr;
}

/// A parameter as FEBio's parameter lists and the documentation describe it.
struct ParameterTag {
  const char* name = "";
  const char* long_name = "";  ///< display name in FEBio Studio
  ParameterGroup group = ParameterGroup::old_models;
  Unit unit = Unit::none;
  const char* choices = nullptr;  ///< names of the values 0, 1, ..., each terminated by a zero character
  bool* given = nullptr;          ///< set to true if the model contains the parameter; null if not needed
  bool* varies = nullptr;  ///< set to true if a load curve changes the value; null if load curves are not allowed
};

/// Parameters that each host reads in its own way.
namespace hosts_own {
inline constexpr ParameterTag ambient_pressure{"ambient_pressure", "ambient pressure", ParameterGroup::ambient,
                                               Unit::pressure};
inline constexpr ParameterTag ambient_concentration{"ambient_concentration", "ambient concentration",
                                                    ParameterGroup::ambient, Unit::concentration};
inline constexpr ParameterTag solute_permeance{"solute_permeance", "membrane permeance", ParameterGroup::membrane};
inline constexpr ParameterTag reflection{"reflection", "membrane reflection coefficient", ParameterGroup::membrane};
/// Parameters with one value per solute.
inline constexpr std::array<ParameterTag, 3> values_per_solute{ambient_concentration, solute_permeance, reflection};
}  // namespace hosts_own

/// Calls take(tag, value) for a parameter that records whether the model sets it.
template <class Take>
struct TakeGiven {
  const Take& take;

  template <class Value>
  void operator()(ParameterTag tag, Given<Value>& parameter) const {
    tag.given = &parameter.given;
    take(tag, parameter.value);
  }
  void operator()(ParameterTag tag, Varying& parameter) const {
    tag.given = &parameter.given;
    tag.varies = &parameter.varies;
    take(tag, parameter.value);
  }
};

/// Calls take(tag, value) for each parameter of the enforcement.
template <class Take>
void for_each_enforcement_parameter(ContactParameters& p, const Take& take) {
  using Group = ParameterGroup;
  const TakeGiven<Take> take_given{take};
  take({"laugon", "enforcement method", Group::enforcement, Unit::none, "PENALTY\0AUGLAG\0LAGMULT\0"},
       p.enforcement.laugon);
  take_given({"penalty", "normal penalty", Group::enforcement}, p.penalties.traction);
  take_given({"pressure_penalty", "solvent penalty", Group::enforcement}, p.penalties.solvent);
  take_given({"concentration_penalty", "solute penalty", Group::enforcement}, p.penalties.solute);
  take({"auto_penalty", "automatic penalty", Group::enforcement}, p.penalties.auto_penalty);
  take({"update_penalty", "update penalty each step", Group::enforcement}, p.penalties.update_penalty);
  take_given({"tolerance", "tolerance of all fields", Group::enforcement}, p.tolerances.all);
  take_given({"traction_tolerance", "tolerance of the gap", Group::enforcement}, p.tolerances.traction);
  take_given({"solvent_tolerance", "tolerance of the pressure jump", Group::enforcement}, p.tolerances.solvent);
  take_given({"solute_tolerance", "tolerance of the concentration jumps", Group::enforcement}, p.tolerances.solute);
  take_given({"gaptol", "gap tolerance", Group::enforcement, Unit::length}, p.tolerances.gaptol);
  take_given({"ptol", "pressure jump tolerance", Group::enforcement, Unit::pressure}, p.tolerances.ptol);
  take_given({"ctol", "concentration jump tolerance", Group::enforcement, Unit::concentration}, p.tolerances.ctol);
  take({"minaug", "minimum augmentations", Group::enforcement}, p.enforcement.minaug);
  take({"maxaug", "maximum augmentations", Group::enforcement}, p.enforcement.maxaug);
}

template <class Take>
/// Calls take(tag, value) for each parameter of surfaces, integration and search.
void for_each_surface_parameter(ContactParameters& p, const Take& take) {
  using Group = ParameterGroup;
  using mixture_contact::Side;
  const TakeGiven<Take> take_given{take};
  take({"two_pass", "two passes", Group::surfaces}, p.enforcement.two_pass);
  take_given({"integration", "integration rule", Group::surfaces, Unit::none, "gauss\0segments\0"}, p.integration.rule);
  take({"integration_order", "integration order", Group::surfaces}, p.integration.order);
  take_given({"search_radius", "search radius", Group::surfaces, Unit::length}, p.search.radius);
  take_given({"offset", "gap offset", Group::surfaces, Unit::length}, p.gap.offset);
  take({"tension", "allow tension", Group::surfaces}, p.gap.tension);
  take_given({"search_tol", "projection tolerance", Group::surfaces}, p.search.tolerance);
  take({"seg_up", "iterations with a new search", Group::surfaces}, p.search.seg_up);
  take({"node_reloc", "relocate primary nodes", Group::surfaces}, p.gap.node_reloc);
  take({"flip_primary", "flip primary surface", Group::surfaces}, p.surfaces[Side::primary].flip);
  take({"flip_secondary", "flip secondary surface", Group::surfaces}, p.surfaces[Side::secondary].flip);
  take({"shell_bottom_primary", "shell bottom of primary surface", Group::surfaces},
       p.surfaces[Side::primary].shell_bottom);
  take({"shell_bottom_secondary", "shell bottom of secondary surface", Group::surfaces},
       p.surfaces[Side::secondary].shell_bottom);
}

template <class Take>
/// Calls take(tag, value) for each parameter of the solution.
void for_each_solution_parameter(ContactParameters& p, const Take& take) {
  using Group = ParameterGroup;
  const TakeGiven<Take> take_given{take};
  take({"symmetric_stiffness", "symmetric stiffness", Group::solution}, p.enforcement.symmetric_stiffness);
  take_given({"predictor", "predict the start of a step", Group::solution}, p.helpers.predictor);
  take_given({"non_negative_concentrations", "non-negative concentrations", Group::solution},
             p.helpers.non_negative_concentrations);
  take_given({"line_search_guard", "guard the line search", Group::solution}, p.helpers.line_search_guard);
  take_given({"solver_devices", "devices of the solver", Group::solution}, p.helpers.devices);
}

template <class Take>
/// Calls take(tag, value) for each parameter of friction.
void for_each_friction_parameter(ContactParameters& p, const Take& take) {
  using Group = ParameterGroup;
  const TakeGiven<Take> take_given{take};
  take_given({"fric_coeff", "friction coefficient", Group::friction}, p.friction.fric_coeff);
  take_given({"contact_frac", "solid contact fraction", Group::friction}, p.friction.contact_frac);
  take_given({"tangential_penalty", "tangential penalty factor", Group::friction}, p.friction.tangential_penalty);
}

template <class Take>
/// Calls take(tag, value) for the parameters of a membrane that are not in hosts_own.
void for_each_membrane_parameter(ContactParameters& p, const Take& take) {
  using Group = ParameterGroup;
  const TakeGiven<Take> take_given{take};
  take_given({"hydraulic_conductance", "hydraulic conductance", Group::membrane}, p.membrane.conductance);
}

template <class Take>
/// Calls take(tag, value) for each parameter without effect.
void for_each_unused_parameter(ContactParameters& p, const Take& take) {
  using Group = ParameterGroup;
  const TakeGiven<Take> take_given{take};
  take_given({"knmult", "stiffness factor", Group::old_models}, p.unused.knmult);
  take_given({"smooth_aug", "smoothed augmentation", Group::old_models}, p.unused.smooth_aug);
  take_given({"smooth_fls", "smoothed fluid load support", Group::old_models}, p.unused.smooth_fls);
  take_given({"extrapolation", "predictor (former name)", Group::old_models}, p.unused.extrapolation);
}

/// Calls take(tag, value) for each parameter, with the variable of its value. Parameters in hosts_own are not included.
template <class Take>
void for_each_parameter(ContactParameters& p, const Take& take) {
  using Group = ParameterGroup;
  take({"effects", "effects exchanged", Group::effects}, p.effects);
  for_each_enforcement_parameter(p, take);
  take({"free_draining", "drain outside contact", Group::ambient}, p.ambient.free_draining);
  for_each_surface_parameter(p, take);
  for_each_solution_parameter(p, take);
  for_each_friction_parameter(p, take);
  for_each_membrane_parameter(p, take);
  for_each_unused_parameter(p, take);
}

/// The faults of the parameters, one sentence each with the name of the parameter and its allowed values; empty if
/// there are none.
std::vector<std::string> complaints(const ContactParameters& parameters);

/// The complaint about a load curve on a parameter that must be constant in a run; empty if it may vary.
std::string load_curve_complaint(const ParameterTag& tag);

/// Notices for the user about parameters without effect, one sentence each.
std::vector<std::string> notices(const ContactParameters& parameters);

/// The effects that penalties of 0 and membrane coefficients of 0 remove. A coefficient with a load curve removes no
/// effect.
struct LeftOut {
  bool contact = false;  ///< true: the surfaces never touch, because the traction has no penalty
  std::string solvent;   ///< name of the parameter that removes the solvent flux; empty if there is none
  bool solutes = false;
  std::vector<int> stopped_solutes;  ///< solutes that a membrane with permeance 0 and reflection 1 stops
};
/// The effects that the parameters remove.
LeftOut left_out(const ContactParameters& parameters);

/// True if stiffness and conductance have to be read again at each time step: on request, and with automatic penalties
/// of exchanged solutes, which depend on convection.
bool reads_properties_again(const ContactParameters& parameters, const mixture_contact::Effects& effects);

/// The solution method of the host, which limits the default traction penalty.
enum class SolverKind {
  newton,              ///< with the tangent; any penalty is possible
  implicit_dynamics,   ///< with the tangent, in steps that resolve waves; contact much stiffer than the elements adds
                       ///< energy
  conjugate_gradient,  ///< without the tangent; stiff contact converges slowly
  explicit_dynamics    ///< stiff contact reduces the critical time step
};

/// The settings of the contact core. `reduction`: reduced penalties after a failed step. An automatic traction penalty
/// is divided by the divisor, but remains at least the stiffness of the bodies; a penalty that the model sets is not
/// changed.
mixture_contact::Settings core_settings(const ContactParameters& parameters, SolverKind solver = SolverKind::newton,
                                        const mixture_contact::ReducedPenalty& reduction = {});
/// True if reduced penalties have an effect for these parameters.
bool is_reducible(const ContactParameters& parameters, SolverKind solver);
