/// A contact between two surfaces, the class that hosts use.
#pragma once

#include "enforcement/augmentation.h"
#include "interface/measurements.h"
#include "interface/penetration_check.h"

namespace mixture_contact {

/// A contact between two surfaces. Evaluations are const; project() sets the configuration, augment() the multipliers,
/// check_penetration() the nodes that a second pass is limited to. Functions of contacts outside of the class: balances
/// and values at nodes (output.h), unknown multipliers (multipliers.h), relocation (relocation.h).
class ContactInterface {
 public:
  /// The location of a local residual or tangent.
  struct Location {
    Side first;          ///< the side of `patch.primary`, the surface integrated over
    const Patch& patch;  ///< nodes and fields
  };
  using AddResidual = std::function<void(const Location&, const VectorXd&)>;
  using AddTangent = std::function<void(const Location& rows, const Location& columns, const MatrixXd&)>;
  using AddRows = std::function<void(Side first, const IndexedVector<TangentBlock>&, double factor)>;
  using AddLoadTangent = std::function<void(Side first, const LoadBlock&)>;
  using UseLocation = std::function<void(const Location&)>;
  using UseLoadPlace = std::function<void(Side first, const LoadPlace&)>;
  using UseRows = std::function<void(Side first, const IndexedVector<TangentBlock>&)>;

  /// Throws std::invalid_argument for two passes with unknown multipliers: twice as many conditions as can be met.
  ContactInterface(PerSide<SurfaceMesh> mesh, Effects effects, Settings settings);
  ContactInterface(const ContactInterface&) = delete;
  ContactInterface& operator=(const ContactInterface&) = delete;
  ContactInterface(ContactInterface&&) = delete;
  ContactInterface& operator=(ContactInterface&&) = delete;
  ~ContactInterface() = default;

  /// Whether a projection looks for the facet again or keeps to the one that a point saw last.
  enum class Search { everywhere, same_facets };

  /// Sets the configuration: search and projection. Nothing happens if that has been done for these positions.
  void project(const PerSide<Matrix3Xd>& position, Search search = Search::everywhere);

  /// Switches the exchange of traction (Effects::traction): off where no node of either surface can move. Takes effect
  /// with the next project(); multipliers stay.
  void exchange_traction(bool traction);

  /// Begins a Newton iteration at a state (see ContactPass::begin_iteration); project() must have been called at its
  /// positions. Returns whether the loads at this state differ from those before the call, so that the residual has to
  /// be evaluated again.
  bool begin_iteration(const PerSide<SurfaceFields>& fields);
  /// Moves the linearisation of an iteration to another state (see ContactPass::linearise_at), after project().
  void linearise_at(const PerSide<SurfaceFields>& fields);
  /// Drops the linearisation of begin_iteration(): the laws act on the true gaps and jumps again.
  void end_iterations();
  /// Whether a state found in iterations is a solution of the true laws.
  bool is_solution(const PerSide<SurfaceFields>& fields) const;
  /// Whether the nodes that face contact are still those that the iteration began with.
  friend bool faces_as_held(const ContactInterface& contact);
  friend bool reconsiders_edge(ContactInterface& contact, const PerSide<SurfaceFields>& fields);
  friend void join(ContactInterface& contact, PerSide<NodeFlags> nodes);

  void residual(const PerSide<SurfaceFields>& fields, double dt, const AddResidual& add) const;
  /// Loads at nodes are load blocks if `add_load` is given and the pass has them, and blocks otherwise. `add_rows`, if
  /// given, takes the held change of the geometry by nodes, times a factor and without weak couplings (see
  /// geometric_rows.h).
  void tangent(const PerSide<SurfaceFields>& fields, double dt, const AddTangent& add,
               const AddLoadTangent& add_load = {}, const AddRows& add_rows = {}) const;
  /// The patches that tangent() would fill with the present status; those of load blocks by way of `use_load`, and
  /// those of rows by way of `use_rows`.
  void for_each_coupling(const UseLocation& use, const UseLoadPlace& use_load = {}, const UseRows& use_rows = {}) const;

  /// Accepts a state as the start of the next step: its tractions, flux-coupled nodes, and with friction the reference
  /// positions of slips. Iterations end with it.
  void accept_step(const PerSide<SurfaceFields>& fields);
  /// Drops accepted steps: loads and slips begin at the positions of the next projection.
  void forget_steps();

