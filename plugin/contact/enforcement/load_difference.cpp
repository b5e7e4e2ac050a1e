#include "enforcement/load_difference.h"

#include <algorithm>

namespace mixture_contact {
namespace {

/// True if two arrays of loads (fields, nodes) differ by more than the fraction `part` of a field's largest entry plus
/// `rounding` of the field.
bool differs(const MatrixXd& one, const MatrixXd& other, double part, const VectorXd& rounding) {
  if (one.cols() == 0) return false;
  for (Index field = 0; field < one.rows(); ++field) {
    const double size = std::max(one.row(field).cwiseAbs().maxCoeff(), other.row(field).cwiseAbs().maxCoeff());
    if (!((one.row(field) - other.row(field)).cwiseAbs().maxCoeff() <= part * size + rounding[field])) return true;
  }
  return false;
}

}  // namespace

bool differ(const MortarSpace& space, const NodalLaws& laws, const NodalLoads& one, const NodalLoads& other,
            double part, const FacingFields& fields) {
  const double size = space.facing().surface_size();
  const VectorXd traction_rounding = VectorXd::Constant(1, laws.traction_rounding(size));
  VectorXd flux_rounding = laws.field_rounding(fields, size);
  for (Index field = 0; field < flux_rounding.size(); ++field) {
    flux_rounding[field] *= laws.multipliers.flux_penalty_scale[field] * laws.penalties().flux.row(field).maxCoeff();
  }
  return differs(one.traction.transpose(), other.traction.transpose(), part, traction_rounding) ||
         differs(one.flux, other.flux, part, flux_rounding) ||
         differs(one.friction.traction.reshaped().transpose(), other.friction.traction.reshaped().transpose(), part,
                 traction_rounding);
}

}  // namespace mixture_contact
