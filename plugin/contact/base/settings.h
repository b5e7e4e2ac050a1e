/// The choices a user makes about a contact.
#pragma once

#include <algorithm>
#include <map>
#include <optional>

namespace mixture_contact {

/// How the interface conditions are enforced.
enum class Enforcement {
  penalty,               ///< multipliers stay zero, but where penalties are reduced; gaps and jumps are flux / penalty
  augmented_lagrangian,  ///< multipliers take up the loads of converged solutions until gaps and jumps meet the
                         ///< tolerances
  lagrange_multipliers   ///< multipliers are unknowns of the same Newton solve, with equations of their own
};

/// The points at which the integrals over the primary surface are sampled.
enum class Integration {
  gauss,    ///< at Gauss points of the primary facets: cheap; not exact where facets of both sides end at different
            ///< places
  segments  ///< on the pieces into which facets of both sides cut each other: exact for all facets
};

/// Penalty of one kind of field.
struct PenaltyRule {
  bool automatic = true;  ///< whether `value` multiplies the local stiffness or conductance, or is the penalty itself
  double value = 1.0;
  double time_step = 0;  ///< in which elements store the field, where that counts [s]; 0: it does not

  friend bool operator==(const PenaltyRule& a, const PenaltyRule& b) {
    return a.automatic == b.automatic && a.value == b.value && a.time_step == b.time_step;
  }
};

/// The penalties of the traction in a step after a failed one.
struct ReducedPenalty {
  double divisor = 1;  ///< of the penalties [-]
  double kept = 1;     ///< part of the accepted loads, beyond those of the gaps, that the step begins with [-]
};

/// Coefficients of a film for one solute.
struct SoluteFilm {
  double permeance = 0;   ///< P_k [mm/s]
  double reflection = 1;  ///< sigma_k: the part that the flow leaves behind, from 0 to 1 [-]

  friend bool operator==(const SoluteFilm& a, const SoluteFilm& b) {
    return a.permeance == b.permeance && a.reflection == b.reflection;
  }
};

/// A film between the surfaces that resists fluxes (conditions/membrane.h). Fields that it does not name are
/// continuous.
struct MembraneRule {
  std::optional<double> conductance;  ///< L_p of the solvent [mm^3/(N s)]
  std::map<int, SoluteFilm> solutes;  ///< by the host's ids
  double thermal_energy = 0;          ///< R T [MPa/mM]

  friend bool operator==(const MembraneRule& a, const MembraneRule& b) {
    return a.conductance == b.conductance && a.solutes == b.solutes && a.thermal_energy == b.thermal_energy;
  }
};

/// Friction: |t_T| <= mu <|t_n| - (1 - phi) (p - p*)>.
struct FrictionRule {
  double coefficient = 0;       ///< mu [-]
  double contact_fraction = 0;  ///< phi: the part of the area where solid touches solid, from 0 to 1 [-]
  double ambient_pressure = 0;  ///< p* [MPa]
  double penalty_factor = 0.1;  ///< tangential penalty over that of the traction [-]; see friction_factor()

  friend bool operator==(const FrictionRule& a, const FrictionRule& b) {
    return a.coefficient == b.coefficient && a.contact_fraction == b.contact_fraction &&
           a.ambient_pressure == b.ambient_pressure && a.penalty_factor == b.penalty_factor;
  }
};

/// Default multiples of the local stiffness and conductance. A jump is about 1/factor of the drop across the adjoining
/// elements. Fluxes are linear in the jump, so only rounding limits their factor; the traction has a kink that a large
/// factor sharpens.
inline constexpr double default_traction_factor = 1e3;
inline constexpr double default_flux_factor = 1e5;
/// Default multiples with two passes. These have twice as many conditions as the surfaces can meet: on closing curved
/// surfaces, a stiffer penalty makes the nodes of both open and close in turn, or locks the fields of both.
inline constexpr double two_pass_traction_factor = 1e2;
inline constexpr double two_pass_flux_factor = 1e3;
/// Default multiple of the stiffness for surfaces that pull: the first iteration pulls all surfaces within the search
/// radius together.
inline constexpr double tension_traction_factor = 3e2;

/// Default tangential penalty as a multiple of the stiffness: elastic slip is 1/factor of the shear of the adjoining
/// elements. A larger one sharpens the kinks at the bound, and the active set takes longer to find the sticking nodes.
inline constexpr double default_friction_factor = 1e2;

/// The default of the tangential penalty over a traction penalty that is `factor` times the stiffness: at most 1.
inline double friction_factor(double factor) { return std::min(1.0, default_friction_factor / factor); }

/// Numbers of augmentations of an augmented Lagrangian solution.
struct Augmentations {
  int least = 0;
  int most = 10;
};

/// Tolerances of an augmented Lagrangian solution. 0 switches a criterion off.
struct Tolerances {
  /// Criteria of one kind of field.
  struct Field {
    double relative = 2e-3;  ///< rms gap or jump over the drop across the adjoining elements [-]; above
                             ///< 1/default_traction_factor
    double largest = 0;      ///< largest |g| [mm], |p1 - p2| [MPa] or |c1 - c2| [mM] in contact
  };
  Field traction;
  Field solvent;
  Field solute;
  Augmentations augmentations;
};

/// Gaps at which the surfaces exert a traction.
struct GapRule {
  double offset = 0;      ///< gap at which the surfaces are in contact without load [mm]
  bool tension = false;   ///< whether paired surfaces also pull and never open
  bool may_touch = true;  ///< false: no node ever comes into contact, whatever the gaps
};

/// Distances of the search for the other surface.
struct SearchRule {
  double radius = 0;        ///< largest distance or overlap at which facets are paired [mm]; 0: reach_of() chooses
  double tolerance = 0.01;  ///< how far outside a facet, in parametric coordinates, a projection is still accepted [-]
};

/// All settings of a contact, with the defaults users get.
struct Settings {
  Enforcement enforcement = Enforcement::penalty;
  PenaltyRule traction{true, default_traction_factor};
  PenaltyRule solvent{true, default_flux_factor};
  PenaltyRule solute{true, default_flux_factor};
  FrictionRule friction;
  MembraneRule membrane;
  ReducedPenalty reduced_traction;
  Tolerances tolerances;
  bool two_pass = false;   ///< integrate over both surfaces instead of the primary alone
  bool symmetric = false;  ///< return the symmetric part of the tangent
  GapRule gap;
  Integration integration = Integration::segments;
  int integration_order = 0;  ///< Gauss points per direction; 0: 2 for linear facets, 3 for quadratic ones; the same
                              ///< order on segments
  SearchRule search;
};

inline bool same_penalties(const Settings& a, const Settings& b) {
  return a.traction == b.traction && a.solvent == b.solvent && a.solute == b.solute && a.membrane == b.membrane &&
         a.reduced_traction.divisor == b.reduced_traction.divisor;
}

}  // namespace mixture_contact
