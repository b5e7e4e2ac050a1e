/// The contact core, bound to surfaces and degrees of freedom of an FEBio model.
#pragma once

#include "contact_log.h"
#include "dof_map.h"
#include "host/contact_parameters.h"
#include "host/contact_steps.h"

#include <memory>
#include <optional>
#include <string>

/// Values at the nodes of both surfaces, as the core takes them.
mixture_contact::PerSide<mixture_contact::SurfaceFields> fields_of(ContactSurfaces& surfaces, const DofMap& dofs,
                                                                   const mixture_contact::Effects& effects);

class BoundContact : public mixture_contact::SteppedContact {
 public:
  BoundContact(ContactSurfaces& surfaces, DofMap& dofs, const ContactParameters& parameters, const ContactLog& log)
      : surfaces_(surfaces), dofs_(dofs), parameters_(parameters), log_(log) {}

  /// Makes the core. Call this function first.
  void build(mixture_contact::PerSide<mixture_contact::SurfaceMesh> meshes, const mixture_contact::Effects& effects);
  bool is_built() const { return core_ != nullptr; }
  /// The state, with the numbers of its nodes.
  mixture_contact::NumberedState numbered_state() const;
  /// The number of nodes that the mesh had when the core was made.
  int nodes_of_mesh() const { return nodes_of_mesh_; }
  /// Continues a new core from a state, whose nodes may differ from those of the core.
  void go_on_from(const mixture_contact::NumberedState& before);
  mixture_contact::ContactInterface& core() const { return *core_; }
  const ContactSurfaces& surfaces() const { return surfaces_; }
  const DofMap& dofs() const { return dofs_; }
  const ContactParameters& parameters() const { return parameters_; }
  std::string name() const { return log_.name(); }
  /// Values at the nodes, as the core takes them.
  mixture_contact::PerSide<mixture_contact::SurfaceFields> fields() const;

  void project() override;
  void prepare_step() override;
  void end_iterations() override {
    core_->end_iterations();
    begins_open_.reset();
  }
  bool begin_iteration() override;
  void hold_loads() override;
  void linearise_at() override { core_->linearise_at(fields()); }
  bool keeps_matrix() override;
  bool correct() override;
  bool is_solution() override { return core_->is_solution(fields()); }
  bool reconsiders_edge() override { return mixture_contact::reconsiders_edge(*core_, fields()); }
  bool finds_overlap() override;
  /// A step has failed. Reports once that it began without a node in contact. In this case, and before contact has
  /// borne a load, the next attempt begins with all nodes around overlapping points in contact.
  void fail_step();

  /// Multipliers that are unknowns, in a trial: those at the start of the step and FEBio's increments.
  void set_multipliers(const std::vector<double>& total, const std::vector<double>& increment);

  void serialize(DumpStream& ar);

 private:
  /// Restores a state of other nodes, after the failure of an attempt in which elements have eroded.
  void rewind_to(const mixture_contact::NumberedState& before);

  ContactSurfaces& surfaces_;
  DofMap& dofs_;
  const ContactParameters& parameters_;
  const ContactLog& log_;
  std::unique_ptr<mixture_contact::ContactInterface> core_;
  mixture_contact::NodeNumbers numbers_;  ///< of the core's nodes
  int nodes_of_mesh_ = 0;
  mixture_contact::VectorXd step_start_;  ///< multipliers at the start of the step, if they are unknowns
  bool said_overlap_ = false;             ///< in this run
  std::optional<bool> begins_open_;       ///< whether the step began without a node in contact; none before a step
  bool said_open_ = false;                ///< in this run
};
