/// Two tied surfaces, with their residual and tangent as a vector and a matrix, for the unit tests.
#pragma once

#include "contact/tie/gap_vector.h"
#include "contact/tie/tie.h"
#include "surfaces.h"

#include <boost/test/unit_test.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <memory>

namespace test {

/// Diagonal entries of unknown multipliers below this value are regularisation: their penalty is 1e8 times the
/// stiffness, while that of broken nodes is the stiffness itself.
inline constexpr double regularisation = 1e-5;

inline constexpr double dt = 0.5;

/// Two surfaces with a gap between them, and their tie, which is made before tests displace the nodes.
struct TiedScene {
  Scene scene;
  std::unique_ptr<Tie> tie;

  TiedScene(FacetType one, FacetType two, double gap, Enforcement enforcement = Enforcement::penalty,
            std::array<int, 2> cells = {2, 3}, const BreakingLaw& law = Unbreakable())
      : scene(facing_grids(one, two, -gap, cells[0], cells[1]), effects_of(true, 1)) {
    scene.settings.enforcement = enforcement;
    scene.settings.search.radius = 0.5;
    scene.settings.traction = {false, 2};
    scene.settings.solvent = {false, 3};
    scene.settings.solute = {false, 5};
    tie = std::make_unique<Tie>(scene.mesh, scene.effects,
                                find_tied_nodes(scene.mesh, scene.effects, scene.settings, scene.position(), law), law);
    tie->set_laws(scene.settings);
  }

  void set_random_multipliers(std::mt19937& random) {
    TieState state = tie->state();
    const auto fill = [&] { return random_vector(1, random)[0]; };
    state.traction = Matrix3Xd::NullaryExpr(3, state.traction.cols(), fill);
    state.flux = MatrixXd::NullaryExpr(state.flux.rows(), state.flux.cols(), fill);
    tie->restore(std::move(state));
  }

  Index nodal_size() const { return 5 * (scene.mesh[Side::primary].nodes + scene.mesh[Side::secondary].nodes); }
  Index size() const { return nodal_size() + tie->unknown_count(); }

  std::vector<Index> entries(const Patch& patch) const {
    const LocalLayout layout = patch.layout();
    std::vector<Index> all(static_cast<std::size_t>(layout.size()));
    for (Index n = 0; n < layout.nodes(); ++n) {
      const Index node = patch.node(n) + (n < patch.primary.count() ? 0 : scene.mesh[Side::primary].nodes);
      for (Index i = 0; layout.has_displacements() && i < 3; ++i) at(all, layout.displacement(n, i)) = 5 * node + i;
      for (Index k = 0; k < layout.scalar_fields(); ++k) at(all, layout.scalar(n, k)) = 5 * node + 3 + patch.fields[k];
    }
    if (!patch.multiplier_node) return all;
    const int own = *patch.multiplier_node;
    for (Index i = 0; layout.has_displacements() && i < 3; ++i)
      at(all, layout.displacement(layout.nodes(), i)) = nodal_size() + tie->unknown(own) + i;
    for (Index k = 0; k < layout.scalar_fields(); ++k)
      at(all, layout.flux_multiplier(k)) = nodal_size() + tie->unknown(own, patch.fields[k]);
    return all;
  }

  VectorXd pack() const {
    VectorXd q(size());
    Index node = 0;
    for (const SurfaceFields& fields : scene.fields) {
      for (Index n = 0; n < fields.position.cols(); ++n, ++node) {
        q.segment<3>(5 * node) = fields.position.col(n);
        q.segment<2>(5 * node + 3) = fields.scalar.row(n).transpose();
      }
    }
    q.tail(tie->unknown_count()) = tie->unknowns();
    return q;
  }

  VectorXd residual(const VectorXd& q) {
    PerSide<SurfaceFields> fields = scene.fields;
    Index node = 0;
    for (SurfaceFields& of_side : fields) {
      for (Index n = 0; n < of_side.position.cols(); ++n, ++node) {
        of_side.position.col(n) = q.segment<3>(5 * node);
        of_side.scalar.row(n) = q.segment<2>(5 * node + 3).transpose();
      }
    }
    if (tie->unknown_count() > 0) tie->set_unknowns(q.tail(tie->unknown_count()));
    VectorXd sum = VectorXd::Zero(size());
    tie->residual(fields, dt, [&](const Patch& patch, const VectorXd& values) { sum(entries(patch)) += values; });
    return sum;
  }

  MatrixXd tangent() {
    MatrixXd sum = MatrixXd::Zero(size(), size());
    tie->tangent(scene.fields, dt, {}, [&](const Patch& patch, const MatrixXd& values) {
      const std::vector<Index> ids = entries(patch);
      sum(ids, ids) += values;
    });
    return sum;
  }
};

/// Central difference of the residual along a direction.
inline VectorXd difference_along(TiedScene& tied, const VectorXd& q, const VectorXd& direction, double step) {
  return (tied.residual(q + step * direction) - tied.residual(q - step * direction)) / (2 * step);
}

/// Compares the tangent with differences along random directions that change all unknowns at once.
inline void check_tangent(TiedScene& tied, std::mt19937& random) {
  const VectorXd q = tied.pack();
  MatrixXd tangent = tied.tangent();
  // The regularisation of the rows of unknown multipliers is not in the residual.
  for (Index n = tied.nodal_size(); n < tied.size(); ++n) {
    if (std::abs(tangent(n, n)) < regularisation) tangent(n, n) = 0;
  }
  const double noise = static_cast<double>(q.size()) * std::numeric_limits<double>::epsilon() *
                       tangent.cwiseAbs().maxCoeff() / difference_step;
  for (int n = 0; n < 4; ++n) {
    const VectorXd direction = VectorXd::NullaryExpr(q.size(), [&] { return random_vector(1, random)[0]; });
    const VectorXd near = difference_along(tied, q, direction, difference_step);
    const double change = (difference_along(tied, q, direction, 2 * difference_step) - near).cwiseAbs().maxCoeff();
    BOOST_TEST((tangent * direction - near).cwiseAbs().maxCoeff() < change + noise);
  }
}

inline void turn_about(SurfaceFields& fields, const Eigen::Matrix3d& rotation) {
  fields.position = rotation * fields.position;
}

/// The moment of the forces on all nodes.
inline Vector3d moment_of(TiedScene& tied) {
  const VectorXd q = tied.pack();
  const VectorXd r = tied.residual(q);
  Vector3d moment = Vector3d::Zero();
  for (Index n = 0; 5 * n < tied.nodal_size(); ++n) {
    const Vector3d arm = q.segment<3>(5 * n);
    moment += arm.cross(Vector3d(r.segment<3>(5 * n)));
  }
  return moment;
}

inline const Eigen::Matrix3d quarter_turn = Eigen::AngleAxisd(0.5 * std::acos(-1.0), Vector3d(1, 2, 3).normalized())
                                                .toRotationMatrix();

}  // namespace test
