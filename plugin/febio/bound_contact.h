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

  /// Makes the core. Nothing else may be called before.
  void build(mixture_contact::PerSide<mixture_contact::SurfaceMesh> meshes, const mixture_contact::Effects& effects);
  bool is_built() const { return core_ != nullptr; }
  /// The state, and the nodes that it is the state of.
  mixture_contact::NumberedState numbered_state() const;
  /// The number of nodes that the mesh had when the core was made.
  int nodes_of_mesh() const { return nodes_of_mesh_; }
  /// Goes on from a state of nodes that may be others than those of the core, which has just been made.
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
  /// A step has failed: where it began without a node in contact says so once. There, and before contact has borne
  /// anything, the next attempt begins with all nodes closed around which single points overlap.
  void fail_step();

  /// Multipliers that are unknowns, in a trial: those at the start of the step and FEBio's increments.
  void set_multipliers(const std::vector<double>& total, const std::vector<double>& increment);

  void serialize(DumpStream& ar);

 private:
  /// Restores a state of other nodes: an attempt at a step has failed in which elements have eroded.
  void rewind_to(const mixture_contact::NumberedState& before);

  ContactSurfaces& surfaces_;
  DofMap& dofs_;
  const ContactParameters& parameters_;
  const ContactLog& log_;
  std::unique_ptr<mixture_contact::ContactInterface> core_;
  mixture_contact::NodeNumbers numbers_;  ///< of the core's nodes
  int nodes_of_mesh_ = 0;
  mixture_contact::VectorXd step_start_;  ///< multipliers at the start of the step, where they are unknowns
  bool said_overlap_ = false;             ///< in this run
  std::optional<bool> begins_open_;       ///< no node was in contact where the step began; none: it has not begun
  bool said_open_ = false;                ///< in this run
};
