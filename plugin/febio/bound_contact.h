/// The contact core with the surfaces and degrees of freedom of an FEBio model.
#pragma once

#include "contact_log.h"
#include "contact_owner.h"
#include "dof_map.h"
#include "host/contact_parameters.h"
#include "host/contact_steps.h"

#include <memory>
#include <string>

/// Positions and fields at the nodes of both surfaces, in the form of the core.
mixture_contact::PerSide<mixture_contact::SurfaceFields> fields_of(const DofMap& dofs,
                                                                   const mixture_contact::Effects& effects);

/// A contact core that takes its state from FEBio's nodes.
class BoundContact : public mixture_contact::SteppedContact {
 public:
  /// Keeps references. `contact`: the contact in the model, for lines in the log.
  BoundContact(ContactSurfaces& surfaces, const ContactParameters& parameters, FECoreBase& contact)
      : dofs_(surfaces), parameters_(parameters), log_(contact) {}

  /// Makes the core. It has to be called before all other functions.
  void build(mixture_contact::PerSide<mixture_contact::SurfaceMesh> meshes, const mixture_contact::Effects& effects);
  bool is_built() const { return core_ != nullptr; }
  /// The state with the numbers of its nodes in the mesh.
  mixture_contact::NumberedState numbered_state() const;
  /// The number of nodes in the mesh when the core was made.
  int nodes_of_mesh() const { return nodes_of_mesh_; }
  /// Sets the state of a new core from the state `before`, whose nodes may differ from those of the core.
  void go_on_from(const mixture_contact::NumberedState& before);
  mixture_contact::ContactInterface& core() const override { return *core_; }
  ContactSurfaces& surfaces() const { return dofs_.surfaces(); }
  DofMap& dofs() { return dofs_; }
  const DofMap& dofs() const { return dofs_; }
  const ContactParameters& parameters() const { return parameters_; }
  const ContactLog& log() const { return log_; }
  std::string name() const { return log_.name(); }
  mixture_contact::PerSide<mixture_contact::SurfaceFields> fields() const override;
  /// Makes the contact belong to an owner, to which it keeps a reference.
  void belong_to(ContactOwner& owner) { owner_ = &owner; }
  /// The owner; null if the contact is in the model file itself.
  ContactOwner* owner() const { return owner_; }
  bool has_bonds() const override { return owner_ != nullptr; }
  bool breaks_bonds(double left) override { return owner_ != nullptr && owner_->breaks_bonds(left); }
  void project() override;
  void prepare_step() override;
  void note_beginning() override;
  /// Notes that a step has failed. If the step began without a node in contact, and before contact has borne a load,
  /// the next attempt begins with contact at all nodes around overlapping points, or at the nearest nodes. Returns a
  /// line for the log the first time that a failed step began without a node in contact, otherwise an empty text.
  std::string fail_step();

  /// Sets the unknown multipliers of a trial state: values at the start of the step plus FEBio's increments.
  void set_multipliers(const std::vector<double>& total, const std::vector<double>& increment);

  void serialize(DumpStream& ar);

 protected:
  void report(const mixture_contact::UndetectedPenetration& undetected) override;

 private:
  /// Restores a state with other nodes, after a failed attempt in which elements have eroded.
  void rewind_to(const mixture_contact::NumberedState& before);

  DofMap dofs_;
  const ContactParameters& parameters_;
  ContactLog log_;
  ContactOwner* owner_ = nullptr;
  std::unique_ptr<mixture_contact::ContactInterface> core_;
  mixture_contact::NodeNumbers numbers_;  ///< numbers of the core's nodes in the mesh
  int nodes_of_mesh_ = 0;
  mixture_contact::VectorXd step_start_;  ///< unknown multipliers at the start of the step
  bool began_open_ = false;               ///< true if the iterations began without a node in contact
  bool said_open_ = false;                ///< true if open contact has been reported in this run
};
