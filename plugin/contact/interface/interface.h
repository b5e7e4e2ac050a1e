/// A contact between two surfaces: what a host talks to.
#pragma once

#include "base/times.h"
#include "enforcement/augmentation.h"
#include "interface/output.h"
#include "interface/penetration_check.h"

namespace mixture_contact {

/// What a contact keeps in memory.
struct Memory {
  std::size_t points = 0;  ///< integration points that see the other surface
  std::size_t bytes = 0;   ///< for them, their facets and nodes, between calls
};

/// A contact between two surfaces. Evaluations are const; project() sets the configuration, augment() the multipliers,
/// check_penetration() the nodes that a second pass is limited to.
class ContactInterface {
 public:
  /// Where a local residual or tangent belongs.
  struct Location {
    Side first;          ///< the side of `patch.primary`, the surface integrated over
    const Patch& patch;  ///< nodes and fields
  };
  using AddResidual = std::function<void(const Location&, const VectorXd&)>;
  using AddTangent = std::function<void(const Location& rows, const Location& columns, const MatrixXd&)>;

  /// Throws std::invalid_argument for two passes with unknown multipliers: twice as many conditions as can be met.
  ContactInterface(PerSide<SurfaceMesh> mesh, Effects effects, Settings settings);
  ContactInterface(const ContactInterface&) = delete;
  ContactInterface& operator=(const ContactInterface&) = delete;
  ContactInterface(ContactInterface&&) = delete;
  ContactInterface& operator=(ContactInterface&&) = delete;
  ~ContactInterface() = default;

  /// Whether a projection looks for the facet anew or keeps to the one that a point saw last.
  enum class Search { everywhere, same_facets };

  /// Sets the configuration: search and projection. Nothing happens if that has been done for these positions.
  void project(const PerSide<Matrix3Xd>& position, Search search = Search::everywhere);

  /// Switches the exchange of traction (Effects::traction): off where no node of either surface can move. Takes effect
  /// with the next project(); multipliers stay.
  void exchange_traction(bool traction);

  /// Begins a Newton iteration at a state (see ContactPass::begin_iteration); project() must have been called for its
  /// positions. Returns whether the loads at this state differ from those before the call, so that a residual is to be
  /// evaluated again.
  bool begin_iteration(const PerSide<SurfaceFields>& fields);
  /// Moves what an iteration holds to another state (see ContactPass::linearise_at), after project().
  void linearise_at(const PerSide<SurfaceFields>& fields);
  /// Forgets what begin_iteration() holds: the laws act on the true gaps and jumps again.
  void end_iterations();
  /// Whether a state found in iterations is a solution of the true laws.
  bool is_solution(const PerSide<SurfaceFields>& fields) const;

  /// Positions of the primary nodes with those that overlap the secondary surface moved onto it along their normals.
  Matrix3Xd without_overlap(const PerSide<Matrix3Xd>& position) const;

  void residual(const PerSide<SurfaceFields>& fields, double dt, const AddResidual& add) const;
  void tangent(const PerSide<SurfaceFields>& fields, double dt, const AddTangent& add) const;
  /// The patches that tangent() would fill with the present status.
  void for_each_coupling(const std::function<void(const Location&)>& use) const;

  /// Gaps at the current state, and whether they meet the tolerances; the worst of both passes.
  GapReport gaps(const PerSide<SurfaceFields>& fields) const;
  bool converged(const GapReport& report) const { return meets(report, settings_.tolerances, effects_); }

  /// Unknown multipliers (see UnknownMultipliers): none unless the enforcement says so, and then in
  /// one pass only. The host gives each an equation, and sets them with every trial state before residual() or
  /// tangent().
  MultiplierLayout multiplier_layout() const;
  VectorXd unknown_multipliers() const;
  void set_unknown_multipliers(const VectorXd& mu);

  /// One augmentation: multipliers take the current loads, and slow fields a larger penalty.
  void augment(const PerSide<SurfaceFields>& fields);

