/// The deformable bodies: residual and tangent of (2.1)-(2.3) over all elements.
#pragma once

#include "law.h"

namespace standalone {

/// The elements of a model with their integration points. Evaluations are const; only accept_step() changes the
/// history.
///
/// Local vectors of an element are ordered field by field as in places(), and contain only the fields that the
/// element's material has.
class Bodies {
 public:
  /// Throws InputError if an element is inverted in the reference configuration.
  explicit Bodies(const Model& model);

  const Model& model() const { return model_; }
  std::size_t elements() const { return elements_.size(); }
  const Element& element(std::size_t e) const { return model_.mesh.elements[e]; }
  const Material& material(std::size_t e) const { return model_.material(element(e)); }

  /// Indices of an element's nodal values in a vector of all nodal values (see Model::place).
  std::vector<int> places(std::size_t e) const;

  /// The residual of an element: internal forces of (2.1), and dt times the balances (2.2) and (2.3). `values`: all
  /// nodal values, shape (dofs, nodes). Throws StepFailure if the element is inverted.
  VectorXd residual(std::size_t e, const MatrixXd& values, double dt) const;

  /// The exact derivative of residual() with respect to the element's nodal values, by automatic differentiation of the
  /// law at each point.
  MatrixXd tangent(std::size_t e, const MatrixXd& values, double dt) const;

  /// Stores J and the contents at these nodal values as the start of the next time step.
  void accept_step(const MatrixXd& values);

  /// Averages over the integration points of an element, for output and automatic penalties.
  struct Average {
    double pressure = 0;             ///< actual pressure [MPa]
    double concentration = 0;        ///< actual concentration c = kappa~ c~ [mM]
    Vector3d solvent_flux{0, 0, 0};  ///< solvent flux w [mm/s]
    Vector3d solute_flux{0, 0, 0};   ///< solute flux j [nmol/(mm^2 s)]
  };
  /// The averages at these nodal values.
  Average average(std::size_t e, const MatrixXd& values) const;

  /// Volume of an element in the reference configuration [mm^3].
  double volume(std::size_t e) const;

 private:
  struct Point {
    Eigen::Matrix4Xd shape;  ///< shape functions N_a and their reference gradients, shape (4, nodes)
    double volume;           ///< quadrature weight times the Jacobian in the reference configuration [mm^3]
    /// State at the start of the time step.
    PointHistory last;
  };

  /// Nodal values of an element's fields, shape (nodes, max_fields); zero for fields that the material does not have.
  MatrixXd nodal_fields(std::size_t e, const MatrixXd& values) const;

  const Model& model_;
  double gas_energy_;  ///< thermal energy R T [mJ/nmol]
  /// Integration points of each element.
  std::vector<std::vector<Point>> elements_;
};

}  // namespace standalone
