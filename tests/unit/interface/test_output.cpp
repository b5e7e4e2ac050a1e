/// Values at nodes and balances: flat pairs say by moments what their points would.
#include "surfaces.h"

#include <boost/test/unit_test.hpp>

using namespace test;

namespace {

Settings on_segments() {
  Settings settings;
  settings.integration = Integration::segments;
  return settings;
}

/// Two flat surfaces of triangles on each other, not quite parallel, that exchange the solvent and a solute.
struct FlatScene : Scene {
  FlatScene() : Scene(facing_grids(FacetType::tri3, FacetType::tri3, 0.05, 3, 4), effects_of(true, 1), on_segments()) {
    std::mt19937 random(3);
    fields[Side::secondary].position.row(2) += random_values(mesh[Side::secondary].nodes, -0.02, 0.02, random);
    for (SurfaceFields& field : fields)
      field.scalar = MatrixXd::NullaryExpr(field.scalar.rows(), field.scalar.cols(),
                                           [&] { return random_vector(1, random)[0]; });
  }
};

/// Averages over the points in contact around the nodes of one side, as a point's shape function weighs them, and what
/// acts on the primary surface in all.
struct PointSums {
  VectorXd area;
  VectorXd gap;
  VectorXd pressure;
  MatrixXd flux;
  MatrixXd jump;
  Vector3d force{0, 0, 0};
  VectorXd flow;

  PointSums(const Scene& scene, const ContactPass& pass, Side side) {
    const Index nodes = scene.mesh[side].nodes;
    const Index fields = scene.effects.scalar_fields();
    area = gap = pressure = VectorXd::Zero(nodes);
    flux = jump = MatrixXd::Zero(fields, nodes);
    flow = VectorXd::Zero(fields);
    const NodalLoads loads = pass.nodal_loads(seen_from(Side::primary, scene.fields));
    for (const FacetPair& pair : pass.pairs()) {
      BOOST_TEST_REQUIRE(pass.space().flat(pair).has_value());
      for (const IntegrationPoint& point : pass.space().facing().points(pair))
        add(scene, pass, loads, pair, point, side);
    }
    gap.array() /= area.array();
    pressure.array() /= area.array();
    flux = flux * area.cwiseInverse().asDiagonal();
    jump = jump * area.cwiseInverse().asDiagonal();
  }

 private:
  void add(const Scene& scene, const ContactPass& pass, const NodalLoads& loads, const FacetPair& pair,
           const IntegrationPoint& point, Side side) {
    const double sign = side == Side::primary ? 1 : -1;
    const Facet& one = pass.space().facing().primary_facet(pair);
    const Facet& two = pass.space().facing().secondary_facet(pair);
    const PointKinematics at = point_kinematics(
        shape_functions(one.type, point.xi), facet_coordinates(one, scene.fields[Side::primary].position),
        shape_functions(two.type, point.eta), facet_coordinates(two, scene.fields[Side::secondary].position));
    const FacetVector psi = pass.space().shape(pair.primary, point.sub_facet, point.xi).value;
    const double traction = psi.dot(facet_values(one, loads.traction));
    const Facet& own = side == Side::primary ? one : two;
    const FacetVector share = point.weight * at.area * (side == Side::primary ? at.primary_shape : at.secondary_shape);
    for (Index a = 0; a < own.count(); ++a) {
      area[own.node(a)] += share[a];
      gap[own.node(a)] += share[a] * at.gap;
      pressure[own.node(a)] -= share[a] * traction;
    }
    force += point.weight * traction * at.area_vector;
    for (Index field = 0; field < flow.size(); ++field) {
      const double here = psi.dot(facet_values(one, loads.flux.row(field).transpose()));
      const double apart = at.primary_shape.dot(facet_values(one, scene.fields[Side::primary].scalar.col(field))) -
                           at.secondary_shape.dot(facet_values(two, scene.fields[Side::secondary].scalar.col(field)));
      flow[field] += point.weight * at.area * here;
      for (Index a = 0; a < own.count(); ++a) {
        flux(field, own.node(a)) += sign * share[a] * here;
        jump(field, own.node(a)) += sign * share[a] * apart;
      }
    }
  }
};

/// A sum of so many terms of the size of the largest entry.
template <class Values>
void check_equal(const Values& one, const Values& two) {
  const double terms = 1000;
  BOOST_TEST((one - two).cwiseAbs().maxCoeff() <=
             terms * std::numeric_limits<double>::epsilon() * two.cwiseAbs().maxCoeff());
}

}  // namespace

BOOST_AUTO_TEST_CASE(flat_pairs_put_out_what_their_points_would) {
  const FlatScene scene;
  const auto contact = scene.contact();
  const InterfaceOutput said = output(*contact, scene.fields);
  for (const Side side : both_sides) {
    const PointSums expected(scene, contact->pass(0), side);
    const NodalOutput& out = said.nodes[side];
    check_equal(out.tributary_area, expected.area);
    check_equal(out.gap, expected.gap);
    check_equal(out.pressure, expected.pressure);
    check_equal(out.flux, expected.flux);
    check_equal(out.jump, expected.jump);
    BOOST_TEST(expected.pressure.minCoeff() < expected.pressure.maxCoeff());
    check_equal(said.balance.force, expected.force);
    check_equal(said.balance.flow, expected.flow);
  }
}
