/// Measures without unit of the error in the conditions, and the growth of penalties after a large error.
#pragma once

#include "base/effects.h"
#include "base/settings.h"

#include <cmath>

namespace mixture_contact {

/// The error of one field in its condition over the contact area.
struct FieldGap {
  double relative = 0;  ///< rms gap or jump over the drop across the adjoining elements that the load causes [-]
  double largest = 0;   ///< largest |gap| or |jump| in contact, in the field's unit
};

/// Gaps of all fields: traction, each exchanged scalar field in the order of Effects, friction.
struct GapReport {
  FieldGap traction;
  IndexedVector<FieldGap> flux;
  FieldGap slip = {};  ///< of nodes that stick
};

/// The larger of two values; not a number if one of them is none, so that a failed evaluation never looks converged.
inline double larger(double one, double other) { return one > other || std::isnan(one) ? one : other; }

/// Sums over the contact area from which a FieldGap is formed.
class GapSums {
 public:
  /// Adds a node. `base`: stiffness or conductance of the adjoining elements; `field`: the scale of the jump if no load
  /// flows.
  void add(double area, double base, double jump, double load, double field);
  /// rms(base jump)/rms(load), and the largest jump. Nothing over nothing is no gap.
  FieldGap field_gap() const;

 private:
  double gap_ = 0;   ///< INT (eps0 gap)^2 da
  double load_ = 0;  ///< INT load^2 da
  double size_ = 0;  ///< INT (eps0 field)^2 da
  double largest_ = 0;
};

const Tolerances::Field& tolerance_of_flux(const Tolerances& tolerances, const Effects& effects, Index field);

bool is_within(const FieldGap& gap, const Tolerances::Field& tolerance);

/// Whether a report meets the tolerances of the settings.
bool meets(const GapReport& report, const Tolerances& tolerances, const Effects& effects);

/// Multiplies the scale of a field's penalties by ten if the field misses its tolerance. The smallest penalty grows to
/// `accurate` times the largest base at most. Facets without a penalty (impermeable ones) do not count. Returns whether
/// the scale has grown.
bool grow(double& scale, const FieldGap& gap, const Tolerances::Field& tolerance, const VectorXd& penalties,
          const VectorXd& bases, double accurate);

}  // namespace mixture_contact
