#include "problem.h"

#include "loads.h"

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
  for (const SurfaceLoad& load : model.loads) unit_forces_.push_back(unit_forces(model, load));
  state_.values = MatrixXd::Zero(equations_.rows(), model.mesh.nodes.cols());
  for (const Condition& condition : model.initial) {
    for (const int node : condition.nodes) state_.values(condition.dof, node) = condition.value.value;
  }
  target_ = state_.values;
  pending_ = forces_ = MatrixXd::Zero(equations_.rows(), model.mesh.nodes.cols());
  state_.total.resize(equations_.count());
  for (int i = 0; i < equations_.count(); ++i) state_.total[i] = state_.values(equations_.dof(i), equations_.node(i));
  state_.increment = VectorXd::Zero(equations_.count());
  state_.hold.assign(static_cast<std::size_t>(equations_.count()), Hold::none);
  reported_.setConstant(model.dofs(), model.mesh.nodes.cols(), false);
  for (const Condition& condition : model.prescribed) {
    for (const int node : condition.nodes) reported_(condition.dof, node) = condition.reaction;
  }
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
  for (Contact& contact : contacts_) {
    if (reads_properties_again(contact.definition().parameters)) contact.update_properties(state_.values);
  }
  end_iterations();
}

void Problem::accept_step() {
  state_.total += state_.increment;
  state_.increment.setZero();
  bodies_.accept_step(state_.values);
}

// ----------------------------------------------------------------------------------------------------------------
// contact status

void Problem::end_iterations() {
  for (Contact& contact : contacts_) contact.core().end_iterations();
  for (int i = 0; i < equations_.count(); ++i) {
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
  state_.total[equation] = value(equation) - state_.increment[equation];
}

Problem::ClampChanges Problem::clamp_changes() const {
  ClampChanges changes;
  if (!model_.control.clamp) return changes;
  const VectorXd solution = state_.total + state_.increment;
  const VectorXd largest = state_.values.cwiseAbs().rowwise().maxCoeff();
  // The force on a concentration is what leaves the node less what it stores: negative where solute comes in.
  VectorXd largest_force = VectorXd::Zero(equations_.rows());
  const auto force = [&](int i) { return forces_(equations_.dof(i), equations_.node(i)); };
  for (int i = 0; i < equations_.count(); ++i) {
    double& most = largest_force[equations_.dof(i)];
    if (hold(i) == Hold::clamp) most = std::max(most, std::abs(force(i)));
  }
  for (int i = 0; i < equations_.count(); ++i) {
    const int dof = equations_.dof(i);
    if (!is_concentration(dof)) continue;
    if (hold(i) == Hold::none && solution[i] < -negligible * largest[dof]) changes.hold.push_back(i);
    const bool rises = hold(i) == Hold::clamp && -force(i) > negligible * largest_force[dof];
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
      if (equation < 0) continue;
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
  const VectorXd solution = state_.total + state_.increment + trial;
  for (int i = 0; i < equations_.count(); ++i) {
    if (hold(i) != Hold::none) continue;
    const int dof = equations_.dof(i);
    const bool clamped = model_.control.clamp && is_concentration(dof) && solution[i] < 0;
    state_.values(dof, equations_.node(i)) = clamped ? 0.0 : solution[i];
  }
  for (const Condition& condition : model_.prescribed) {
    for (const int node : condition.nodes) state_.values(condition.dof, node) = target_(condition.dof, node);
  }
  pending_.setZero();
  for (Contact& contact : contacts_) {
    const int seg_up = contact.definition().parameters.seg_up;
    contact.take_multipliers(state_.values);
    contact.project(state_.values, seg_up > 0 && iteration > seg_up);
  }
}

VectorXd Problem::residual() {
  MatrixXd& forces = forces_;
  forces.setZero();
  for (std::size_t e = 0; e < bodies_.elements(); ++e) {
    const Material& material = bodies_.material(e);
    if (material.rigid) continue;
    const VectorXd local = bodies_.residual(e, state_.values, dt_);
    Index entry = 0;
    for (int f = 0; f < material.fields(); ++f) {
      for (const int node : bodies_.element(e).nodes) forces(material.dof(f), node) -= local[entry++];
    }
  }
  for (const Contact& contact : contacts_) contact.add_residual(state_.values, dt_, forces);
  for (std::size_t k = 0; k < unit_forces_.size(); ++k) {
    const SurfaceLoad& load = model_.loads[k];
    const double size = load.value.at(time_, model_.curves) * (load.fluid ? dt_ : 1.0);
    forces.topRows(model_.dofs()) += size * unit_forces_[k];
  }
  if (!forces.allFinite()) throw StepFailure("a residual is not a finite number");
  VectorXd free = VectorXd::Zero(equations_.count());
  for (int i = 0; i < equations_.count(); ++i) {
    if (hold(i) == Hold::none) free[i] = forces(equations_.dof(i), equations_.node(i));
  }
  return free;
}

VectorXd Problem::assemble(LinearSystem& system) {
  VectorXd correction = VectorXd::Zero(equations_.count());
  const auto correct = [&](const std::vector<int>& numbers, const VectorXd& force) {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const int row = numbers[i];
      if (row >= 0 && hold(row) == Hold::none) correction[row] -= force[static_cast<Index>(i)];
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
  for (const Contact& contact : contacts_) {
    const auto numbers = [&](const Contact::Dofs& dofs) {
      std::vector<int> list;
      for (const auto& [dof, node] : dofs) list.push_back(equations_.number(dof, node));
      return list;
    };
    const auto add = [&](const Contact::Dofs& rows, const Contact::Dofs& columns, const MatrixXd& tangent) {
      VectorXd given(tangent.cols());
      for (Index j = 0; j < given.size(); ++j) {
        const auto& [dof, node] = columns[static_cast<std::size_t>(j)];
        given[j] = pending_(dof, node);
      }
      system.add(numbers(rows), numbers(columns), -tangent);
      correct(numbers(rows), -tangent * given);
    };
    contact.for_each_tangent(state_.values, dt_, add);
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
