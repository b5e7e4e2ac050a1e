#include "contact/tie/tie_output.h"

#include "contact/tie/gap_vector.h"
#include "surfaces.h"

#include <boost/test/unit_test.hpp>

#include <array>
#include <limits>

using namespace test;

namespace {

constexpr double dt = 0.5;

/// Two surfaces with a gap between them, whose nodes are then displaced at random.
struct TiedScene {
  Scene scene;
  std::unique_ptr<Tie> tie;

  TiedScene(FacetType one, FacetType two, double gap, Enforcement enforcement = Enforcement::penalty,
            std::array<int, 2> cells = {2, 3})
      : scene(facing_grids(one, two, -gap, cells[0], cells[1]), effects_of(true, 1)) {
    scene.settings.enforcement = enforcement;
    scene.settings.search.radius = 0.5;
    scene.settings.traction = {false, 2};
    scene.settings.solvent = {false, 3};
    scene.settings.solute = {false, 5};
    tie = std::make_unique<Tie>(scene.mesh, scene.effects,
                                find_tied_nodes(scene.mesh, scene.effects, scene.settings, scene.position()));
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
    tie->tangent(scene.fields, dt, [&](const Patch& patch, const MatrixXd& values) {
      const std::vector<Index> ids = entries(patch);
      sum(ids, ids) += values;
    });
    // What regularises the rows of unknown multipliers belongs to no residual.
    sum.bottomRightCorner(tie->unknown_count(), tie->unknown_count()).setZero();
    return sum;
  }
};

/// Central difference of the residual along a direction.
VectorXd difference_along(TiedScene& tied, const VectorXd& q, const VectorXd& direction, double step) {
  return (tied.residual(q + step * direction) - tied.residual(q - step * direction)) / (2 * step);
}

/// Compares the tangent with differences along directions that move all unknowns at once, so that each entry counts.
void check_tangent(TiedScene& tied, std::mt19937& random) {
  const VectorXd q = tied.pack();
  const MatrixXd tangent = tied.tangent();
  const double rounding = static_cast<double>(q.size()) * std::numeric_limits<double>::epsilon() *
                          tangent.cwiseAbs().maxCoeff() / difference_step;
  for (int n = 0; n < 4; ++n) {
    const VectorXd direction = VectorXd::NullaryExpr(q.size(), [&] { return random_vector(1, random)[0]; });
    const VectorXd near = difference_along(tied, q, direction, difference_step);
    const double change = (difference_along(tied, q, direction, 2 * difference_step) - near).cwiseAbs().maxCoeff();
    BOOST_TEST((tangent * direction - near).cwiseAbs().maxCoeff() < change + rounding);
  }
}

void turn_about(SurfaceFields& fields, const Eigen::Matrix3d& rotation) {
  fields.position = rotation * fields.position;
}

/// Moment of the forces on all nodes.
Vector3d moment_of(TiedScene& tied) {
  const VectorXd q = tied.pack();
  const VectorXd r = tied.residual(q);
  Vector3d moment = Vector3d::Zero();
  for (Index n = 0; 5 * n < tied.nodal_size(); ++n) {
    const Vector3d arm = q.segment<3>(5 * n);
    moment += arm.cross(Vector3d(r.segment<3>(5 * n)));
  }
  return moment;
}

const Eigen::Matrix3d quarter_turn = Eigen::AngleAxisd(0.5 * std::acos(-1.0), Vector3d(1, 2, 3).normalized())
                                         .toRotationMatrix();

}  // namespace

