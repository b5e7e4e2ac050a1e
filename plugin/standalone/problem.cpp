#include "problem.h"

#include "contact/quadrature.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <map>

namespace standalone {

using mixture_contact::both_sides;

namespace {

/// Concentrations below this part of the largest one, and reactions likewise, do not decide what is clamped.
constexpr double negligible = 1e-6;

std::vector<Contact> contacts_of(const Model& model, const Bodies& bodies) {
  std::vector<Contact> contacts;
  int row = model.dofs();
  for (const ContactDefinition& definition : model.contacts) {
    contacts.emplace_back(model, definition, bodies, row);
    row += contacts.back().multiplier_rows();
  }
  return contacts;
}

/// Nodal forces, shape (dofs, nodes), of a unit load on the reference surface: of a pressure of 1 MPa, INT -N_a n dA
/// [N], or of an outward solvent flux of 1 mm/s, INT N_a dA on the rows of p~ [mm^3/s].
MatrixXd unit_forces(const Model& model, const SurfaceLoad& load) {
  using namespace mixture_contact;
  MatrixXd forces = MatrixXd::Zero(model.dofs(), model.mesh.nodes.cols());
  for (const SurfaceFacet& facet : load.facets) {
    const FacetType type = facet.facet.type;
    const FacetCoordinates x = facet_coordinates(facet.facet, model.mesh.nodes);
    for (const QuadraturePoint& point : quadrature(type, default_quadrature_order(type))) {
      const ShapeFunctions shape = shape_functions(type, point.xi);
      const Eigen::Matrix<double, 3, 2> tangents = x * shape.gradient;
      const Vector3d area = point.weight * tangents.col(0).cross(tangents.col(1));
      for (int a = 0; a < node_count(type); ++a) {
        const int node = facet.facet.nodes[static_cast<std::size_t>(a)];
        if (load.fluid) {
          forces(pressure_dof, node) += shape.value[a] * area.norm();
        } else {
          forces.col(node).head<3>() -= shape.value[a] * area;
        }
      }
    }
  }
  return forces;
}

/// The unknown multipliers of all contacts.
std::vector<Equations::Unknown> multipliers(const std::vector<Contact>& contacts) {
  std::vector<Equations::Unknown> all;
  for (const Contact& contact : contacts) {
    const Contact::Dofs own = contact.multipliers();
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

}  // namespace

Problem::Problem(const Model& model)
    : model_(model), bodies_(model), contacts_(contacts_of(model, bodies_)), equations_(model, multipliers(contacts_)) {
  for (const Element& element : model.mesh.elements)
    element_numbers_.push_back(equations_.of_element(element, model.material(element)));
  for (const SurfaceLoad& load : model.loads) unit_forces_.push_back(unit_forces(model, load));
  state_.values = MatrixXd::Zero(equations_.rows(), model.mesh.nodes.cols());
  for (const Condition& condition : model.initial) {
    for (const int node : condition.nodes) state_.values(condition.dof, node) = condition.value.value;
  }
  state_.solution.resize(equations_.free());
  for (int i = 0; i < equations_.free(); ++i) state_.solution[i] = value(i);
  state_.hold.assign(static_cast<std::size_t>(equations_.free()), Hold::none);
  target_ = VectorXd::Zero(equations_.size() - equations_.free());
  forces_ = VectorXd::Zero(equations_.size());
  for (const Condition& condition : model.prescribed) {
    for (const int node : condition.nodes) {
      if (condition.reaction) reported_.insert(equations_.number(condition.dof, node));
    }
  }
  accept_step();
  for (Contact& contact : contacts_) {
    contact.update_properties(state_.values);
    contact.project(state_.values, false);
  }
}

Matrix3Xd Problem::reactions() const {
  Matrix3Xd all = Matrix3Xd::Zero(3, model_.mesh.nodes.cols());
  for (const int number : reported_) {
    if (number >= 0 && equations_.dof(number) < 3)
      all(equations_.dof(number), equations_.node(number)) = forces_[number];
  }
  return all;
}

void Problem::start_step(double time, double dt) {
  time_ = time;
  dt_ = dt;
  for (const Condition& condition : model_.prescribed) {
    for (const int node : condition.nodes) {
      const int number = equations_.number(condition.dof, node);
      if (number >= 0) target_[number - equations_.free()] = condition.value.at(time, model_.curves);
    }
  }
  for (Contact& contact : contacts_) {
    if (reads_properties_again(contact.definition().parameters)) contact.update_properties(state_.values);
  }
  end_iterations();
}

// ----------------------------------------------------------------------------------------------------------------
// contact status

void Problem::end_iterations() {
  for (Contact& contact : contacts_) contact.core().end_iterations();
  for (int i = 0; i < equations_.free(); ++i) {
    if (hold(i) == Hold::clamp) release(i);
  }
  freed_.clear();
  tried_ = false;
}

bool Problem::begin_iteration() {
  bool changed = false;
  for (Contact& contact : contacts_) {
    const bool contact_changed = contact.begin_iteration(state_.values);
    changed = changed || contact_changed;
  }
  const bool ambient_changed = switch_ambient();
  const bool clamps_changed = tried_ && clamp_concentrations();
  return changed || ambient_changed || clamps_changed;
}

std::vector<bool> Problem::held() const {
  std::vector<bool> all;
  all.reserve(state_.hold.size());
  for (const Hold hold : state_.hold) all.push_back(hold != Hold::none);
  return all;
}

void Problem::release(int equation) {
  hold(equation) = Hold::none;
  state_.solution[equation] = value(equation);
}

Problem::ClampChanges Problem::clamp_changes() const {
  ClampChanges changes;
  if (!model_.control.clamp) return changes;
  const VectorXd largest = state_.values.cwiseAbs().rowwise().maxCoeff();
  // The force on a concentration is what leaves the node less what it stores: negative where solute comes in.
  VectorXd largest_force = VectorXd::Zero(equations_.rows());
  for (int i = 0; i < equations_.free(); ++i) {
    double& most = largest_force[equations_.dof(i)];
    if (hold(i) == Hold::clamp) most = std::max(most, std::abs(forces_[i]));
  }
  for (int i = 0; i < equations_.free(); ++i) {
    const int dof = equations_.dof(i);
    if (!is_concentration(dof)) continue;
    if (hold(i) == Hold::none && state_.solution[i] < -negligible * largest[dof]) changes.hold.push_back(i);
    const bool rises = hold(i) == Hold::clamp && -forces_[i] > negligible * largest_force[dof];
    if (rises && freed_.count(i) == 0) changes.free.push_back(i);
  }
  return changes;
}

bool Problem::clamps_settled() const {
  const ClampChanges changes = clamp_changes();
  return changes.hold.empty() && changes.free.empty();
}

bool Problem::clamp_concentrations() {
  const ClampChanges changes = clamp_changes();
  for (const int equation : changes.free) release(equation);
  freed_.insert(changes.free.begin(), changes.free.end());
  for (const int equation : changes.hold) {
    hold(equation) = Hold::clamp;
    value(equation) = 0;
  }
  return !changes.hold.empty() || !changes.free.empty();
}

double Problem::ambient_value(const ContactDefinition& contact, int dof) const {
  if (dof == pressure_dof) return contact.ambient_pressure.at(time_, model_.curves);
  const auto entry = contact.ambient_concentration.find(dof - concentration_dof(0));
  return entry == contact.ambient_concentration.end() ? 0.0 : entry->second.at(time_, model_.curves);
}

bool Problem::switch_ambient() {
  // A node is at ambient only where no contact has it; the first contact that it belongs to says what its bath is.
  struct NodeStatus {
    bool in_contact;
    const ContactDefinition* bath;
  };
  std::map<int, NodeStatus> nodes;
  for (Contact& contact : contacts_) {
    const auto in_contact = contact.core().nodes_in_contact();
    for (const auto side : both_sides) {
      for (std::size_t i = 0; i < contact.nodes(side).size(); ++i) {
        NodeStatus& status = nodes.insert({contact.nodes(side)[i], {false, &contact.definition()}}).first->second;
        status.in_contact = status.in_contact || in_contact[side][i];
      }
    }
  }
  bool changed = false;
  for (const auto& [node, status] : nodes) {
    for (int dof = pressure_dof; dof < model_.dofs(); ++dof) {
      const int equation = equations_.number(dof, node);
      if (equation < 0 || equation >= equations_.free()) continue;
      const bool switched = set_ambient(equation, status.in_contact, ambient_value(*status.bath, dof));
      changed = changed || switched;
    }
  }
  return changed;
}

bool Problem::set_ambient(int equation, bool in_contact, double bath) {
  const bool was_ambient = hold(equation) == Hold::ambient;
  if (in_contact) {
    if (was_ambient) release(equation);
    return was_ambient;
  }
  const bool changed = !was_ambient || value(equation) != bath;
  hold(equation) = Hold::ambient;
  value(equation) = bath;
  return changed;
}

// -----------------------------------------------------------------------------------------------------------
// evaluations

void Problem::set_trial(const VectorXd& trial, int iteration) {
  tried_ = true;
  const VectorXd solution = state_.solution + trial;
  for (int i = 0; i < equations_.free(); ++i) {
    if (hold(i) != Hold::none) continue;
    const bool clamped = model_.control.clamp && is_concentration(equations_.dof(i)) && solution[i] < 0;
    value(i) = clamped ? 0.0 : solution[i];
  }
  for (int k = 0; k < target_.size(); ++k) value(equations_.free() + k) = target_[k];
  for (Contact& contact : contacts_) {
    const int seg_up = contact.definition().parameters.seg_up;
    contact.take_multipliers(state_.values);
    contact.project(state_.values, seg_up > 0 && iteration > seg_up);
  }
}

std::vector<int> Problem::numbers(const Contact::Dofs& dofs) const {
  std::vector<int> list;
  for (const auto& [dof, node] : dofs) list.push_back(equations_.number(dof, node));
  return list;
}

VectorXd Problem::residual() {
  forces_.setZero();
  const auto add = [&](const std::vector<int>& numbers, const VectorXd& local) {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (numbers[i] >= 0) forces_[numbers[i]] += local[static_cast<Index>(i)];
    }
  };
  for (std::size_t e = 0; e < element_numbers_.size(); ++e) {
    if (!element_numbers_[e].empty()) add(element_numbers_[e], -bodies_.residual(e, state_.values, dt_));
  }
  for (const Contact& contact : contacts_) {
    contact.for_each_residual(state_.values, dt_,
                              [&](const Contact::Dofs& rows, const VectorXd& local) { add(numbers(rows), local); });
  }
  for (std::size_t k = 0; k < unit_forces_.size(); ++k) {
    const SurfaceLoad& load = model_.loads[k];
    const double size = load.value.at(time_, model_.curves) * (load.fluid ? dt_ : 1.0);
    for (int i = 0; i < equations_.size(); ++i) {
      if (equations_.dof(i) < model_.dofs())
        forces_[i] += size * unit_forces_[k](equations_.dof(i), equations_.node(i));
    }
  }
  if (!forces_.allFinite()) throw StepFailure("a residual is not a finite number");
  VectorXd free = forces_.head(equations_.free());
  for (int i = 0; i < equations_.free(); ++i) {
    if (hold(i) != Hold::none) free[i] = 0;
  }
  return free;
}

void Problem::assemble(LinearSystem& system) const {
  system.clear();
  for (std::size_t e = 0; e < element_numbers_.size(); ++e) {
    if (!element_numbers_[e].empty()) system.add_element(e, bodies_.tangent(e, state_.values, dt_));
  }
  const auto add = [&](const Contact::Dofs& rows, const Contact::Dofs& columns, const MatrixXd& tangent) {
    system.add(numbers(rows), numbers(columns), -tangent);
  };
  for (const Contact& contact : contacts_) contact.for_each_tangent(state_.values, dt_, add);
}

VectorXd Problem::pending() const {
  VectorXd changes = target_;
  for (int k = 0; k < changes.size(); ++k) changes[k] -= value(equations_.free() + k);
  return changes;
}

Problem::State Problem::save() {
  State state = state_;
  for (Contact& contact : contacts_) state.contacts.push_back(contact.save());
  return state;
}

void Problem::restore(const State& state) {
  state_ = state;
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    contacts_[k].restore(state.contacts[k]);
    contacts_[k].project(state_.values, false);
  }
  state_.contacts.clear();
}

}  // namespace standalone
