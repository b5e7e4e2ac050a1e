/// Nodal averages for friction with their variations: slip, normal, convection F_a of the surface since the start of
/// the step, and fluid pressure.
#pragma once

#include "base/polymorphic.h"
#include "base/timings.h"
#include "conditions/nodal_loads.h"
#include "geometry/slip.h"
#include "integration/facing_pairs.h"
#include "mortar/slip_linearisation.h"

#include <memory>
#include <vector>

namespace mixture_contact {

struct CornerPoint;
struct PointForce;
struct PointLoads;
class MortarSpace;

/// The averages for friction of a pass. This class is the form without friction: its averages are empty, and it
/// computes nothing. MeasuredSlips is the form with friction. Callers use both in the same way.
class SlipAverages : public Polymorphic {
 public:
  /// The integrals over flat pairs on which the averages of the pass depend.
  virtual FlatIntegrals flat_integrals() const { return FlatIntegrals::moments; }
  /// Sets the positions relative to which slips are measured, unless they have been set or forget() was called.
  virtual void begin_at(const FacingPairs& /*facing*/, const FacingPositions& /*x*/) {}
  /// Accepts a state as the start of the next step: sets these positions, and the convection of `loads` since then.
  /// Returns true if this changes averages.
  virtual bool accept(const MortarSpace& /*space*/, const FacingPositions& /*x*/, NodalLoads& /*loads*/) {
    return false;
  }
  /// Lets slips begin at the positions of the next begin_at().
  virtual void forget() {}
  /// Sets stored positions; if they are empty, as forget().
  virtual void restore(const FacingPairs& /*facing*/, const FacingPositions& /*past*/) {}
  /// The positions of the primary and of the secondary surface, for restore(); empty before begin_at().
  virtual PerSide<Matrix3Xd> state() const { return {}; }
  /// Sets the ambient pressure p* in the friction law [MPa].
  virtual void measure_pressure_from(double /*ambient*/) {}
  /// Memory of positions and convections [bytes].
  virtual std::size_t memory() const { return 0; }

  /// The averages at the nodes in contact.
  virtual NodalFriction averages(const MortarSpace& /*space*/, const NodalLoads& /*loads*/,
                                 const FacingFields& /*fields*/) const {
    return {};
  }
  /// Adds to `nodes` those of a primary facet around a node on which the node's convection depends.
  virtual void add_nodes(IndexedVector<int>& /*nodes*/, const Facet& /*facet*/) const {}

  /// Sets the variations of a node to zero. `patch`: the nodes of its averages. `pairs`: the pairs around it.
  virtual void set_zero(SlipLinearisation& /*linear*/, const MortarSpace& /*space*/, Index /*node*/,
                        const Patch& /*patch*/, const PairsAround& /*pairs*/) const {}
  /// Sets the parts of a pair, one for each node of its primary facet, from its points in ascending order.
  /// `displacements`: layout of the displacements of the pair's nodes.
  virtual void set_pair(IndexedVector<PairSlip>& /*corners*/, const MortarSpace& /*space*/, const FacetPair& /*pair*/,
                        const LocalLayout& /*displacements*/, const std::vector<CornerPoint>& /*points*/,
                        const FacingFields& /*fields*/, ScopedTimer& /*laps*/) const {}
  /// Adds the part of a pair to the sums around a node of its primary facet. `corner`: number of the node in the facet.
  virtual void scatter(const IndexedVector<PairSlip>& /*corners*/, Index /*corner*/, const PairPlaces& /*place*/,
                       SlipLinearisation& /*sum*/) const {}
  /// Divides the sums around a node by its area: d(Y/A) = (dY - Y/A dA)/A.
  virtual void divide_by_area(SlipLinearisation& /*sum*/, const NodalLoads& /*loads*/, Index /*node*/) const {}
  /// Adds the changes of a node's averages to `friction`. `patch`: nodes of the averages. `moved`: their displacements.
  /// `change`: changes of positions and fields.
  virtual void predict(NodalFriction& /*friction*/, Index /*node*/, const SlipLinearisation& /*linear*/,
                       const Patch& /*patch*/, const VectorXd& /*moved*/, const FacingFields& /*change*/) const {}
  /// Adds the friction force of a point on the primary side, and its variation with the positions of the first nodes of
  /// the pair.
  virtual void add_force(const PointKinematics& /*point*/, const KinematicVariations& /*vary*/,
                         const PointLoads& /*loads*/, PointForce& /*force*/) const {}
};

/// The averages of a contact. `ambient_pressure`: p* in the friction law [MPa].
std::unique_ptr<SlipAverages> slip_averages(FrictionKind kind, double ambient_pressure);

/// The averages of slips, measured from the positions at the start of the step.
class MeasuredSlips final : public SlipAverages {
 public:
  explicit MeasuredSlips(double ambient_pressure) : ambient_pressure_(ambient_pressure) {}

