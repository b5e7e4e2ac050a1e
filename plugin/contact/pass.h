/// One pass of a contact: the integral (2.5) over one surface against the other.
#pragma once

#include "penalty.h"
#include "point_integral.h"
#include "search.h"

#include <functional>
#include <vector>

namespace mixture_contact {

/// Multipliers of the integration points: the state that only an augmentation changes.
struct Multipliers {
  VectorXd traction;    ///< lambda_n per point [MPa]
  MatrixXd flux;        ///< lambda per (field, point)
  double traction_growth = 1;  ///< factor on eps_n that slow augmentations have built up
  VectorXd flux_growth;        ///< the same per field
};

/// An integration point of the primary surface that sees a facet of the secondary surface.
struct PointPair {
  int point = 0;             ///< index of the integration point
  int primary_facet = 0;
  int secondary_facet = 0;
  Vector2d eta{0, 0};        ///< projected point on the secondary facet
};

/// Everything at one integration point in contact.
struct PointContact {
  const PointPair* pair = nullptr;
  PointKinematics kinematics;
  std::vector<int> fields;  ///< exchanged scalar fields here, as indices into Effects' order
  PairFields values;        ///< their nodal values
  PointLoads loads;
};

/// A pair of facets with the contributions of all their common points to a residual or a tangent.
struct FacetPair {
  const Facet& primary;
  const Facet& secondary;
  const std::vector<int>& fields;  ///< local field k is fields[k] in Effects' order
  LocalLayout layout;
};

/// The integral over one surface. Evaluations are const; only project() replaces the pairs, only augment (through
/// `multipliers`) the state.
class ContactPass {
 public:
  ContactPass(const SurfaceMesh& primary, const SurfaceMesh& secondary, const Effects& effects, const Settings& settings);

  /// Projects every integration point onto the secondary surface: of the facets that face it within `radius`, the nearest.
  void project(const Matrix3Xd& x1, const Matrix3Xd& x2, double radius);

  /// Projects the points that saw a facet in the last project() onto that same facet again, without a search. A point that leaves
  /// its facet comes back with it: the result depends on that search and the positions alone.
  void project_on_same_facets(const Matrix3Xd& x1, const Matrix3Xd& x2);

  /// Calls `use` for every point that is in contact, in a fixed order.
  void for_each_contact(const SurfaceFields& primary, const SurfaceFields& secondary, double dt,
                        const std::function<void(const PointContact&)>& use) const;

  /// Residual of (2.5) per pair of facets in contact.
  void residual(const SurfaceFields& primary, const SurfaceFields& secondary, double dt,
                const std::function<void(const FacetPair&, const VectorXd&)>& add) const;

  /// Tangent (2.6) per pair of facets in contact.
  void tangent(const SurfaceFields& primary, const SurfaceFields& secondary, double dt,
               const std::function<void(const FacetPair&, const MatrixXd&)>& add) const;

  /// All pairs of facets that see each other, in contact or not: what a matrix profile has to hold.
  void for_each_facet_pair(const std::function<void(const FacetPair&)>& use) const;

  /// How far the area next to each primary node is in contact, 0 to 1, in the configuration of the last project(): of the facets
  /// around the node the one with the largest share of its points in contact, each point weighted by its nearness to the node (its
  /// shape function). This depends neither on how many facets meet at the node nor on their sizes.
  VectorXd coverage(const Matrix3Xd& x1, const Matrix3Xd& x2) const;

  /// Recomputes the penalties after the properties of the surfaces have changed.
  void update_penalties();

  const std::vector<PointPair>& pairs() const { return pairs_; }
  const Penalties& penalty() const { return penalties_; }
  Index points() const { return static_cast<Index>(points_.size()); }

  Multipliers multipliers;

 private:
  struct IntegrationPoint {
    int facet;
    double weight;
    ShapeFunctions shape;
  };

  Ray ray(std::size_t point, const Matrix3Xd& x1, double radius) const;
  PointKinematics kinematics(const PointPair& pair, const Matrix3Xd& x1, const Matrix3Xd& x2) const;
  LawValue traction(const PointPair& pair, double gap) const;
  std::vector<int> exchanged_fields(const PointPair& pair) const;
  PointContact contact(const PointPair& pair, const PointKinematics& point, const LawValue& traction,
                       const SurfaceFields& primary, const SurfaceFields& secondary, double dt) const;
  FacetPair facet_pair(const PointPair& pair, const std::vector<int>& fields) const;

  template <class Local, class Evaluate, class Add>
  void gather_by_facet_pair(const SurfaceFields& primary, const SurfaceFields& secondary, double dt, const Evaluate& evaluate,
                            const Add& add) const;

  const SurfaceMesh& primary_;
  const SurfaceMesh& secondary_;
  const Effects& effects_;
  const Settings& settings_;
  Penalties penalties_;
  std::vector<IntegrationPoint> points_;
  std::vector<PointPair> pairs_;
  std::vector<int> seen_;  ///< per point: the secondary facet that the last project() found, or -1
  double touch_ = 0;  ///< distance at which surfaces touch to rounding [mm]
};

}  // namespace mixture_contact
