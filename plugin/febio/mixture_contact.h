/// The contact interface <contact type="sliding-mixture">: FEBio's side of the contact core.
#pragma once

#include "ambient_concentration.h"
#include "ambient_nodes.h"
#include "clamped_concentrations.h"
#include "contact/interface/interface.h"
#include "fingerprint.h"
#include "host/contact_parameters.h"
#include "host/facet_material.h"
#include "line_search.h"
#include "mixture_surface.h"
#include "step_extrapolation.h"

#include <FEBioMech/FEContactInterface.h>

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// Gathers positions, fields and equation numbers for the core, and hands its residual and tangent to FEBio. No
/// mechanics here.
class FEMixtureContact : public FEContactInterface {
 public:
  using Side = mixture_contact::Side;

  explicit FEMixtureContact(FEModel* fem);

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

  FESurface* GetPrimarySurface() override { return &primary_; }
  FESurface* GetSecondarySurface() override { return &secondary_; }
  bool UseNodalIntegration() override { return false; }

  const mixture_contact::Effects& effects() const { return effects_; }
  /// A facet of one of the two surfaces as the core knows it.
  const mixture_contact::Facet& core_facet(const FEMixtureSurface& surface, int face) const {
    const Side side = &surface == &primary_ ? Side::primary : Side::secondary;
    return core_->mesh(side).facets[static_cast<std::size_t>(face)];
  }

 private:
  template <class T>
  using PerSide = mixture_contact::PerSide<T>;

  FEMixtureSurface& surface(Side side) { return side == Side::primary ? primary_ : secondary_; }

  // Setting up
  bool check_parameters();
  /// Whether all parameters have values that make sense; the log says which do not.
  bool have_sound_values();
  /// Takes penalties and tolerances as their load curves say at this time; false where a value makes no sense.
  bool follow_load_curves();
  bool check_surfaces();
  std::optional<FacetMaterials> materials();
  bool read_materials();
  bool check_ambient();
  /// What is wrong with an ambient concentration; empty if nothing is.
  std::string complaint(const FEMixtureAmbientConcentration& ambient) const;
  bool check_multipliers();
  std::vector<FieldAtContact> fields_of_model(const FacetMaterials& materials);
  bool decide_effects(const FacetMaterials& materials);
  Motion motion();
  void decide_traction();
  mixture_contact::SurfaceMesh surface_mesh(Side side, const std::vector<FacetMaterial>& materials);
  bool update_properties();
  void add_callbacks();
  void ask_for_nonsymmetric_matrix();
  void build_core(PerSide<mixture_contact::SurfaceMesh> meshes);

  // State of the model
  int field_dof(int field) const;
  mixture_contact::Matrix3Xd positions(Side side);
  PerSide<mixture_contact::SurfaceFields> fields();
  void project();
  void relocate_nodes();

  // Status: which points are in contact, which nodes at ambient conditions
  bool begin_iteration();
  bool leads_extrapolation();
  void begin_at_expected_state();
  /// Evaluates the bodies again, with the status that is held.
  void update_model_in_trial();
  FENewtonSolver* newton_solver();
  SolverKind solver_kind();
  static bool on_matrix_reformed(FEModel* fem, unsigned int when, void* contact);

  // Ambient conditions
  bool apply_ambient(const std::vector<FEMixtureContact*>& contacts);
  double ambient_value(int dof) const;
  std::vector<FEMixtureContact*> active_contacts();

  // Multipliers with equations of their own
  void set_multipliers(const std::vector<double>& total, const std::vector<double>& increment);
  int deformable_node();

  // Local to global
  /// Equations that stand in one block of the matrix, for each of its blocks.
  void for_each_coupling(const std::function<void(std::vector<int>&)>& use);
  Fingerprint couplings();
  void add_to_profile(FEGlobalMatrix& matrix);
  /// At the start of a step, when the iteration has begun: lets FEBio keep the shape of the matrix if nothing changed.
  void keep_matrix_if_it_fits();
  std::vector<int> node_ids(const mixture_contact::ContactInterface::Location& at);
  std::vector<int> equations(const mixture_contact::ContactInterface::Location& at, const std::vector<int>& nodes);
  /// Whether equations that nodes have are their own: none is prescribed, none comes from a rigid body.
  bool has_free_equations(const std::vector<int>& nodes, const std::vector<int>& equations);
  void store_output();
  /// Whether the iterations go on with nodes that a second pass has just noticed.
  bool notices_overlap();
  void warn_of_overlap();
  static bool on_step_solved(FEModel* fem, unsigned int when, void* contact);
  static bool on_solved(FEModel* fem, unsigned int when, void* contact);

  ContactParameters parameters_;
  std::vector<FEMixtureAmbientConcentration*> ambient_concentrations_;
  FEMixtureSurface primary_;
  FEMixtureSurface secondary_;
  AmbientNodes ambient_;
  ClampedConcentrations clamped_;
  LineSearch line_search_;
  StepExtrapolation extrapolation_;  ///< of the first active contact

  mixture_contact::Effects effects_;
  std::unique_ptr<mixture_contact::ContactInterface> core_;
  std::array<int, 3> displacement_dofs_{-1, -1, -1};
  int pressure_dof_ = -1;
  int concentration_dof_ = -1;  ///< of solute 0; the others follow
  int concentrations_ = 0;      ///< number of solutes in the model
  int first_equation_ = -1;     ///< of the multipliers, where they are unknowns; the others follow
  /// Where FEBio assembles, equations come in blocks, one per node. A block that belongs to no node would be left out
  /// of the coupling with rigid bodies, one of a rigid node be taken for a force on it: a deformable node stands for
  /// the block of multipliers.
  int multiplier_node_ = -1;
  mixture_contact::VectorXd step_start_;  ///< multipliers at the start of the step, where they are unknowns
  Fingerprint couplings_of_matrix_;       ///< as added to the matrix's profile last
  bool relocated_ = false;
  bool in_trial_ = false;           ///< an evaluation that must keep status is under way
  bool at_step_start_ = false;      ///< no trial has been evaluated in this step
  bool tried_ = false;              ///< a trial has been evaluated since the iterations began
  bool begun_ = false;              ///< an iteration has begun at this state
  bool keep_prediction_ = false;    ///< the next iteration goes on from what the last one predicts
  bool loads_changed_ = false;      ///< at the beginning of this iteration
  bool moved_ = false;              ///< the model was moved to the expected state
  int disputes_ = 0;                ///< solutions of FEBio's in this step that were none
  bool residual_outdated_ = false;  ///< FEBio's residual was evaluated with loads that have changed since
  bool has_callbacks_ = false;
  bool said_noticed_ = false;                      ///< in this run
  bool warned_of_overlap_ = false;                 ///< in this run
  mixture_contact::Stopwatch run_;                 ///< since the contact was read
  std::vector<FieldAtContact> fields_at_contact_;  ///< what the materials on both sides allow
  std::string summary_;                            ///< what the log said last of the effects
  bool may_run_ = true;                            ///< the effects asked for exist in the present step

  DECLARE_FECORE_CLASS()
};
