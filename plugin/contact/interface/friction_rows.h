/// The rows of friction in the output of a pass, and the choice between the rows with and without friction.
#pragma once

#include "interface/output_sums.h"

namespace mixture_contact {

/// The rows of a pass with friction.
class FrictionRows final : public OutputRows {
 public:
  FrictionRows(const NodalLaws& laws, const NodalLoads& loads);

  Index turning() const override { return slips + 1; }
  Index count() const override { return slip() + 3; }

  void set_sliding(const PointContact& point, const Facet& facet, VectorXd& values) const override;
  Vector3d friction_force(const MatrixXd& sums) const override;
  FrictionOutput friction(const MatrixXd& sums, const VectorXd& per_area) const override;
  void take_status(FrictionOutput& out) const override;
  double dissipation() const override { return dissipation_; }

 private:
  // Rows of the bound T_max, the load that the fluid bears, and 1 for slip or 0 for stick.
  static constexpr Index bound = pressure + 1;
  static constexpr Index fluid = pressure + 2;
  static constexpr Index slips = pressure + 3;
  /// First of three rows of the friction traction.
  Index traction() const { return OutputRows::count(); }
  /// First of three rows of the slip.
  Index slip() const { return traction() + 3; }

  Matrix3Xd slip_;  ///< slip of the nodes in the present tangent plane [mm]
  VectorXd bound_;  ///< friction bound T_max of the nodes [MPa]
  VectorXd fluid_;  ///< load that the fluid bears at the nodes [MPa]
  NodeFlags in_contact_;
  VectorXd slips_;  ///< 1 for a node that slips, 0 for any other
  double dissipation_ = 0;
};

/// The rows for a pass with these loads.
std::unique_ptr<OutputRows> output_rows(const NodalLaws& laws, const NodalLoads& loads);

}  // namespace mixture_contact