  /// Gaps at the current state, the larger ones of both passes; meets() compares them with the tolerances.
  GapReport gaps(const PerSide<SurfaceFields>& fields) const;

  /// One augmentation: multipliers take the current loads, and slow fields a larger penalty. Returns whether any
  /// penalty has grown.
  bool augment(const PerSide<SurfaceFields>& fields);

  /// The nodes of each surface that are in contact and flux-coupled by it; the others have the ambient values.
  PerSide<NodeFlags> nodes_in_contact() const;

  /// The nodes_in_contact() of an iteration that has begun: once in each, and only where there is an ambient. Nodes
  /// that face contact are held until the next one, so that those at the edge of contact do not come and go for ever.
  PerSide<NodeFlags> hold_nodes_in_contact();

  /// Looks, at a solution, for secondary nodes inside the primary body that no pass detects. All secondary nodes that
  /// face the same primary facets become penetration-check nodes, those of a second pass in which no others can close,
  /// and remain so: open ones bear no load. is_solution() decides whether this changes the loads. Returns the
  /// penetration detected for the first time.
  ///
  /// Nothing with two passes or self-contact, where secondary nodes have laws of their own already, and without
  /// traction: surfaces that cannot move stay as the user placed them. Penetration-check nodes keep default penalties
  /// if multipliers are unknowns: there is no room for unknowns on both surfaces.
  UndetectedPenetration check_penetration(const PerSide<SurfaceFields>& fields);

  /// The overlap without load after the last check_penetration().
  const UndetectedPenetration& undetected_penetration() const { return check_.undetected; }

  /// Replaces stiffness and conductance of a surface's facets and recomputes the penalties.
  void update_properties(PerSide<VectorXd> stiffness, PerSide<MatrixXd> conductance);

  /// Takes penalties, tolerances and the offset from these settings, which may follow load curves; the others stay as
  /// they are. A penalty of the traction that is reduced has multipliers, with Enforcement::penalty, that keep the
  /// accepted loads.
  void update_laws(const Settings& settings);

  const Effects& effects() const { return effects_; }
  const Settings& settings() const { return settings_; }
  const SurfaceMesh& mesh(Side side) const { return mesh_[side]; }
  /// The pass over the primary surface comes first.
  const ContactPass& pass(std::size_t index) const { return *passes_[index].integral; }
  ContactPass& pass(std::size_t index) { return *passes_[index].integral; }
  std::size_t passes() const { return passes_.size(); }
  /// Times of the contact, to which const hosts add their own work.
  Measurements& measurements() const { return measurements_; }

  /// All that is kept between time steps, to be stored and restored by the host.
  struct State {
    std::vector<int> check_nodes;          ///< secondary nodes that a second pass is limited to, ascending
    std::vector<Multipliers> multipliers;  ///< per pass
    PerSide<Matrix3Xd> slips_from;         ///< positions that slips are measured from; empty without friction
    std::vector<LoadCarriers> carriers;    ///< per pass, on which those of the next step depend
  };
  State state() const;
  /// Iterations end with it. Throws std::invalid_argument, and changes nothing, if the state is not one of this
  /// contact.
  void restore(State state);

 private:
  /// Restricts a second pass, which joins the first one if need be, to the penetration-check nodes.
  void restrict_second_pass();

  PerSide<SurfaceMesh> mesh_;
  Effects effects_;
  Settings settings_;
  PenetrationCheck check_;
  std::vector<SidedPass> passes_;
  PerSide<Matrix3Xd> position_;
  PerSide<Matrix3Xd> slips_from_;  ///< positions of the last accepted state; empty without friction
  bool searched_ = false;          ///< whether the last projection was a search everywhere
  mutable Measurements measurements_;
};

bool faces_as_held(const ContactInterface& contact);

/// Whether a state has edge nodes that have to be tried once more (ActiveSet::reconsiders_edge(),
/// reconsiders_facing()); it is no solution then.
bool reconsiders_edge(ContactInterface& contact, const PerSide<SurfaceFields>& fields);

/// Marks nodes of the surfaces as joined by another interaction, or frees them: joined nodes do not close, and have no
/// ambient values. Iterations end with it. The next project() finds the opposite points of the others.
void join(ContactInterface& contact, PerSide<NodeFlags> nodes);

}  // namespace mixture_contact
