#include "interface/friction_rows.h"

namespace mixture_contact {
namespace {

double as_number(Sliding sliding) { return static_cast<double>(sliding); }

/// The friction status of nodes from facing points: a node slides if more than half of its area in contact does.
/// `slips`: sliding area; `areas`: area in contact.
VectorXd status_of(const VectorXd& slips, const VectorXd& areas) {
  VectorXd status(areas.size());
  for (Index node = 0; node < areas.size(); ++node) {
    const Sliding sliding = slips[node] > 0.5 * areas[node] ? Sliding::slips : Sliding::sticks;
    status[node] = as_number(areas[node] > 0 ? sliding : Sliding::open);
  }
  return status;
}

}  // namespace

std::unique_ptr<OutputRows> output_rows(const NodalLaws& laws, const NodalLoads& loads) {
  return by_friction<std::unique_ptr<OutputRows>>(
      laws.effects().acting_friction(), [&] { return std::make_unique<OutputRows>(laws.effects().scalar_fields()); },
      [&] { return std::make_unique<FrictionRows>(laws, loads); });
}

FrictionRows::FrictionRows(const NodalLaws& laws, const NodalLoads& loads)
    : OutputRows(laws.effects().scalar_fields()),
      slip_(Matrix3Xd::Zero(3, laws.nodes())),
      bound_(loads.friction.bound),
      fluid_(VectorXd::Zero(laws.nodes())),
      in_contact_(loads.in_contact),
      slips_(VectorXd::Zero(laws.nodes())) {
  const NodalFriction& friction = loads.friction;
  for (Index node = 0; node < laws.nodes(); ++node) {
    if (!loads.in_contact[node]) continue;
    const Vector3d n = friction.normal(node);
    const Vector3d carried = friction.convection[node] * friction.slip.col(node);
    slip_.col(node) = carried - n * n.dot(carried);
    if (friction.pressure.size() > 0) fluid_[node] = friction.pressure[node];
    if (!loads.slips[node]) continue;
    slips_[node] = 1;
    dissipation_ += loads.area[node] *
                    dissipated(friction.trial.col(node), friction.bound[node], laws.friction_penalty(node));
  }
}

void FrictionRows::set_sliding(const PointContact& point, const Facet& facet, VectorXd& values) const {
  values[bound] = point.psi.dot(facet_values(facet, bound_));
  values[fluid] = point.psi.dot(facet_values(facet, fluid_));
  values[slips] = point.psi.dot(facet_values(facet, slips_));
  values.segment<3>(traction()) = point.loads.friction;
  values.segment<3>(slip()) = facet_coordinates(facet, slip_) * point.psi;
}

Vector3d FrictionRows::friction_force(const MatrixXd& sums) const {
  return sums.middleRows<3>(traction()).rowwise().sum();
}

FrictionOutput FrictionRows::friction(const MatrixXd& sums, const VectorXd& per_area) const {
  const VectorXd areas = sums.row(area);
  const VectorXd mean = inverse_or_zero(areas);
  FrictionOutput out;
  out.traction = sums.middleRows<3>(traction()) * per_area.asDiagonal();
  out.slip = sums.middleRows<3>(slip()) * mean.asDiagonal();
  out.bound = per_area.cwiseProduct(sums.row(bound).transpose());
  out.fluid = mean.cwiseProduct(sums.row(fluid).transpose());
  out.status = status_of(sums.row(slips), areas);
  return out;
}

void FrictionRows::take_status(FrictionOutput& out) const {
  for (Index node = 0; node < in_contact_.count(); ++node) {
    if (in_contact_[node]) out.status[node] = as_number(slips_[node] > 0 ? Sliding::slips : Sliding::sticks);
  }
}

}  // namespace mixture_contact
