#include "problem.h"

#include "loads.h"

#include <algorithm>
#include <map>

namespace standalone {

using mixture_contact::both_sides;

Problem::Problem(const Model& model) : model_(model), equations_(model), bodies_(model) {
  contacts_.reserve(model.contacts.size());
  for (const ContactDefinition& definition : model.contacts) contacts_.emplace_back(model, definition, bodies_);
  for (const SurfaceLoad& load : model.loads) unit_forces_.push_back(unit_forces(model, load));
  state_.values = MatrixXd::Zero(model.dofs(), model.mesh.nodes.cols());
  for (const Condition& condition : model.initial) {
    for (const int node : condition.nodes) state_.values(condition.dof, node) = condition.value.value;
  }
  target_ = state_.values;
  pending_ = reactions_ = MatrixXd::Zero(model.dofs(), model.mesh.nodes.cols());
  state_.total.resize(equations_.count());
  for (int i = 0; i < equations_.count(); ++i) state_.total[i] = state_.values(equations_.dof(i), equations_.node(i));
  state_.increment = VectorXd::Zero(equations_.count());
  state_.ambient.assign(static_cast<std::size_t>(equations_.count()), false);
  bodies_.accept_step(state_.values);
  for (Contact& contact : contacts_) {
    contact.update_properties(state_.values);
    contact.project(state_.values, false);
  }
}

LinearSystem Problem::linear_system() const {
  std::vector<std::vector<int>> numbers;
  for (std::size_t e = 0; e < bodies_.elements(); ++e) {
    const Material& material = bodies_.material(e);
    numbers.push_back(material.rigid ? std::vector<int>() : equations_.of_element(bodies_.element(e), material));
  }
  return {equations_.count(), std::move(numbers)};
}

void Problem::start_step(double time, double dt) {
  time_ = time;
  dt_ = dt;
  state_.increment.setZero();
  for (const Condition& condition : model_.prescribed) {
    const double value = condition.value.at(time, model_.curves);
    for (const int node : condition.nodes) {
      if (equations_.number(condition.dof, node) != Equations::prescribed) continue;
      target_(condition.dof, node) = value;
      pending_(condition.dof, node) = value - state_.values(condition.dof, node);
    }
  }
  for (Contact& contact : contacts_) contact.core().end_iterations();
  begin_iteration();
  for (Contact& contact : contacts_) {
    if (contact.definition().parameters.update_penalty) contact.update_properties(state_.values);
  }
}

void Problem::accept_step() {
  state_.total += state_.increment;
  state_.increment.setZero();
  bodies_.accept_step(state_.values);
}

// ----------------------------------------------------------------------------------------------------------------
// contact status

bool Problem::begin_iteration() {
  bool changed = false;
  for (Contact& contact : contacts_) {
    const bool contact_changed = contact.begin_iteration(state_.values);
    changed = changed || contact_changed;
  }
  return switch_ambient() || changed;
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
      if (equation < 0) continue;
      const bool switched = set_ambient(equation, status.in_contact, ambient_value(*status.bath, dof));
      changed = changed || switched;
    }
  }
  return changed;
}

bool Problem::set_ambient(int equation, bool in_contact, double value) {
  const auto i = static_cast<std::size_t>(equation);
  double& current = state_.values(equations_.dof(equation), equations_.node(equation));
  const bool was_ambient = state_.ambient[i];
  state_.ambient[i] = !in_contact;
  if (in_contact) {
    // A released node goes on from the value that it has.
    if (was_ambient) state_.total[equation] = current - state_.increment[equation];
    return was_ambient;
  }
  const bool changed = !was_ambient || current != value;
  current = value;
  return changed;
}

// -----------------------------------------------------------------------------------------------------------
// evaluations

