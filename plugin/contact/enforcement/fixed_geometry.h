/// Evaluation of a pass whose surfaces cannot move. They exchange no traction, and fluxes are linear in the fields: the
/// coefficients of the jumps are computed once, and no contact status changes.
#pragma once

#include "enforcement/contact_geometry.h"

namespace mixture_contact {

/// The evaluation of a pass whose surfaces are fixed.
class FixedGeometry : public ContactGeometry {
 public:
  /// Keeps a reference. No node is in contact until update() is called.
  explicit FixedGeometry(PassParts& parts);

  void update(const FacingPositions& x) override;
  void end_iterations() override;

  NodalLoads loads(const FacingFields& fields) const override;
  NodeFlags flux_coupled() const override { return fixed_.flux_coupled; }
  void residual(const FacingFields& fields, double dt, const AddVector& add) const override;
  void tangent(const FacingFields& fields, double dt, const TangentParts& add) const override;
  void for_each_coupling(const Couplings& use) const override;
  std::size_t memory() const override { return 0; }

 private:
  PassParts& parts_;
  NodalLoads fixed_;                        ///< areas, gaps and contact status
  IndexedVector<NodeLinearisation> nodes_;  ///< per node, jumps without displacements; empty for nodes out of contact
};

}  // namespace mixture_contact
