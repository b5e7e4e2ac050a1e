#include "problem.h"

#include "hexahedron.h"

#include <algorithm>
#include <map>
#include <set>

namespace standalone {
namespace {

using Location = mixture_contact::ContactInterface::Location;
using Status = Problem::Status;

/// A function that adds parts of the residual of a contact or a tie to the forces at all nodal values. It keeps
/// references.
template <class Joint>
auto adder(const Joint& joint, VectorXd& forces) {
  return [&joint, &forces](const auto& at, const VectorXd& local) {
    const std::vector<int> places = joint.places(at);
    for (Index i = 0; i < local.size(); ++i) forces[mixture_contact::at(places, i)] += local[i];
  };
}

void check_rigid(const Model& model, const Bodies& bodies, const std::vector<Status>& status) {
  for (std::size_t e = 0; e < bodies.elements(); ++e) {
    for (const int place : bodies.places(e)) {
      if (!bodies.material(e).rigid || at(status, place) == Status::prescribed) continue;
      throw InputError(
          model.file + ": the rigid body \"" + bodies.material(e).name +
          "\" is free to move; all its translations must be given in <Rigid>, free rigid bodies are not supported");
    }
  }
}

/// The initial status of all nodal values.
std::vector<Status> initial_status(const Model& model, const Bodies& bodies) {
  std::vector<Status> status(entries(model.dofs() * model.mesh.nodes.cols()), Status::absent);
  for (std::size_t e = 0; e < bodies.elements(); ++e) {
    for (const int place : bodies.places(e)) at(status, place) = Status::free;
  }
  for (const Condition& condition : model.prescribed) {
    for (const int node : condition.nodes) {
      Status& now = at(status, model.place(condition.dof, node));
      if (now != Status::absent) now = Status::prescribed;
    }
  }
  check_rigid(model, bodies, status);
  if (std::find(status.begin(), status.end(), Status::free) == status.end())
    throw InputError(model.file + ": nothing is free, so there is nothing to solve");
  return status;
}

/// Nodal forces of a unit load on the reference surface, shape (dofs, nodes). Pressure of 1 MPa: INT -N_a n dA [N].
/// Outward solvent flux of 1 mm/s: INT N_a dA in the rows of p~ [mm^3/s].
MatrixXd unit_forces(const Model& model, const SurfaceLoad& load) {
  MatrixXd forces = MatrixXd::Zero(model.dofs(), model.mesh.nodes.cols());
  for (const SurfaceFacet& facet : load.facets) {
    for (const FacetPoint& point : facet_points(facet.facet, model.mesh.nodes)) {
      for (Index a = 0; a < point.shape.size(); ++a) {
        const int node = at(facet.facet.nodes, a);
        if (load.fluid) {
          forces(pressure_dof, node) += point.shape[a] * point.area.norm();
        } else {
          forces.col(node).head<3>() -= point.shape[a] * point.area;
        }
      }
    }
  }
  return forces;
}

double ambient_value(const Model& model, const ContactDefinition& contact, int dof, double time) {
  if (dof == pressure_dof) return contact.ambient_pressure.at(time, model.curves);
  const auto entry = contact.ambient_concentration.find(dof - concentration_dof(0));
  return entry == contact.ambient_concentration.end() ? 0.0 : entry->second.at(time, model.curves);
}

}  // namespace

Problem::Problem(const Model& model) : bodies_(model) {
  for (const ContactDefinition& definition : model.contacts.sliding) contacts_.emplace_back(definition, bodies_);
  for (const ContactDefinition& definition : model.contacts.tied) ties_.emplace_back(definition, bodies_);
  for (const SurfaceLoad& load : model.loads) unit_forces_.push_back(unit_forces(model, load));
  state_.status = initial_status(model, bodies_);
  state_.values = MatrixXd::Zero(model.dofs(), model.mesh.nodes.cols());
  for (const Condition& condition : model.initial) {
    for (const int node : condition.nodes) state_.values(condition.dof, node) = condition.value.value;
  }
  pending_ = forces_ = VectorXd::Zero(state_.values.size());
  accept_step();
  const std::vector<bool> unknowns = free();
  for (Contact& contact : contacts_) {
    contact.find_immovable_nodes(unknowns);
    contact.update_properties(state_.values);
    contact.project(state_.values);
  }
}

Matrix3Xd Problem::reactions() const {
  Matrix3Xd all = Matrix3Xd::Zero(3, model().mesh.nodes.cols());
  for (const Condition& condition : model().prescribed) {
    if (condition.dof >= 3 || condition.fixed) continue;
    for (const int node : condition.nodes) all(condition.dof, node) = forces_[model().place(condition.dof, node)];
  }
  return all;
}

std::vector<bool> Problem::free() const {
  std::vector<bool> all;
  for (const Status status : state_.status) all.push_back(status == Status::free);
  return all;
}

void Problem::start_step(double time, double dt) {
  time_ = time;
  dt_ = dt;
  pending_.setZero();
  for (const Condition& condition : model().prescribed) {
    const double target = condition.value.at(time, model().curves);
    for (const int node : condition.nodes) {
      const int place = model().place(condition.dof, node);
      if (at(state_.status, place) == Status::prescribed) pending_[place] = target - state_.values(condition.dof, node);
    }
  }
  for (Contact& contact : contacts_) {
    contact.update_laws(time, dt_, reduction_);
    if (reads_properties_again(contact.definition().parameters, contact.core().effects()))
      contact.update_properties(state_.values);
  }
  for (TiedContact& tie : ties_) tie.start_step(state_.values, dt_);
}

void Problem::accept_step() {
  bodies_.accept_step(state_.values);
  for (const Contact& contact : contacts_) contact.core().accept_step(contact.fields(state_.values));
}

// ------------------------------------------------------------ contact status

bool Problem::switch_ambient() {
  // A node has ambient values only if no contact has it in contact. The first free-draining contact of the node gives
  // these values.
  std::map<int, const ContactDefinition*> definitions;
  std::set<int> in_contact;
  for (const Contact& contact : contacts_) {
    const auto status = contact.core().hold_nodes_in_contact();
    for (const auto side : mixture_contact::both_sides) {
      for (std::size_t i = 0; i < contact.nodes(side).size(); ++i) {
        if (contact.definition().parameters.ambient.free_draining)
          definitions.emplace(contact.nodes(side)[i], &contact.definition());
        if (status[side][i]) in_contact.insert(contact.nodes(side)[i]);
      }
    }
  }
  bool changed = false;
  for (const auto& [node, definition] : definitions) {
    const bool switched = switch_ambient(node, in_contact.count(node) > 0, *definition);
    changed = changed || switched;
  }
  return changed;
}

bool Problem::switch_ambient(int node, bool in_contact, const ContactDefinition& contact) {
  bool changed = false;
  for (int dof = pressure_dof; dof < model().dofs(); ++dof) {
    Status& status = at(state_.status, model().place(dof, node));
    if (status != Status::free && status != Status::ambient) continue;
    double& value = state_.values(dof, node);
    const double ambient = in_contact ? value : ambient_value(model(), contact, dof, time_);
    const Status wanted = in_contact ? Status::free : Status::ambient;
    changed = changed || status != wanted || value != ambient;
    status = wanted;
    value = ambient;
  }
  return changed;
}

// ------------------------------------------------------------ evaluations

void Problem::advance(const VectorXd& change) {
  state_.values.reshaped() += change + pending_;
  pending_.setZero();
  for (Contact& contact : contacts_) contact.project(state_.values);
}

VectorXd Problem::residual() {
  forces_.setZero();
  for (std::size_t e = 0; e < bodies_.elements(); ++e) {
    if (!bodies_.material(e).rigid) forces_(bodies_.places(e)) -= bodies_.residual(e, state_.values, dt_);
  }
  for (const Contact& contact : contacts_)
    contact.core().residual(contact.fields(state_.values), dt_, adder(contact, forces_));
  for (const TiedContact& tie : ties_) tie.core().residual(tie.fields(state_.values), dt_, adder(tie, forces_));
  for (std::size_t k = 0; k < unit_forces_.size(); ++k) {
    const SurfaceLoad& load = model().loads[k];
    forces_ += load.value.at(time_, model().curves) * (load.fluid ? dt_ : 1.0) * unit_forces_[k].reshaped();
  }
  if (!forces_.allFinite()) throw StepFailure("a residual is not a finite number");
  return on_free_places(forces_);
}

VectorXd Problem::on_free_places(VectorXd forces) const {
  for (std::size_t i = 0; i < state_.status.size(); ++i) {
    if (state_.status[i] != Status::free) forces[static_cast<Index>(i)] = 0;
  }
  return forces;
}

void Problem::assemble(LinearSystem& system) const {
  system.clear();
  for (std::size_t e = 0; e < bodies_.elements(); ++e) {
    const std::vector<int> places = bodies_.places(e);
    if (!bodies_.material(e).rigid) system.add(places, places, bodies_.tangent(e, state_.values, dt_));
  }
  for (const Contact& contact : contacts_) {
    contact.core().tangent(contact.fields(state_.values), dt_,
                           [&](const Location& rows, const Location& columns, const MatrixXd& tangent) {
                             system.add(contact.places(rows), contact.places(columns), -tangent);
                           });
  }
  for (const TiedContact& tie : ties_) {
    const auto add = [&](const mixture_contact::Patch& patch, const MatrixXd& block) {
      const std::vector<int> places = tie.places(patch);
      system.add(places, places, -block);
    };
    tie.core().tangent(tie.fields(state_.values), dt_, {}, add);
  }
}

Problem::State Problem::save() {
  State state = state_;
  for (const Contact& contact : contacts_) state.contacts.push_back(contact.core().state());
  for (const TiedContact& tie : ties_) state.ties.push_back(tie.core().state());
  return state;
}

void Problem::restore(const State& state) {
  state_ = state;
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    contacts_[k].core().restore(state.contacts[k]);
    contacts_[k].project(state_.values);
  }
  for (std::size_t k = 0; k < ties_.size(); ++k) ties_[k].core().restore(state.ties[k]);
  state_.contacts.clear();
  state_.ties.clear();
}

}  // namespace standalone