  FlatIntegrals flat_integrals() const override { return FlatIntegrals::points; }
  void begin_at(const FacingPairs& facing, const FacingPositions& x) override;
  bool accept(const MortarSpace& space, const FacingPositions& x, NodalLoads& loads) override;
  void forget() override { is_set_ = false; }
  void restore(const FacingPairs& facing, const FacingPositions& past) override;
  PerSide<Matrix3Xd> state() const override { return is_set_ ? past_ : PerSide<Matrix3Xd>(); }
  void measure_pressure_from(double ambient) override { ambient_pressure_ = ambient; }
  std::size_t memory() const override;

  NodalFriction averages(const MortarSpace& space, const NodalLoads& loads, const FacingFields& fields) const override;
  void add_nodes(IndexedVector<int>& nodes, const Facet& facet) const override;

  void set_zero(SlipLinearisation& linear, const MortarSpace& space, Index node, const Patch& patch,
                const PairsAround& pairs) const override;
  void set_pair(IndexedVector<PairSlip>& corners, const MortarSpace& space, const FacetPair& pair,
                const LocalLayout& displacements, const std::vector<CornerPoint>& points, const FacingFields& fields,
                ScopedTimer& laps) const override;
  void scatter(const IndexedVector<PairSlip>& corners, Index corner, const PairPlaces& place,
               SlipLinearisation& sum) const override;
  void divide_by_area(SlipLinearisation& sum, const NodalLoads& loads, Index node) const override;
  void predict(NodalFriction& friction, Index node, const SlipLinearisation& linear, const Patch& patch,
               const VectorXd& moved, const FacingFields& change) const override;
  void add_force(const PointKinematics& point, const KinematicVariations& vary, const PointLoads& loads,
                 PointForce& force) const override;

 private:
  /// Sets the positions relative to which slips are measured.
  void measure_from(const FacingPairs& facing, const FacingPositions& past);
  /// Sets the convection F_a of the nodes in contact: how the surface around a node has deformed since the start of the
  /// step. `x1`: present positions of the primary surface.
  void convect(NodalFriction& friction, const FacingPairs& facing, const NodeFlags& in_contact,
               const Matrix3Xd& x1) const;
  /// The coefficients C_b of F_a = sum_b x_b C_b^T, one column per node of `primary`. F_a is the mean over the paired
  /// primary facets around a node, weighted with their areas at the start of the step.
  ///
  /// `pairs`: the pairs around the node. `primary`: primary nodes that include all nodes of these facets.
  Matrix3Xd convection_around(const FacingPairs& facing, Index node, const PairsAround& pairs,
                              const IndexedVector<int>& primary) const;

  double ambient_pressure_;
  bool is_set_ = false;
  PerSide<Matrix3Xd> past_;                               ///< primary and secondary positions
  IndexedVector<IndexedVector<Convection>> convections_;  ///< per primary facet and node
};

}  // namespace mixture_contact
