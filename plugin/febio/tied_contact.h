/// The contact interface <contact type="tied-mixture">: FEBio's side of ties.
#pragma once

#include "tie_assembly.h"
#include "tie_setup.h"

#include <FEBioMech/FEContactInterface.h>

#include <memory>
#include <string>
#include <vector>

class FEMixtureTie : public FEContactInterface {
 public:
  explicit FEMixtureTie(FEModel* fem);

  bool Init() override;
  int InitEquations(int first) override;
  void Activate() override;
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

 private:
  bool prepare_surfaces();
  bool close_gaps();
  void update_laws();
  mixture_contact::PerSide<mixture_contact::SurfaceFields> fields();
  void store_output();
  void serialize_model(DumpStream& ar);

  ContactParameters parameters_;
  ContactLog log_;
  ContactSurfaces surfaces_;
  DofMap dofs_;
  TieSetup setup_;
  TieAssembly assembly_;
  std::unique_ptr<mixture_contact::Tie> tie_;
  mixture_contact::VectorXd step_start_;  ///< unknown multipliers at the start of the step

  DECLARE_FECORE_CLASS()
};
