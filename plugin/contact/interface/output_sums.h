/// Sums over the integration points of a pass, from which balances and nodal output are computed.
#pragma once

#include "interface/output.h"
#include "mortar/loaded_points.h"

namespace mixture_contact {

/// The rows of a matrix of nodal sums with one column per node. Each entry is the sum over points of a value times the
/// part of the point's area that belongs to the node [mm^2]. Values from row turning() on have opposite signs on both
/// surfaces. This class is the form without friction.
class OutputRows : public Polymorphic {
 public:
  explicit OutputRows(Index fields) : fields_(fields) {}

  static constexpr Index area = 0;
  static constexpr Index gap = 1;
  static constexpr Index pressure = 2;

  /// First row of values with opposite signs on both surfaces.
  virtual Index turning() const { return pressure + 1; }
  /// Row of the first field's flux; the other fields follow.
  Index flux() const { return turning(); }
  /// Row of the first field's jump; the other fields follow.
  Index jump() const { return flux() + fields_; }
  /// Number of rows.
  virtual Index count() const { return jump() + fields_; }
  Index fields() const { return fields_; }

  /// Sets the friction of a point of a primary facet in its rows.
  virtual void set_sliding(const PointContact& /*point*/, const Facet& /*facet*/, VectorXd& /*values*/) const {}
  /// The friction force on a surface with these sums [N].
  virtual Vector3d friction_force(const MatrixXd& /*sums*/) const { return Vector3d::Zero(); }
  /// The friction at the nodes of a surface with these sums. `per_area`: reciprocal of the nodes' tributary areas.
  virtual FrictionOutput friction(const MatrixXd& /*sums*/, const VectorXd& /*per_area*/) const { return {}; }
  /// Sets the status of nodes of the primary surface of the pass, which have a friction status of their own.
  virtual void take_status(FrictionOutput& /*out*/) const {}
  /// Energy dissipated since the start of the step [mJ].
  virtual double dissipation() const { return 0; }

 private:
  Index fields_;
};

/// Sums over the points of a pair of facets or of a pass.
struct OutputSums {
  Vector3d force = Vector3d::Zero();  ///< force of the normal traction on the primary surface [N]
  MatrixXd integrated;                ///< sums at the primary nodes, rows as OutputRows
  MatrixXd facing;                    ///< sums at the secondary nodes, rows as OutputRows

  void set_zero(Index rows, Index integrated_nodes, Index facing_nodes) {
    force.setZero();
    integrated.setZero(rows, integrated_nodes);
    facing.setZero(rows, facing_nodes);
  }
};

/// The reciprocals of positive values; 0 for others.
inline VectorXd inverse_or_zero(const VectorXd& values) {
  return (values.array() > 0).select(values.array().inverse(), 0.0);
}

/// The sums over all points of a pass that carry load.
OutputSums sums_of(const MortarSpace& space, const NodalLoads& loads, const OutputRows& rows,
                   const FacingFields& fields);

}  // namespace mixture_contact
