#include "mortar/bearing_pressure.h"

#include <optional>

namespace mixture_contact {
namespace {

/// The side whose fluid pressure acts on the friction of a pair: the primary one if its facet has fluid, else the
/// secondary one; empty if neither has fluid.
std::optional<Side> bearing_side(const FacingPairs& facing, const FacetPair& pair) {
  const FieldMask bearing = facing.effects().bearing_fields();
  if ((bearing & facing.primary().permeable[pair.primary]) != 0) return Side::primary;
  if ((bearing & facing.secondary().permeable[pair.secondary]) != 0) return Side::secondary;
  return std::nullopt;
}

}  // namespace

BearingPressure bearing_pressure(const FacingPairs& facing, const FacetPair& pair, const FacingFields& fields,
                                 double ambient) {
  const std::optional<Side> side = bearing_side(facing, pair);
  if (!side) return {};
  const int field = facing.effects().pressure_field();
  const bool primary = *side == Side::primary;
  const Facet& facet = primary ? facing.primary_facet(pair) : facing.secondary_facet(pair);
  const SurfaceFields& surface = primary ? fields.primary : fields.secondary;
  const FacetVector values = facet_values(facet, surface.scalar.col(field));
  return {primary ? 0 : facing.primary_facet(pair).count(), values.array() - ambient};
}

double pressure_at(const BearingPressure& pressure, const PointKinematics& point) {
  if (pressure.empty()) return 0;
  return (pressure.first == 0 ? point.primary_shape : point.secondary_shape).dot(pressure.value);
}

PairVariation<1> pressure_variation(const BearingPressure& pressure, const PointKinematics& point,
                                    const KinematicVariations& vary) {
  const bool on_primary = pressure.first == 0;
  if (pressure.empty() || (on_primary && !vary.wanders())) return PairVariation<1>::Zero(vary.gap.size());
  if (on_primary) return (pressure.value.transpose() * point.primary_gradient).eval().lazyProduct(vary.xi);
  return (pressure.value.transpose() * point.secondary_gradient).eval().lazyProduct(vary.eta);
}

PairVector pressure_weights(const BearingPressure& pressure, const PointKinematics& point) {
  PairVector weights = PairVector::Zero(point.nodes());
  if (pressure.empty()) return weights;
  const FacetVector& shape = pressure.first == 0 ? point.primary_shape : point.secondary_shape;
  weights.segment(pressure.first, shape.size()) = shape;
  return weights;
}

}  // namespace mixture_contact
