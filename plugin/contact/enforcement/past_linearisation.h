/// The last linearisation, and what of it still holds at another state.
#pragma once

#include "enforcement/geometric_rows.h"

#include <array>
#include <optional>

namespace mixture_contact {

/// The largest part by which something may have changed that a linearisation still serves: motions as a part of the
/// shortest edge of a facet, values of fields of their range, loads of the largest one.
///
/// An iteration with a tangent that is off by delta misses a gap by delta of its increment; the penalty eps makes a
/// load of that, delta of which pushes aside and moves what is there by eps delta^2/k, with k the stiffness of the
/// adjoining elements (a conductance alike). That is to be a tenth of the increment, at most, and delta a thousandth.
/// The sizes are choices.
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

/// The last linearisation, in the parts that it is let go in: the geometric one as the surfaces move, the point as its
/// iterations end.
class LastLinearisation {
 public:
  /// Takes a part over that is held no more, if there is one.
  void take_over(std::optional<GeometricPart>& held);
  void take_over(std::optional<LinearisationPoint>& held);
  /// Gives it away; none where there are not both parts.
  std::optional<PastLinearisation> take();

  std::size_t memory() const;

 private:
  std::optional<GeometricPart> geometric_;
  std::optional<LinearisationPoint> point_;
};

/// The nodes around which something has changed by more than a part `same` from the source of a linearisation to a
/// point: status, loads, weights, or at all of them the state or the points. With friction it has at all, since slips
/// are measured from where each step begins.
NodeFlags changed_nodes(const PastLinearisation& past, const LinearisationPoint& next, const LinearisationSource& now,
                        const MortarSpace& space, double same);

}  // namespace mixture_contact
