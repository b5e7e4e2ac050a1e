#include "contact/geometry/rigid_motion.h"

#include "surfaces.h"

#include <boost/test/unit_test.hpp>

using namespace test;

namespace {

/// Three nodes, of which the second is deformable, and a body that turns about an axis and moves.
struct Turned {
  Matrix3Xd before = Matrix3Xd(3, 3);
  Matrix3Xd after;
  RigidParts from;
  RigidParts to;

  explicit Turned(double angle, const Vector3d& displacement = {0.3, -0.1, 0.2}) {
    before << 1, 0.5, -0.2, 0, 0.1, 0.7, 0.4, -0.3, 0.6;
    const Eigen::Quaterniond start(Eigen::AngleAxisd(0.4, Vector3d(1, 2, 3).normalized()));
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle, Vector3d(2, -1, 1).normalized()));
    const Vector3d centre(0.1, 0.2, -0.4);
    from = {{{centre, start}}, {0, -1, 0}};
    to = {{{centre + displacement, turn * start}}, {0, -1, 0}};
    after = before;
    for (const Index node : {0, 2}) after.col(node) = centre + displacement + turn * (before.col(node) - centre);
    after.col(1) += Vector3d(1, 2, 3);
  }

  Matrix3Xd beyond() const { return beyond_linear(from, to, before, after); }
};

}  // namespace

BOOST_AUTO_TEST_CASE(a_body_that_does_not_turn_moves_linearly) {
  BOOST_TEST(Turned(0).beyond().size() == 0);
  BOOST_TEST(beyond_linear({}, {}, Matrix3Xd::Zero(3, 2), Matrix3Xd::Ones(3, 2)).size() == 0);
}

BOOST_AUTO_TEST_CASE(the_motion_beyond_the_linear_one_is_of_second_order_in_the_rotation) {
  // With the axis a and the arm r, x - linear = (1 - cos t) a x (a x r) + (sin t - t) a x r. The second term over t^2
  // is t/6 |r| at most, and so is the deviation of (1 - cos t)/t^2 from a half.
  const Turned turned(0.1);
  const Vector3d axis = Vector3d(2, -1, 1).normalized();
  for (const double angle : {0.1, 0.01}) {
    const Matrix3Xd beyond = Turned(angle).beyond();
    BOOST_TEST(beyond.col(1).isZero(0));
    for (const Index node : {0, 2}) {
      const Vector3d arm = turned.before.col(node) - turned.from.poses[0].centre;
      const Vector3d second = 0.5 * axis.cross(axis.cross(arm));
      BOOST_TEST((beyond.col(node) / (angle * angle) - second).norm() <= angle / 3 * arm.norm());
      BOOST_TEST(second.norm() > angle * arm.norm());
    }
  }
}
