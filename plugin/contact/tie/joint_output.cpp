#include "tie/joint_output.h"

namespace mixture_contact {
namespace {

/// Replaces the columns of `own` by the means of both values, weighted with the areas of both.
template <class Values>
void mix(Values& own, const Values& other, const VectorXd& own_area, const VectorXd& other_area) {
  if (own.cols() < own_area.size() || other.cols() < own_area.size()) return;  // one of the contacts has no such values
  for (Index node = 0; node < own_area.size(); ++node) {
    const double area = own_area[node] + other_area[node];
    if (!(area > 0)) continue;
    own.col(node) = (own_area[node] * own.col(node) + other_area[node] * other.col(node)) / area;
  }
}

void mix_row(VectorXd& own, const VectorXd& other, const VectorXd& own_area, const VectorXd& other_area) {
  Eigen::RowVectorXd values = own.transpose();
  mix(values, Eigen::RowVectorXd(other.transpose()), own_area, other_area);
  own = values.transpose();
}

void add(NodalOutput& nodes, const NodalOutput& other) {
  const VectorXd& area = nodes.tributary_area;
  const VectorXd& more = other.tributary_area;
  mix_row(nodes.gap, other.gap, area, more);
  mix_row(nodes.pressure, other.pressure, area, more);
  mix(nodes.flux, other.flux, area, more);
  mix(nodes.jump, other.jump, area, more);
  mix(nodes.friction.traction, other.friction.traction, area, more);
  mix(nodes.friction.slip, other.friction.slip, area, more);
  nodes.friction.bound = other.friction.bound;
  nodes.friction.fluid = other.friction.fluid;
  nodes.friction.status = other.friction.status;
  nodes.tributary_area += more;
}

}  // namespace

InterfaceOutput together(InterfaceOutput tie, const InterfaceOutput& sliding) {
  Balance& balance = tie.balance;
  balance.force += sliding.balance.force;
  balance.area += sliding.balance.area;
  balance.flow += sliding.balance.flow;
  balance.friction += sliding.balance.friction;
  balance.dissipation += sliding.balance.dissipation;
  for (const Side side : both_sides) add(tie.nodes[side], sliding.nodes[side]);
  return tie;
}

}  // namespace mixture_contact
