/// The contact interface <contact type="sliding-mixture"> in FEBio.
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

/// The properties of a contact in the model file that have one value per solute.
struct ContactProperties {
  AmbientConcentrations ambient;
  MembraneProperties membrane;
};

/// Receives FEBio's calls. It passes calls that concern this contact to its parts, and those that concern all contacts
/// to ModelContacts.
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

  /// Makes the contact belong to another interface, to which it keeps a reference.
  void act_for(ContactOwner& owner) { bound_.belong_to(owner); }

  bool is_active() const override { return IsActive(); }
  BoundContact& bound() override { return bound_; }
  double ambient_value(int dof) const override;
  bool has_reducible_penalty() const override { return core().effects().traction && setup_.has_reducible_penalty(); }
  const Assembly& assembly() const override { return assembly_; }
  void on_callback(unsigned int when) override;

 private:
  mixture_contact::ContactInterface& core() const { return bound_.core(); }
  /// Reads the properties of the model or of the owner.
  void read_properties();
  void find_self_contact();
  /// Continues with the present facets of the surfaces, after elements have eroded or meshes have been refined.
  void follow_surfaces();
  /// The surfaces whose nodal loads are unknowns of the matrix; none unless both surfaces have equations of their own.
  mixture_contact::PerSide<bool> surfaces_with_load_equations() const;

  std::shared_ptr<ModelContacts> model_;
  ContactParameters parameters_;
  ContactProperties properties_;
  ContactSurfaces surfaces_;
  LoadEquations loads_;
  BoundContact bound_;
  ContactSetup setup_;
  Assembly assembly_;
  ContactOutput output_;
  /// True if nodes that overlapped have been relocated before the first step.
  bool relocated_ = false;
  bool may_run_ = true;  ///< true if the requested effects exist in the present step

  DECLARE_FECORE_CLASS()
};
