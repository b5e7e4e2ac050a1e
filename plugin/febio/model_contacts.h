/// The data that the contacts of a model share: one object for each model, kept alive by its contacts.
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

class ModelContacts : public mixture_contact::SteppedModel {
 public:
  explicit ModelContacts(FEModel& fem);

  /// The object that the contacts of a model share.
  static std::shared_ptr<ModelContacts> of(FEModel& fem);

  void add(ContactInModel& contact);
  void remove(ContactInModel& contact);
  /// The faults of the switches of helpers that a contact gives, given those of the others: a sentence each.
  std::vector<std::string> complaints(ContactInModel& contact) const;

  // FEBio's calls, passed on by each contact
  void activate(ContactInModel& contact);
  void prepare_step(ContactInModel& contact);
  mixture_contact::ContactSteps& steps() { return steps_; }
  /// Stores the data that the model keeps between steps once, with the first contact that is stored.
  void serialize(ContactInModel& contact, DumpStream& ar);
  /// Reports that a matrix is outdated, because penalties have grown or bonds have broken.
  void force_new_matrix() { matrix_.force_next(); }
  /// A contact has added its part to the matrix. After the last contact, loads are eliminated by the rows of nodes.
  void added_tangent(const ContactInModel& contact);

  void on_callback(unsigned int when);

  newton::FEBioSolver& solver() { return solver_; }
  /// The reduction of automatic penalties of the traction in the present step.
  mixture_contact::ReducedPenalty penalty_reduction() const;
  const ModelDevices& devices() const { return devices_; }
  /// The parts of the contacts that the next matrix includes.
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
  ModelDevices devices_;
  newton::Helpers helpers_;
  mixture_contact::ContactSteps steps_;
  AmbientConditions ambient_;
  ReduciblePenalties reducible_;
  std::vector<ContactInModel*> contacts_;        ///< in the order of the model
  std::set<const ContactInModel*> unactivated_;  ///< contacts whose core has no state yet
  newton::KeptMatrix matrix_;
  mixture_contact::Round dumps_;
};
