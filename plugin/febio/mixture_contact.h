/// The contact interface <contact type="sliding-mixture">: FEBio's side of the contact core.
#pragma once

#include "assembly.h"
#include "contact_in_model.h"
#include "contact_output.h"
#include "contact_setup.h"
#include "membrane_values.h"
#include "model_contacts.h"

#include <FEBioMech/FEContactInterface.h>

#include <memory>
#include <string>
#include <vector>

/// The values that the model gives for each solute.
struct ContactProperties {
  AmbientConcentrations ambient;
  MembraneProperties membrane;
};

/// The interface that a contact acts for, which has the tag in the model.
class ContactOwner {
 public:
  ContactOwner() = default;
  ContactOwner(const ContactOwner&) = delete;
  ContactOwner& operator=(const ContactOwner&) = delete;
  ContactOwner(ContactOwner&&) = delete;
  ContactOwner& operator=(ContactOwner&&) = delete;
  virtual ~ContactOwner() = default;

  /// Sets the parameters of its contact as they are at this time.
  virtual void give_parameters(ContactParameters& parameters, AmbientConcentrations& ambient) = 0;
  /// Whether the owner of the contact accepts a solution that the contact accepts.
  virtual bool accepts_solution() = 0;
  /// A time step has been solved, and the contact has accepted it.
  virtual void step_solved() = 0;
};

/// Passes FEBio's calls on: those of the contact itself to its parts, those that concern all contacts to the model's.
class FEMixtureContact : public FEContactInterface, public ContactInModel {
 public:
  explicit FEMixtureContact(FEModel* fem);
  FEMixtureContact(const FEMixtureContact&) = delete;
  FEMixtureContact& operator=(const FEMixtureContact&) = delete;
  FEMixtureContact(FEMixtureContact&&) = delete;
  FEMixtureContact& operator=(FEMixtureContact&&) = delete;
  ~FEMixtureContact() override;

  bool Init() override;
  int InitEquations(int first) override;
  void Activate() override;
  void Deactivate() override;
  void PrepStep() override;
  using FEContactInterface::Update;
  void Update() override;
  void Update(const std::vector<double>& total, const std::vector<double>& increment) override;
  void UpdateIncrements(std::vector<double>& total, const std::vector<double>& increment) override;
  void BuildMatrixProfile(FEGlobalMatrix& matrix) override;
  void LoadVector(FEGlobalVector& residual, const FETimeInfo& time) override;
  void StiffnessMatrix(FELinearSystem& system, const FETimeInfo& time) override;
  bool Augment(int augmentation, const FETimeInfo& time) override;
  void Serialize(DumpStream& ar) override;

  FESurface* GetPrimarySurface() override { return &surfaces_[mixture_contact::Side::primary]; }
  FESurface* GetSecondarySurface() override { return &surfaces_[mixture_contact::Side::secondary]; }
  bool UseNodalIntegration() override { return false; }

  /// Acts for another interface. Keeps a reference.
  void act_for(ContactOwner& owner) { owner_ = &owner; }

  bool is_active() const override { return IsActive(); }
  BoundContact& bound() override { return bound_; }
  double ambient_value(int dof) const override;
  bool has_reducible_penalty() const override { return core().effects().traction && setup_.has_reducible_penalty(); }
  const Assembly& assembly() const override { return assembly_; }
  void on_callback(unsigned int when) override;

 private:
  mixture_contact::ContactInterface& core() const { return bound_.core(); }
  /// Reads the properties that the model or an owner gives.
  void read_properties();
  void find_self_contact();
  /// Elements have eroded, or meshes have been refined: the contact continues with the present facets.
  void follow_surfaces();
  /// Surfaces whose nodes' loads are unknowns of the matrix, where both surfaces have equations of their own.
  mixture_contact::PerSide<bool> surfaces_with_load_equations() const;

  std::shared_ptr<ModelContacts> model_;
  ContactParameters parameters_;
  ContactProperties properties_;
  ContactLog log_;
  ContactSurfaces surfaces_;
  DofMap dofs_;
  LoadEquations loads_;
  BoundContact bound_;
  ContactSetup setup_;
  Assembly assembly_;
  ContactOutput output_;
  ContactOwner* owner_ = nullptr;  ///< null: the contact has a tag of its own
  bool relocated_ = false;
  bool may_run_ = true;  ///< the requested effects exist in the present step

  DECLARE_FECORE_CLASS()
};
