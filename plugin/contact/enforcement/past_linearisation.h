/// The last linearisation, and what of it still holds at another state.
#pragma once

#include "enforcement/geometric_rows.h"

#include <array>
#include <optional>

namespace mixture_contact {

/// What has changed by this part, at most, is the same to a linearisation: positions as a part of a facet's size,
/// values of fields and loads as a part of their largest one. Newton's method still gains three digits with each
/// iteration.
inline constexpr double same_to_linearisation = 1e-3;

/// What a linearisation was made of.
struct LinearisationSource {
  IndexedVector<std::array<Index, 3>> pairs;  ///< primary facet, secondary facet, number of points
  LoadCarriers carriers;                      ///< which weight the points
  SurfaceFields primary;                      ///< the state
  SurfaceFields secondary;
  VectorXd traction;  ///< of the geometric part
  MatrixXd flux;      ///< alike

  /// Of one that is made at a point, whose averages and loads are those of the present points.
  LinearisationSource(const LinearisationPoint& point, const MortarSpace& space);
  /// The source where what is made of another one replaces it at some nodes: the state is the older one, from which
  /// differences are measured, so that many small ones add up.
  LinearisationSource replaced_at(const NodeFlags& nodes, const LinearisationSource& by) const;
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

/// The nodes of a surface with these facets around which something is another one at a point than what a linearisation
/// was made of: status, loads, weights, or at all of them the state or the points. With friction it is at all, since
/// slips are measured from where each step begins.
NodeFlags changed_nodes(const PastLinearisation& past, const LinearisationPoint& next, const LinearisationSource& now,
                        const IndexedVector<Facet>& facets);

}  // namespace mixture_contact
