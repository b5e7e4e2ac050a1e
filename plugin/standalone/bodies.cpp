#include "bodies.h"

#include "hexahedron.h"

#include <unsupported/Eigen/AutoDiff>

namespace standalone {
namespace {

/// Derivative of the point forces with respect to the point fields. In rows and columns, the entry of a field is 4 *
/// column + row.
Eigen::Matrix<double, 4 * max_fields, 4 * max_fields> point_tangent(const Material& material, double gas_energy,
                                                                    double dt, const PointHistory& last,
                                                                    const PointFields<double>& q) {
  constexpr int size = 4 * max_fields;
  using Dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, size, 1>>;
  PointFields<Dual> dual;
  for (int i = 0; i < size; ++i) dual(i % 4, i / 4) = Dual(q(i % 4, i / 4), size, i);
  const PointFields<Dual> forces = point_forces<Dual>(material, gas_energy, dt, last, dual);
  Eigen::Matrix<double, size, size> tangent;
  for (int i = 0; i < size; ++i) tangent.row(i) = forces(i % 4, i / 4).derivatives().transpose();
  return tangent;
}

}  // namespace

Bodies::Bodies(const Model& model) : model_(model), gas_energy_(model.gas_constant * model.temperature) {
  for (const Element& element : model.mesh.elements) {
    const auto nodes = number_of(element.nodes);
    Matrix3Xd x(3, nodes);
    for (int a = 0; a < nodes; ++a) x.col(a) = model.mesh.nodes.col(at(element.nodes, a));
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
  MatrixXd fields = MatrixXd::Zero(count_of(nodes), max_fields);
  for (int f = 0; f < material(e).fields(); ++f) fields.col(f) = values(material(e).dof(f), nodes).transpose();
  return fields;
}

std::vector<int> Bodies::places(std::size_t e) const {
  std::vector<int> places;
  for (int f = 0; f < material(e).fields(); ++f) {
    for (const int node : element(e).nodes) places.push_back(model_.place(material(e).dof(f), node));
  }
  return places;
}

VectorXd Bodies::residual(std::size_t e, const MatrixXd& values, double dt) const {
  const MatrixXd nodal = nodal_fields(e, values);
  Eigen::Matrix<double, Eigen::Dynamic, max_fields> sum = MatrixXd::Zero(nodal.rows(), max_fields);
  for (const Point& point : elements_[e]) {
    const PointFields<double> q = point.shape * nodal;
    const auto forces = point_forces<double>(material(e), gas_energy_, dt, point.last, q);
    sum.noalias() += point.shape.transpose() * (forces * point.volume);
  }
  return sum.leftCols(material(e).fields()).reshaped();
}

MatrixXd Bodies::tangent(std::size_t e, const MatrixXd& values, double dt) const {
  const MatrixXd nodal = nodal_fields(e, values);
  const Index nodes = nodal.rows();
  const Index fields = material(e).fields();
  MatrixXd sum = MatrixXd::Zero(fields * nodes, fields * nodes);
  for (const Point& point : elements_[e]) {
    const PointFields<double> q = point.shape * nodal;
    const auto slope = point_tangent(material(e), gas_energy_, dt, point.last, q);
    for (Index g = 0; g < fields; ++g) {
      const Eigen::Matrix<double, 4 * max_fields, Eigen::Dynamic> half = slope.middleCols<4>(4 * g) *
                                                                         (point.shape * point.volume);
      for (Index f = 0; f < fields; ++f) {
        sum.block(f * nodes, g * nodes, nodes, nodes).noalias() += point.shape.transpose() * half.middleRows<4>(4 * f);
      }
    }
  }
  return sum;
}

void Bodies::accept_step(const MatrixXd& values) {
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const MatrixXd nodal = nodal_fields(e, values);
    for (Point& point : elements_[e]) {
      const auto state = point_state<double>(material(e), gas_energy_, point.shape * nodal);
      point.last = {state.volume_ratio, state.content};
    }
  }
}

Bodies::Average Bodies::average(std::size_t e, const MatrixXd& values) const {
  const MatrixXd nodal = nodal_fields(e, values);
  const std::optional<Solute>& solute = material(e).solute;
  Average mean;
  if (material(e).rigid) return mean;
  const double share = 1.0 / static_cast<double>(elements_[e].size());
  for (const Point& point : elements_[e]) {
    const PointFields<double> q = point.shape * nodal;
    const auto state = point_state<double>(material(e), gas_energy_, q);
    mean.pressure += share * state.pressure;
    mean.solvent_flux += share * state.solvent_flux;
    mean.solute_flux += share * state.solute_flux;
    if (solute) mean.concentration += share * solute->solubility * q(0, solute_field);
  }
  return mean;
}

double Bodies::volume(std::size_t e) const {
  double sum = 0;
  for (const Point& point : elements_[e]) sum += point.volume;
  return sum;
}

}  // namespace standalone
