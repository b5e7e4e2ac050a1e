/// The last linearisation, and its parts that are still valid at another state.
#pragma once

#include "enforcement/geometric_rows.h"

#include <array>
#include <optional>

namespace mixture_contact {

/// The largest relative change after which a linearisation may be reused: motions relative to the shortest edge of a
/// facet, values of fields to their range, loads to the largest one.
///
/// A tangent with the relative error delta leaves the part delta of the increment of a gap. The penalty eps makes a
/// load of this gap, and delta of this load acts sideways and moves the bodies by the part eps delta^2/k of the
/// increment, with the stiffness k of the adjoining elements (for a flux, the conductance). This part has to be at most
/// a tenth, which gives delta = 1/1000. The sizes are choices.
double same_to_linearisation(const NodalLaws& laws);

/// The source of a linearisation.
struct LinearisationSource {
  IndexedVector<std::array<Index, 3>> pairs;  ///< primary facet, secondary facet, number of points
  IndexedVector<int> sub_facets;              ///< that the points lie on, pair by pair
  LoadCarriers carriers;                      ///< which weight the points
  SurfaceFields primary;                      ///< the state
  SurfaceFields secondary;
  ContactStatus status;
  VectorXd traction;  ///< of the geometric part
  MatrixXd flux;      ///< alike

  /// The source of a linearisation that is made at a point, with averages and loads at the present integration points.
  LinearisationSource(const LinearisationPoint& point, const MortarSpace& space);
  /// A linearisation made of another one replaces it at some nodes. The state stays the older one: differences are
  /// measured from it, so that many small ones add up.
  void replace_at(const NodeFlags& nodes, const LinearisationSource& by);
};

/// The geometric part of the tangent in a time increment of 1, by pairs of facets and by nodes.
struct GeometricPart {
  GeometricParts pairs;
  NodeRows tractions;
  IndexedVector<NodeRows> fluxes;  ///< per field; none in a symmetric tangent
  LinearisationSource source;

  std::size_t memory() const;
};

/// A linearisation that has been held.
struct PastLinearisation {
  LinearisationPoint point;
  GeometricPart geometric;
};

/// The last linearisation, in the two parts that the contact drops: the geometric part when the surfaces move, the
/// point when its iterations end.
class LastLinearisation {
 public:
  /// Takes over a dropped part, if there is one.
  void take_over(std::optional<GeometricPart>& held);
  void take_over(std::optional<LinearisationPoint>& held);
  /// Hands the linearisation out; none unless both parts are here.
  std::optional<PastLinearisation> take();

  std::size_t memory() const;

 private:
  std::optional<GeometricPart> geometric_;
  std::optional<LinearisationPoint> point_;
};

/// The nodes with a change of more than a part `same` from the source of a linearisation to a point. Status, loads and
/// weights change single nodes; the state and the points change all. Friction changes all, because each step measures
/// slips from its start.
NodeFlags changed_nodes(const PastLinearisation& past, const LinearisationPoint& next, const LinearisationSource& now,
                        const MortarSpace& space, double same);

}  // namespace mixture_contact
