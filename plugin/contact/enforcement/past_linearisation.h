/// The last linearisation, and the tests which of its parts can be reused at another state.
#pragma once

#include "enforcement/geometric_rows.h"

#include <array>
#include <optional>

namespace mixture_contact {

/// The largest relative change up to which a linearisation may be reused: motions relative to the shortest edge of a
/// facet, field values relative to their range, loads relative to the largest load.
///
/// A tangent with the relative error delta leaves the fraction delta of a gap's increment. The penalty eps turns this
/// remaining gap into a load. The fraction delta of the load acts sideways, and moves the bodies by the fraction eps
/// delta^2/k of the increment, where k is the stiffness of the adjoining elements (for a flux, the conductance). That
/// fraction is at most a tenth, and the change at most 1/1000. Both limits are choices.
double same_to_linearisation(const NodalLaws& laws);

/// The data from which a linearisation was computed.
struct LinearisationSource {
  IndexedVector<std::array<Index, 3>> pairs;  ///< primary facet, secondary facet, number of points
  IndexedVector<int> sub_facets;              ///< numbers of the linear pieces of the points, pair by pair
  LoadCarriers carriers;                      ///< nodes that carry load in the weights of the points
  SurfaceFields primary;                      ///< state of the primary surface
  /// State of the secondary surface.
  SurfaceFields secondary;
  ContactStatus status;
  VectorXd traction;  ///< normal tractions t_a in the geometric part of the tangent
  MatrixXd flux;      ///< fluxes in the geometric part of the tangent

  /// The data of a linearisation at `point` with the averages and loads at the present integration points.
  LinearisationSource(const LinearisationPoint& point, const MortarSpace& space);
  /// Notes that some nodes have been linearised again from the data `by`. The state remains the older one: later
  /// changes are measured from it, so that many small changes add up.
  void replace_at(const NodeFlags& nodes, const LinearisationSource& by);
};

/// The geometric part of the tangent for a time increment of 1, by pairs of facets and by nodes.
struct GeometricPart {
  GeometricParts pairs;
  NodeRows tractions;
  IndexedVector<NodeRows> fluxes;  ///< rows of each flux, per field; empty for a symmetric tangent
  LinearisationSource source;

  std::size_t memory() const;
};

/// A complete linearisation of an earlier iteration.
struct PastLinearisation {
  LinearisationPoint point;
  GeometricPart geometric;
};

/// Keeps the last linearisation in two parts: the geometric part, which a pass discards when its surfaces move, and the
/// point, which it discards when its iterations end.
class LastLinearisation {
 public:
  /// Takes over the geometric part, if there is one.
  void take_over(std::optional<GeometricPart>& held);
  /// Takes over the linearisation point, if there is one.
  void take_over(std::optional<LinearisationPoint>& held);
  /// Returns the linearisation and no longer keeps it; empty unless both parts are present.
  std::optional<PastLinearisation> take();

  std::size_t memory() const;

 private:
  std::optional<GeometricPart> geometric_;
  std::optional<LinearisationPoint> point_;
};

/// The nodes whose linearisation has to be computed again: those at which a quantity has changed by more than the
/// fraction `same` between the data of `past` and `now`. Status, loads and weights affect single nodes; a changed state
/// or changed points affect all nodes. The result is not valid with friction, because slips are measured from the start
/// of each step.
NodeFlags changed_nodes(const PastLinearisation& past, const LinearisationSource& now, const MortarSpace& space,
                        double same);

}  // namespace mixture_contact