// Central differences miss the derivative by h^2/6 of the third one. The third derivative of this residual is that of
// the differences, four times as much at 2h: their change is three times the error at h. Rounding adds that of a sum
// over h.
BOOST_AUTO_TEST_CASE(the_tangent_is_the_derivative_of_the_residual) {
  for (const auto& [one, two] : facet_pairs()) {
    for (const Enforcement enforcement : {Enforcement::penalty, Enforcement::lagrange_multipliers}) {
      for (const double gap : {0.0, 0.1}) {
        std::mt19937 random(7);
        TiedScene tied(one, two, gap, enforcement, {1, 1});
        tied.scene.disturb(0.02, random);
        tied.set_random_multipliers(random);
        check_tangent(tied, random);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(the_tangent_is_symmetric) {
  std::mt19937 random(5);
  for (const Enforcement enforcement : {Enforcement::penalty, Enforcement::lagrange_multipliers}) {
    TiedScene tied(FacetType::quad4, FacetType::tri6, 0.1, enforcement);
    tied.scene.disturb(0.02, random);
    tied.set_random_multipliers(random);
    const MatrixXd tangent = tied.tangent();
    BOOST_TEST((tangent - tangent.transpose()).cwiseAbs().maxCoeff() <= 1e-14 * tangent.cwiseAbs().maxCoeff());
  }
}

BOOST_AUTO_TEST_CASE(a_rigid_turn_loads_nothing_with_a_gap_that_is_kept_and_without) {
  for (const auto& [one, two] : facet_pairs()) {
    for (const double gap : {0.0, 0.1, -0.05}) {
      TiedScene tied(one, two, gap);
      for (SurfaceFields& fields : tied.scene.fields) turn_about(fields, quarter_turn);
      BOOST_TEST(tied.tie->loads(tied.scene.fields).traction.cwiseAbs().maxCoeff() < 1e-13);
    }
  }
}

BOOST_AUTO_TEST_CASE(forces_and_moments_of_both_sides_cancel) {
  for (const double gap : {0.0, 0.1}) {
    std::mt19937 random(3);
    TiedScene tied(FacetType::quad8, FacetType::tri3, gap);
    tied.scene.disturb(0.05, random);
    const VectorXd r = tied.residual(tied.pack());
    Vector3d force = Vector3d::Zero();
    for (Index n = 0; 5 * n < tied.nodal_size(); ++n) force += r.segment<3>(5 * n);
    BOOST_TEST(force.norm() < 1e-13);
    BOOST_TEST(moment_of(tied).norm() < 1e-13);
    BOOST_TEST(r.cwiseAbs().maxCoeff() > 1e-4);
  }
}

BOOST_AUTO_TEST_CASE(linear_fields_have_no_jump_and_uniform_ones_no_weight) {
  for (const auto& [one, two] : facet_pairs()) {
    TiedScene tied(one, two, 0);
    for (SurfaceFields& fields : tied.scene.fields) {
      fields.scalar.col(0) = fields.position.transpose() * Vector3d(1, 2, 3);
      fields.scalar.col(1).setConstant(4);
    }
    const TieLoads loads = tied.tie->loads(tied.scene.fields);
    BOOST_TEST(loads.jump.cwiseAbs().maxCoeff() < 1e-13);
    BOOST_TEST(loads.gap.cwiseAbs().maxCoeff() < 1e-13);
  }
}

BOOST_AUTO_TEST_CASE(the_areas_of_tied_nodes_are_that_of_what_faces_the_other_surface) {
  TiedScene tied(FacetType::quad4, FacetType::tri3, 0.1);
  double area = 0;
  for (const TiedNode& node : tied.tie->nodes()) {
    area += node.traction.area;
    BOOST_TEST(std::abs(node.traction.weights.sum()) < 1e-14);
    BOOST_TEST(std::abs(node.secondary_shares.sum() - 1) < 1e-14);
  }
  BOOST_TEST(std::abs(area - 1) < 1e-13);
}

BOOST_AUTO_TEST_CASE(multipliers_that_are_unknowns_come_back_as_they_were_set) {
  std::mt19937 random(1);
  TiedScene tied(FacetType::quad4, FacetType::quad4, 0, Enforcement::lagrange_multipliers);
  tied.set_random_multipliers(random);
  const TieState before = tied.tie->state();
  tied.tie->set_unknowns(tied.tie->unknowns());
  BOOST_TEST((tied.tie->state().traction - before.traction).cwiseAbs().maxCoeff() < 1e-14);
  BOOST_TEST((tied.tie->state().flux - before.flux).cwiseAbs().maxCoeff() < 1e-14);
}

BOOST_AUTO_TEST_CASE(an_augmentation_takes_the_loads_up_and_has_slow_penalties_grow) {
  std::mt19937 random(2);
  TiedScene tied(FacetType::quad4, FacetType::quad4, 0, Enforcement::augmented_lagrangian);
  tied.scene.disturb(0.05, random);
  const TieLoads loads = tied.tie->loads(tied.scene.fields);
  BOOST_TEST(tied.tie->augment(tied.scene.fields));
  BOOST_TEST((tied.tie->state().traction == loads.traction));
  BOOST_TEST((tied.tie->state().flux == loads.flux));
  BOOST_TEST(tied.tie->state().traction_penalty_scale == 10.0);
}

BOOST_AUTO_TEST_CASE(nodes_beyond_the_search_radius_are_counted_with_their_distance) {
  Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, -0.3), effects_of(false, 0));
  scene.settings.search.radius = 0.2;
  const IndexedVector<TiedNode> none = find_tied_nodes(scene.mesh, scene.effects, scene.settings, scene.position());
  BOOST_TEST(none.empty());
  const UntiedNodes untied = untied_nodes(none, scene.mesh, scene.settings, scene.position());
  BOOST_TEST(untied.too_far == scene.mesh[Side::primary].nodes);
  BOOST_TEST(std::abs(untied.largest_distance - 0.3) < 1e-14);
}

BOOST_AUTO_TEST_CASE(relocated_nodes_touch_the_other_surface) {
  TiedScene tied(FacetType::quad4, FacetType::quad4, 0.1);
  const Matrix3Xd moved = without_gaps(tied.tie->nodes(), tied.scene.mesh, tied.scene.settings, tied.scene.position());
  BOOST_TEST((moved.row(2).array() - 0.1).abs().maxCoeff() < 1e-14);
}

BOOST_AUTO_TEST_CASE(the_output_balances_and_has_tension_as_a_negative_pressure) {
  TiedScene tied(FacetType::quad4, FacetType::quad4, 0);
  tied.scene.fields[Side::secondary].position.row(2).array() += 0.25;
  const InterfaceOutput out = output(*tied.tie, tied.scene.fields);
  BOOST_TEST((out.balance.force - Vector3d(0, 0, 0.5)).norm() < 1e-13);
  BOOST_TEST(std::abs(out.balance.area - 1) < 1e-13);
  for (const NodalOutput& nodes : out.nodes) {
    BOOST_TEST((nodes.pressure.array() + 0.5).abs().maxCoeff() < 1e-13);
    BOOST_TEST((nodes.gap.array() - 0.25).abs().maxCoeff() < 1e-13);
    BOOST_TEST(std::abs(nodes.tributary_area.sum() - 1) < 1e-13);
  }
}
