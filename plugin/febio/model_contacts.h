/// What the contacts of a model share: one object for each model, kept alive by its contacts.
#pragma once

#include "ambient_conditions.h"
#include "host/contact_parameters.h"
#include "host/contact_steps.h"
#include "host/reducible_penalties.h"
#include "kept_matrix.h"

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
  /// What is wrong with the switches of helpers that a contact gives, beside those of the others: a sentence each.
  std::vector<std::string> complaints(ContactInModel& contact) const;

  // FEBio's calls, as each contact passes them on
  void activate(ContactInModel& contact);
  void prepare_step(ContactInModel& contact);
  mixture_contact::ContactSteps& steps() { return steps_; }
  /// What the model keeps between steps is stored once, with the first contact that is.
  void serialize(ContactInModel& contact, DumpStream& ar);
  /// Penalties of a contact have grown with an augmentation: its iterations begin with a matrix of these.
  void penalties_have_grown() { matrix_.force_next(); }
  /// The part of a contact has come into the matrix. After that of the last one loads follow from the rows of nodes.
  void added_tangent(const ContactInModel& contact);

  void on_callback(unsigned int when);

  newton::FEBioSolver& solver() { return solver_; }
  /// What automatic penalties of the traction are divided by at present.
  double penalty_reduction() const { return reducible_.divisor(); }
  /// Whether a device of the solver may act at present.
  bool is_on(newton::Device device) const;
  /// What the next matrix is to take of the contacts.
  MatrixForm matrix_form() const;

  std::vector<mixture_contact::SteppedContact*> active_contacts() override;
  bool apply_ambient() override;
  void evaluate() override;
  void evaluate_bodies_after_contacts() override;
  void evaluate_residual(mixture_contact::Changed what) override;
  void correct_residual() override;
  mixture_contact::MatrixUse matrix_use() override;
  bool may_look_ahead() override { return is_on(newton::Device::expected_contact); }
  bool is_matrix_due() override { return !is_on(newton::Device::kept_matrix) || matrix_.is_due(); }
  bool is_matrix_spent() override { return matrix_.is_spent(); }
  void replace_matrix() override;
  void request_matrix(bool is_needed) override;
  void rejected(int n, mixture_contact::GoesOn with) override;
  void accepted() override;

 private:
  std::vector<ContactInModel*> active() const;
  /// Whether parts of the tangent may stand beside the matrix.
  bool splits_matrix() const;
  /// Whether rows of loads may take those of their nodes.
  bool sums_rows() const;
  /// Devices that the model's contacts leave on.
  newton::DeviceSet chosen_devices() const;
  /// Says at the first step which these are.
  void introduce_devices();
  /// Counts the devices that the matrix rests on which has been formed.
  void count_matrix();
  /// Has a step that has failed tried again without devices, and the next attempt after that with them.
  void switch_devices_after_failure();
  void settle_status();

  FEModel& fem_;
  newton::FEBioSolver solver_;
  newton::DeviceRecord devices_;
  bool are_devices_introduced_ = false;
  newton::Helpers helpers_;
  mixture_contact::ContactSteps steps_;
  AmbientConditions ambient_;
  ReduciblePenalties reducible_;
  std::vector<ContactInModel*> contacts_;        ///< in the order of the model
  std::set<const ContactInModel*> unactivated_;  ///< whose state is not known to the core yet
  KeptMatrix matrix_;
  mixture_contact::Round dumps_;
};
