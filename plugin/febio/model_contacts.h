/// The data that all contacts of a model share. The contacts keep this object alive.
#pragma once

#include "ambient_conditions.h"
#include "host/contact_parameters.h"
#include "host/contact_steps.h"
#include "host/reducible_penalties.h"
#include "model_devices.h"
#include "solver/febio/kept_matrix.h"

#include <functional>
#include <memory>
#include <set>
#include <vector>

class DumpStream;
class FEGlobalMatrix;

/// Coordinates all contacts of a model with FEBio's solver.
class ModelContacts : public mixture_contact::SteppedModel {
 public:
  explicit ModelContacts(FEModel& fem);

  /// The object shared by the contacts of a model.
  static std::shared_ptr<ModelContacts> of(FEModel& fem);

  void add(ContactInModel& contact);
  void remove(ContactInModel& contact);
  /// The faults of the solver switches of a contact in combination with those of other contacts, one sentence each.
  std::vector<std::string> complaints(ContactInModel& contact) const;

  // Calls of FEBio that each contact passes on.
  void activate(ContactInModel& contact);
  void prepare_step(ContactInModel& contact);
  mixture_contact::ContactSteps& steps() { return steps_; }
  /// Stores or reads the data that the model keeps between steps, once per archive, with the first contact.
  void serialize(ContactInModel& contact, DumpStream& ar);
  /// Requests a new matrix, because penalties have grown or bonds have broken.
  void force_new_matrix() { matrix_.force_next(); }
  /// Notes that a contact has added its part to the matrix. After the last contact, the nodes' unknowns are eliminated
  /// from the rows of loads.
  void added_tangent(const ContactInModel& contact);

  void on_callback(unsigned int when);

  newton::FEBioSolver& solver() { return solver_; }
  /// The reduction of automatic traction penalties in the present step.
  mixture_contact::ReducedPenalty penalty_reduction() const;
  const ModelDevices& devices() const { return devices_; }
  /// The properties of the next matrix on which the assembly of contacts depends.
  MatrixForm matrix_form() const;

  std::vector<mixture_contact::SteppedContact*> active_contacts() override;
  bool apply_ambient() override;
  void evaluate() override;
  void evaluate_bodies_after_contacts() override;
  void evaluate_residual(mixture_contact::Changed what) override;
  void correct_residual() override;
  mixture_contact::MatrixUse matrix_use() override;
  bool is_matrix_due() override { return !devices_.is_on(newton::Device::kept_matrix) || matrix_.is_due(); }
  bool replaces_matrix() override;
  void request_matrix(bool is_needed) override;
  void rejected(int n, mixture_contact::GoesOn with) override;
  void accepted() override;

 private:
  std::vector<ContactInModel*> active() const;

  FEModel& fem_;
  newton::FEBioSolver solver_;
  newton::FEBioSystem system_;
  std::vector<ContactInModel*> contacts_;  ///< all contacts in the order of the model
  ModelDevices devices_;
  mixture_contact::ContactSteps steps_;
  AmbientConditions ambient_;
  ReduciblePenalties reducible_;
  std::set<const ContactInModel*> unactivated_;  ///< contacts whose core has not been activated
  newton::KeptMatrix matrix_;
  mixture_contact::Round dumps_;
};
