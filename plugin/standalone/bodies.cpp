#include "bodies.h"

#include "hexahedron.h"

#include <unsupported/Eigen/AutoDiff>

namespace standalone {
namespace {

/// Calls use(number of fields as a compile-time constant).
template <class Use>
auto with_fields(int fields, const Use& use) {
  switch (fields) {
    case 3:
      return use(std::integral_constant<int, 3>());
    case 4:
      return use(std::integral_constant<int, 4>());
    default:
      return use(std::integral_constant<int, 5>());
  }
}

/// Derivative of the point forces with the point fields, entry (4 * column + row) of either.
template <int Fields>
Eigen::Matrix<double, 4 * Fields, 4 * Fields> point_tangent(const Material& material, double gas_energy, double dt,
                                                            const PointHistory& last,
                                                            const PointFields<double, Fields>& q) {
  using Derivatives = Eigen::Matrix<double, 4 * Fields, 1>;
  using Dual = Eigen::AutoDiffScalar<Derivatives>;
  PointFields<Dual, Fields> dual;
  for (int i = 0; i < 4 * Fields; ++i) dual(i % 4, i / 4) = Dual(q(i % 4, i / 4), 4 * Fields, i);
  const PointFields<Dual, Fields> forces = point_forces<Dual, Fields>(material, gas_energy, dt, last, dual);
  Eigen::Matrix<double, 4 * Fields, 4 * Fields> tangent;
  for (int i = 0; i < 4 * Fields; ++i) {
    const Derivatives& row = forces(i % 4, i / 4).derivatives();
    if (row.size() > 0) {
      tangent.row(i) = row.transpose();
    } else {
      tangent.row(i).setZero();
    }
  }
  return tangent;
}

}  // namespace

Bodies::Bodies(const Model& model) : model_(model), gas_energy_(model.gas_constant * model.temperature) {
  for (const Element& element : model.mesh.elements) {
    const auto nodes = static_cast<int>(element.nodes.size());
    Matrix3Xd x(3, nodes);
    for (int a = 0; a < nodes; ++a) x.col(a) = model.mesh.nodes.col(element.nodes[static_cast<std::size_t>(a)]);
    std::vector<Point> points;
    for (const HexahedronPoint& at : hexahedron_rule(nodes)) {
      Eigen::Matrix4Xd shape = hexahedron_shape(nodes, at.xi);
      const Matrix3d jacobian = x * shape.bottomRows<3>().transpose();
      if (!(jacobian.determinant() > 0)) {
        throw InputError(model.file + ", line " + std::to_string(element.line) +
                         ", <elem>: the element is inverted or has no volume");
      }
      shape.bottomRows<3>() = (jacobian.transpose().inverse() * shape.bottomRows<3>()).eval();
      points.push_back({shape, at.weight * jacobian.determinant(), {}});
    }
    elements_.push_back(std::move(points));
  }
}

MatrixXd Bodies::nodal_fields(std::size_t e, const MatrixXd& values) const {
  const std::vector<int>& nodes = element(e).nodes;
  const Material& m = material(e);
  MatrixXd fields(nodes.size(), m.fields());
  for (Index a = 0; a < fields.rows(); ++a) {
    for (int f = 0; f < m.fields(); ++f) fields(a, f) = values(m.dof(f), nodes[static_cast<std::size_t>(a)]);
  }
  return fields;
}

VectorXd Bodies::residual(std::size_t e, const MatrixXd& values, double dt) const {
  const MatrixXd nodal = nodal_fields(e, values);
  return with_fields(material(e).fields(), [&](auto count) -> VectorXd {
    constexpr int fields = decltype(count)::value;
    Eigen::Matrix<double, Eigen::Dynamic, fields> sum = MatrixXd::Zero(nodal.rows(), fields);
    for (const Point& point : elements_[e]) {
      const PointFields<double, fields> q = point.shape * nodal;
      const auto forces = point_forces<double, fields>(material(e), gas_energy_, dt, point.last, q);
      sum.noalias() += point.shape.transpose() * (forces * point.volume);
    }
    return Eigen::Map<const VectorXd>(sum.data(), sum.size());
  });
}

MatrixXd Bodies::tangent(std::size_t e, const MatrixXd& values, double dt) const {
  const MatrixXd nodal = nodal_fields(e, values);
  const Index nodes = nodal.rows();
  return with_fields(material(e).fields(), [&](auto count) -> MatrixXd {
    constexpr int fields = decltype(count)::value;
    MatrixXd sum = MatrixXd::Zero(fields * nodes, fields * nodes);
    for (const Point& point : elements_[e]) {
      const PointFields<double, fields> q = point.shape * nodal;
      const auto slope = point_tangent<fields>(material(e), gas_energy_, dt, point.last, q);
      for (int g = 0; g < fields; ++g) {
        const Eigen::Matrix<double, 4 * fields, Eigen::Dynamic> half = slope.template middleCols<4>(4 * g) *
                                                                       (point.shape * point.volume);
        for (int f = 0; f < fields; ++f) {
          sum.block(f * nodes, g * nodes, nodes, nodes).noalias() += point.shape.transpose() *
                                                                     half.template middleRows<4>(4 * f);
        }
      }
    }
    return sum;
  });
}

void Bodies::accept_step(const MatrixXd& values) {
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    if (!material(e).porous) continue;
    const MatrixXd nodal = nodal_fields(e, values);
    with_fields(material(e).fields(), [&](auto count) {
      constexpr int fields = decltype(count)::value;
      for (Point& point : elements_[e]) {
        const PointFields<double, fields> q = point.shape * nodal;
        const auto state = point_state<double, fields>(material(e), gas_energy_, q);
        point.last = {state.volume_ratio, state.content};
      }
    });
  }
}

Bodies::Average Bodies::average(std::size_t e, const MatrixXd& values) const {
  const MatrixXd nodal = nodal_fields(e, values);
  const Material& m = material(e);
  return with_fields(m.fields(), [&](auto count) {
    constexpr int fields = decltype(count)::value;
    constexpr int solutes = solutes_of(fields);
    Average mean{{0, 0, 0}, Matrix3d::Zero(), Matrix3Xd::Zero(3, solutes), VectorXd::Zero(solutes), 0};
    if (m.rigid) return mean;
    const double share = 1.0 / static_cast<double>(elements_[e].size());
    for (const Point& point : elements_[e]) {
      const PointFields<double, fields> q = point.shape * nodal;
      const auto state = point_state<double, fields>(m, gas_energy_, q);
      if constexpr (fields > 3) {
        mean.solvent_flux += share * state.solvent_flux;
        mean.pressure += share * q(0, pressure_dof);
        for (int k = 0; k < solutes; ++k) {
          const double actual = m.solutes[static_cast<std::size_t>(k)].solubility * q(0, 4 + k);
          mean.solute_flux.col(k) += share * state.solute_flux.col(k);
          mean.concentration[k] += share * actual;
          mean.pressure += share * gas_energy_ * m.osmotic * actual;
        }
      }
      mean.stress += share / state.volume_ratio * state.stress * state.deformation.transpose();
    }
    return mean;
  });
}

double Bodies::volume(std::size_t e) const {
  double sum = 0;
  for (const Point& point : elements_[e]) sum += point.volume;
  return sum;
}

}  // namespace standalone