void Problem::set_trial(const VectorXd& trial, int iteration) {
  const VectorXd solution = state_.total + state_.increment + trial;
  for (int i = 0; i < equations_.count(); ++i) {
    if (state_.ambient[static_cast<std::size_t>(i)]) continue;
    const int dof = equations_.dof(i);
    const bool clamped = model_.control.clamp && dof > pressure_dof && solution[i] < 0;
    state_.values(dof, equations_.node(i)) = clamped ? 0.0 : solution[i];
  }
  for (const Condition& condition : model_.prescribed) {
    for (const int node : condition.nodes) state_.values(condition.dof, node) = target_(condition.dof, node);
  }
  pending_.setZero();
  for (Contact& contact : contacts_) {
    const int seg_up = contact.definition().parameters.seg_up;
    contact.project(state_.values, seg_up > 0 && iteration > seg_up);
  }
}

VectorXd Problem::residual() {
  MatrixXd forces = MatrixXd::Zero(model_.dofs(), model_.mesh.nodes.cols());
  for (std::size_t e = 0; e < bodies_.elements(); ++e) {
    const Material& material = bodies_.material(e);
    if (material.rigid) continue;
    const VectorXd local = bodies_.residual(e, state_.values, dt_);
    Index entry = 0;
    for (int f = 0; f < material.fields(); ++f) {
      for (const int node : bodies_.element(e).nodes) forces(material.dof(f), node) -= local[entry++];
    }
  }
  for (Contact& contact : contacts_) contact.add_residual(state_.values, dt_, forces);
  for (std::size_t k = 0; k < unit_forces_.size(); ++k) {
    const SurfaceLoad& load = model_.loads[k];
    forces += load.value.at(time_, model_.curves) * (load.fluid ? dt_ : 1.0) * unit_forces_[k];
  }
  if (!forces.allFinite()) throw StepFailure("a residual is not a finite number");
  VectorXd free = VectorXd::Zero(equations_.count());
  for (int i = 0; i < equations_.count(); ++i) {
    if (!state_.ambient[static_cast<std::size_t>(i)]) free[i] = forces(equations_.dof(i), equations_.node(i));
  }
  reactions_.setZero();
  for (const Condition& condition : model_.prescribed) {
    for (const int node : condition.nodes)
      reactions_(condition.dof, node) = condition.reaction ? forces(condition.dof, node) : 0;
  }
  return free;
}

VectorXd Problem::assemble(LinearSystem& system) {
  VectorXd correction = VectorXd::Zero(equations_.count());
  const auto correct = [&](const std::vector<int>& numbers, const VectorXd& force) {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const int row = numbers[i];
      if (row >= 0 && !state_.ambient[static_cast<std::size_t>(row)]) correction[row] -= force[static_cast<Index>(i)];
    }
  };
  const bool pending = (pending_.array() != 0).any();
  system.clear();
  for (std::size_t e = 0; e < bodies_.elements(); ++e) {
    const Material& material = bodies_.material(e);
    if (material.rigid) continue;
    const MatrixXd tangent = bodies_.tangent(e, state_.values, dt_);
    system.add_element(e, tangent);
    if (!pending) continue;
    VectorXd given(tangent.cols());
    Index entry = 0;
    for (int f = 0; f < material.fields(); ++f) {
      for (const int node : bodies_.element(e).nodes) given[entry++] = pending_(material.dof(f), node);
    }
    correct(equations_.of_element(bodies_.element(e), material), tangent * given);
  }
  for (Contact& contact : contacts_) {
    contact.for_each_tangent(state_.values, dt_, [&](const Contact::Dofs& dofs, const MatrixXd& tangent) {
      std::vector<int> numbers;
      VectorXd given(tangent.cols());
      for (const auto& [dof, node] : dofs) {
        given[static_cast<Index>(numbers.size())] = pending_(dof, node);
        numbers.push_back(equations_.number(dof, node));
      }
      system.add(numbers, -tangent);
      correct(numbers, -tangent * given);
    });
  }
  return correction;
}

Problem::State Problem::save() {
  State state = state_;
  for (Contact& contact : contacts_) state.contacts.push_back(contact.save());
  return state;
}

void Problem::restore(const State& state) {
  state_ = state;
  pending_.setZero();
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    contacts_[k].restore(state.contacts[k]);
    contacts_[k].project(state_.values, false);
  }
  state_.contacts.clear();
}

}  // namespace standalone
