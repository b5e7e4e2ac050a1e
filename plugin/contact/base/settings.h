/// The settings of a contact that a user may choose.
#pragma once

#include <algorithm>
#include <map>
#include <optional>

namespace mixture_contact {

/// Methods that enforce the interface conditions.
enum class Enforcement {
  penalty,  ///< multipliers stay zero, except where penalties are reduced; gaps and jumps are load / penalty
  /// After a converged solution, its loads become the multipliers, until gaps and jumps meet the tolerances.
  augmented_lagrangian,
  lagrange_multipliers  ///< multipliers are unknowns of the same Newton solve, with equations of their own
};

/// The integration points on the primary surface.
enum class Integration {
  gauss,    ///< Gauss points of the primary facets: fast, but not exact where edges of both surfaces do not coincide
  segments  ///< points on the overlaps of the facets of both surfaces: exact for all facets
};

/// The penalty of one kind of field.
struct PenaltyRule {
  /// True: `value` is a factor on the local stiffness or conductance; false: `value` is the penalty.
  bool automatic = true;
  double value = 1.0;
  /// Time step in which elements store the field [s], on which the automatic penalty depends; 0: without storage.
  double time_step = 0;
  /// True: the traction penalty of nodes whose gap no solution can change is at most the stiffness of the
  /// elements, also if multipliers are unknowns, and augmentations leave these nodes out.
  bool softens_fixed_gaps = false;

  friend bool operator==(const PenaltyRule& a, const PenaltyRule& b) {
    return a.automatic == b.automatic && a.value == b.value && a.time_step == b.time_step &&
           a.softens_fixed_gaps == b.softens_fixed_gaps;
  }
};

/// The reduced traction penalty in an attempt after a failed one.
struct ReducedPenalty {
  double divisor = 1;  ///< divisor of the penalties [-]
  double kept = 1;  ///< fraction of the accepted loads, in excess of those of the gaps, with which the step begins [-]
};

/// Coefficients of a membrane for one solute.
struct SoluteFilm {
  double permeance = 0;  ///< permeance P_k [mm/s]
  /// Reflection coefficient sigma_k: fraction of the solute that the membrane retains in convection, 0 to 1 [-].
  double reflection = 1;

  friend bool operator==(const SoluteFilm& a, const SoluteFilm& b) {
    return a.permeance == b.permeance && a.reflection == b.reflection;
  }
};

/// A membrane between the surfaces that resists fluxes (conditions/membrane.h). Fields without coefficients are
/// continuous.
struct MembraneRule {
  std::optional<double> conductance;  ///< hydraulic conductance L_p [mm^3/(N s)]
  std::map<int, SoluteFilm> solutes;  ///< coefficients by the host's solute ids
  double thermal_energy = 0;          ///< thermal energy R T [MPa/mM]

  friend bool operator==(const MembraneRule& a, const MembraneRule& b) {
    return a.conductance == b.conductance && a.solutes == b.solutes && a.thermal_energy == b.thermal_energy;
  }
};

/// Friction: |t_T| <= mu <|t_n| - (1 - phi) (p - p*)>.
struct FrictionRule {
  double coefficient = 0;       ///< coefficient of friction mu [-]
  double contact_fraction = 0;  ///< fraction phi of the area where solid touches solid, from 0 to 1 [-]
  double ambient_pressure = 0;  ///< ambient pressure p* [MPa]
  double penalty_factor = 0.1;  ///< tangential penalty divided by the traction penalty [-]; see friction_factor()

  friend bool operator==(const FrictionRule& a, const FrictionRule& b) {
    return a.coefficient == b.coefficient && a.contact_fraction == b.contact_fraction &&
           a.ambient_pressure == b.ambient_pressure && a.penalty_factor == b.penalty_factor;
  }
};

/// Default factors of automatic penalties on the local stiffness and conductance. A gap or jump is about 1/factor of
/// the drop across the adjoining elements. Fluxes are linear in the jump, so only rounding limits their factor. The
/// traction has a kink that a large factor makes sharper.
inline constexpr double default_traction_factor = 1e3;
inline constexpr double default_flux_factor = 1e5;
/// Default factors for contacts with two passes, which impose twice as many conditions as the surfaces can meet. On
/// closing curved surfaces, a stiffer penalty would make the nodes of both surfaces open and close alternately, or lock
/// the fields.
inline constexpr double two_pass_traction_factor = 1e2;
inline constexpr double two_pass_flux_factor = 1e3;
/// Default factor on the stiffness for surfaces that bear tension, where the first iteration pulls all surfaces within
/// the search radius together.
inline constexpr double tension_traction_factor = 3e2;

/// Default factor of the tangential penalty on the stiffness: elastic slip is 1/factor of the shear of the adjoining
/// elements. A larger factor makes the kinks at the friction bound sharper, and the active set needs more iterations to
/// find the sticking nodes.
inline constexpr double default_friction_factor = 1e2;

/// The default of FrictionRule::penalty_factor for a traction penalty of `factor` times the stiffness: at most 1.
inline double friction_factor(double factor) { return std::min(1.0, default_friction_factor / factor); }

/// Limits of the number of augmentations of an augmented Lagrangian solution.
struct Augmentations {
  int least = 0;
  int most = 10;
};

/// Convergence criteria of an augmented Lagrangian solution. 0 disables a criterion.
struct Tolerances {
  /// Criteria of one kind of field.
  struct Field {
    /// Rms gap or jump relative to the drop across the adjoining elements [-]; larger than 1/default_traction_factor.
    double relative = 2e-3;
    double largest = 0;  ///< largest |g| [mm], |p1 - p2| [MPa] or |c1 - c2| [mM] in contact
  };
  Field traction;
  Field solvent;
  Field solute;
  Augmentations augmentations;
};

/// The gaps at which the surfaces exert a traction on each other.
struct GapRule {
  double offset = 0;      ///< gap at which the surfaces touch without load [mm]
  bool tension = false;   ///< true: paired surfaces also bear tension and never open
  bool may_touch = true;  ///< false: no node comes into contact at any gap
};

/// Distances of the search for the other surface.
struct SearchRule {
  /// Largest gap or overlap at which facets are paired [mm]; 0: chosen by reach_of(). Within a step, overlaps may
  /// exceed a given radius by the motion of the step, and by the deepest overlap of the last accepted state.
  double radius = 0;
  /// Distance outside a facet up to which a projection is accepted, in parametric coordinates [-].
  double tolerance = 0.01;
};

/// All settings of a contact with their defaults.
struct Settings {
  Enforcement enforcement = Enforcement::penalty;
  PenaltyRule traction{true, default_traction_factor};
  PenaltyRule solvent{true, default_flux_factor};
  PenaltyRule solute{true, default_flux_factor};
  FrictionRule friction;
  MembraneRule membrane;
  ReducedPenalty reduced_traction;
  Tolerances tolerances;
  bool two_pass = false;   ///< true: integrate over both surfaces instead of the primary one only
  bool symmetric = false;  ///< true: use the symmetric part of the tangent
  GapRule gap;
  Integration integration = Integration::segments;
  /// Gauss points per direction; 0: 2 for linear facets, 3 for quadratic ones. The same order counts on segments.
  int integration_order = 0;
  SearchRule search;
};

inline bool same_penalties(const Settings& a, const Settings& b) {
  return a.traction == b.traction && a.solvent == b.solvent && a.solute == b.solute && a.membrane == b.membrane &&
         a.reduced_traction.divisor == b.reduced_traction.divisor;
}

}  // namespace mixture_contact