  /// Which nodes of each surface are in contact and flux-coupled by it; the others have the ambient values.
  PerSide<NodeFlags> nodes_in_contact() const;

  /// The same for an iteration that has begun: once in each, and only where there is an ambient. Nodes that face
  /// contact are held until the next one, so that those at the edge of contact do not come and go for ever.
  PerSide<NodeFlags> hold_nodes_in_contact();

  /// Looks, at a solution, for secondary nodes inside the primary body that no pass notices. All secondary nodes that
  /// face the same primary facets become nodes of a second pass, in which no others can close, and remain so: open they
  /// bear nothing. Whether that changes the loads, is_solution() tells. Returns what is noticed for the first time.
  ///
  /// Nothing with two passes, where secondary nodes have laws of their own already, and without traction: surfaces that
  /// cannot move stay as the user placed them. Beside unknown multipliers noticed nodes have the default penalties:
  /// there is no room for unknowns on both surfaces.
  UndetectedPenetration check_penetration(const PerSide<SurfaceFields>& fields);

  /// What the last check_penetration() left without load.
  const UndetectedPenetration& undetected_penetration() const { return unnoticed_; }

  Balance balance(const PerSide<SurfaceFields>& fields) const;
  NodalOutput nodal_output(Side side, const PerSide<SurfaceFields>& fields) const;

  /// Replaces stiffness and conductance of a surface's facets and recomputes the penalties.
  void update_properties(PerSide<VectorXd> stiffness, PerSide<MatrixXd> conductance);

  /// Takes penalties and tolerances from these settings, which may follow load curves; the others stay as they are.
  void update_laws(const Settings& settings);

  const Effects& effects() const { return effects_; }
  const Settings& settings() const { return settings_; }
  const SurfaceMesh& mesh(Side side) const { return mesh_[side]; }
  const ContactPass& pass(std::size_t index) const { return *passes_[index].integral; }
  std::size_t passes() const { return passes_.size(); }
  /// Largest number of bytes that an iteration kept, and the integration points that it had.
  const Memory& memory() const { return memory_; }
  /// Where the time of all calls so far went.
  const Times& times() const { return times_; }
  /// Times what a host does for a task around its calls; those are not counted twice.
  TaskClock clock(Task task) const { return TaskClock(times_[task]); }
  Multipliers& multipliers(std::size_t index) { return passes_[index].integral->laws().multipliers; }

  /// All that is kept between time steps, to be stored and restored by the host.
  struct State {
    std::vector<int> noticed;              ///< secondary nodes that a second pass is limited to, ascending
    std::vector<Multipliers> multipliers;  ///< per pass
  };
  State state() const;
  /// Iterations end with it. Throws std::invalid_argument, and changes nothing, where the state is not one of this
  /// contact.
  void restore(State state);

 private:
  Reach reach(const PerSide<Matrix3Xd>& position) const;
  void find_points(SidedPass& pass);
  NodeFlags flux_coupled(const SidedPass& pass) const;
  IndexedVector<FacingNode> facing(const SidedPass& pass, const NodeFlags& in_contact) const;
  /// Restricts a second pass, which joins the first one if need be, to the penetration-check nodes.
  void restrict_second_pass();
  void note_memory();
  AllPasses all_passes() const { return {passes_, mesh_, effects_.scalar_fields(), settings_.two_pass}; }

  PerSide<SurfaceMesh> mesh_;
  Effects effects_;
  Settings settings_;
  Settings settings_of_check_;  ///< of a second pass that is restricted to penetration-check nodes
  NodeFlags check_nodes_;       ///< secondary nodes that it is restricted to
  UndetectedPenetration unnoticed_;
  std::vector<SidedPass> passes_;
  PerSide<Matrix3Xd> position_;
  bool searched_ = false;  ///< whether the last projection was a search everywhere
  Memory memory_;
  mutable Times times_;  ///< a measurement, which no result depends on
};

}  // namespace mixture_contact
