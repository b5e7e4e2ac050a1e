/// The contact interface <contact type="tied-mixture"> in FEBio.
#pragma once

#include "contact/tie/bond_iterations.h"
#include "mixture_contact.h"
#include "tie_assembly.h"
#include "tie_setup.h"

#include <FEBioMech/FEContactInterface.h>

#include <memory>
#include <string>
#include <vector>

/// Receives FEBio's calls for a tie. A tie that can break has a sliding contact of the same surfaces for its broken
/// nodes. The sliding contact is an interface of the model without a tag in the model file.
class FEMixtureTie : public FEContactInterface, public ContactOwner {
 public:
  explicit FEMixtureTie(FEModel* fem);

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

  void give_parameters(ContactParameters& parameters, AmbientConcentrations& ambient) override;
  bool breaks_bonds(double left) override;
  void step_solved() override;
  bool is_softening() const override { return iterations_.is_any_softening(); }
  void step_failed() override;

 private:
  void add_sliding_contact();
  FEMixtureContact& sliding() const { return static_cast<FEMixtureContact&>(*sliding_); }
  /// Sets the damage of the tie, and frees broken nodes for the sliding contact.
  void take_damage(mixture_contact::DamageState damage);
  void update_laws();
  mixture_contact::PerSide<mixture_contact::SurfaceFields> fields();
  /// Stores the output. `damage`: damage of the present state.
  void store_output(const mixture_contact::DamageState& damage);
  void serialize_model(DumpStream& ar);

  TieParameters parameters_;
  AmbientConcentrations ambient_concentrations_;
  ContactLog log_;
  ContactSurfaces surfaces_;
  DofMap dofs_;
  TieSetup setup_;
  TieAssembly assembly_;
  std::unique_ptr<mixture_contact::Tie> tie_;
  /// Sliding contact of broken nodes, owned by the model; null if no node can break.
  FESurfacePairConstraint* sliding_ = nullptr;
  bool is_augmented_ = true;              ///< true if no augmentation is needed at the last solution
  mixture_contact::Matrix3Xd tractions_;  ///< tractions of the tied nodes at the start of the last iteration [MPa]
  mixture_contact::BondIterations iterations_;  ///< softening in the iterations of the step
  mixture_contact::VectorXd step_start_;        ///< unknown multipliers at the start of the step

  DECLARE_FECORE_CLASS()
};
