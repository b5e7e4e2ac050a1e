/// Dimensionless errors of the contact conditions, and the growth of penalties where the errors are large.
#pragma once

#include "base/effects.h"
#include "base/settings.h"

#include <cmath>

namespace mixture_contact {

/// The error of one field's condition over the contact area.
struct FieldGap {
  double relative = 0;  ///< rms gap or jump, relative to the drop across the adjoining elements under the load [-]
  double largest = 0;   ///< largest |gap| or |jump| in contact, in the unit of the field
};

/// The errors of all conditions: traction, each exchanged scalar field in the order of Effects, and each tangential
/// condition, which is the elastic slip of sticking nodes.
struct GapReport {
  FieldGap traction;
  IndexedVector<FieldGap> flux;
  IndexedVector<FieldGap> slip;
};

/// The larger of two values; NaN if one of them is NaN, such that a failed evaluation never counts as converged.
inline double larger(double one, double other) { return one > other || std::isnan(one) ? one : other; }

/// Sums over the contact area from which a FieldGap is computed.
class GapSums {
 public:
  /// Adds a node with its area, gap or jump, and load. `base`: stiffness or conductance of the adjoining elements.
  /// `field`: value of the field, to which the jump is compared if there is no load.
  void add(double area, double base, double jump, double load, double field);
  /// The relative error rms(base jump)/rms(load), and the largest jump. The relative error is 0 if numerator and
  /// denominator are 0.
  FieldGap field_gap() const;

 private:
  /// Integral of the squared gap, INT (eps0 gap)^2 da; eps0: stiffness or conductance of the elements.
  double gap_ = 0;
  double load_ = 0;  ///< integral of the squared load, INT load^2 da
  double size_ = 0;  ///< integral of the squared field, INT (eps0 field)^2 da
  double largest_ = 0;
};

/// The tolerance of the k-th exchanged field in the order of Effects: that of the solvent or that of solutes.
const Tolerances::Field& tolerance_of_flux(const Tolerances& tolerances, const Effects& effects, Index field);

/// True if an error meets a tolerance.
bool is_within(const FieldGap& gap, const Tolerances::Field& tolerance);

/// True if all errors meet the tolerances.
bool meets(const GapReport& report, const Tolerances& tolerances, const Effects& effects);

/// Multiplies `scale`, the factor on a field's penalties, by ten if the field misses its relative tolerance. The
/// smallest scaled penalty grows up to `accurate` times the largest base. Facets without a penalty (impermeable ones)
/// do not count. Returns true if the scale has grown.
bool grow(double& scale, const FieldGap& gap, const Tolerances::Field& tolerance, const VectorXd& penalties,
          const VectorXd& bases, double accurate);

}  // namespace mixture_contact
