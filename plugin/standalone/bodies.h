/// The bodies: residual and tangent of (2.1)-(2.3) over all elements.
#pragma once

#include "law.h"

namespace standalone {

/// The elements of a model with their integration points. Evaluations are const; only accept_step() changes the
/// history.
///
/// Local vectors of an element are field by field, in the order of places(): only the fields that its material has.
class Bodies {
 public:
  /// Throws InputError if an element is inverted.
  explicit Bodies(const Model& model);

  std::size_t elements() const { return elements_.size(); }
  const Element& element(std::size_t e) const { return model_.mesh.elements[e]; }
  const Material& material(std::size_t e) const { return model_.material(element(e)); }

  /// Places of an element's nodal values (see Model::place).
  std::vector<int> places(std::size_t e) const;

  /// Internal forces of (2.1) and dt times the balances (2.2), (2.3), for nodal values of shape (dofs, nodes).
  /// Throws StepFailure if an element is inverted.
  VectorXd residual(std::size_t e, const MatrixXd& values, double dt) const;

  /// Exact derivative of residual() with the element's nodal values, by automatic differentiation of the law at each
  /// point.
  MatrixXd tangent(std::size_t e, const MatrixXd& values, double dt) const;

  /// Keeps J and the contents at these nodal values as the start of the next time step.
  void accept_step(const MatrixXd& values);

  /// Averages over an element's integration points, for output and automatic penalties.
  struct Average {
    double pressure = 0;             ///< actual pressure [MPa]
    double concentration = 0;        ///< actual concentration kappa~ c~ [mM]
    Vector3d solvent_flux{0, 0, 0};  ///< [mm/s]
    Vector3d solute_flux{0, 0, 0};   ///< [nmol/(mm^2 s)]
  };
  Average average(std::size_t e, const MatrixXd& values) const;

  /// Volume of an element in the reference configuration [mm^3].
  double volume(std::size_t e) const;

 private:
  struct Point {
    Eigen::Matrix4Xd shape;  ///< N_a and its reference gradient, shape (4, nodes)
    double volume;           ///< weight times reference Jacobian [mm^3]
    PointHistory last;
  };

  /// Nodal values of the fields of an element, shape (nodes, max_fields); zero for absent fields.
  MatrixXd nodal_fields(std::size_t e, const MatrixXd& values) const;

  const Model& model_;
  double gas_energy_;  ///< R T [mJ/nmol]
  std::vector<std::vector<Point>> elements_;
};

}  // namespace standalone
