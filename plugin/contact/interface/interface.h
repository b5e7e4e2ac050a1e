/// A contact between two surfaces, the class that hosts use.
#pragma once

#include "enforcement/augmentation.h"
#include "interface/contact_state.h"
#include "interface/measurements.h"
#include "interface/penetration_check.h"

namespace mixture_contact {

/// The last accepted state, which extends a given search radius for overlaps.
struct AcceptedState {
  PerSide<Matrix3Xd> position;  ///< positions; empty without a given search radius
  double overlap = 0;           ///< deepest overlap of points in contact [length]
};

/// A contact between two surfaces. Evaluations are const. project() sets the configuration, augment() the multipliers,
/// and check_penetration() the nodes to which a second pass is restricted. Other files have further functions of a
/// contact: balances and nodal values (output.h), unknown multipliers (multipliers.h), relocation (relocation.h).
class ContactInterface {
 public:
  /// The nodes and fields of a local residual or tangent.
  struct Location {
    Side first;          ///< side of the nodes in `patch.primary`, over whose surface the pass integrates
    const Patch& patch;  ///< nodes and fields
  };
  using AddResidual = std::function<void(const Location&, const VectorXd&)>;
  using AddTangent = std::function<void(const Location& rows, const Location& columns, const MatrixXd&)>;
  using AddRows = std::function<void(Side first, const IndexedVector<TangentBlock>&, double factor)>;
  using AddLoadTangent = std::function<void(Side first, const LoadBlock&)>;
  using UseLocation = std::function<void(const Location&)>;
  using UseLoadPlace = std::function<void(Side first, const LoadPlace&)>;
  using UseRows = std::function<void(Side first, const IndexedVector<TangentBlock>&)>;

  /// Throws std::invalid_argument for two passes with unknown multipliers, which would be twice as many conditions as
  /// the surfaces can meet.
  ContactInterface(PerSide<SurfaceMesh> mesh, Effects effects, Settings settings);
  ContactInterface(const ContactInterface&) = delete;
  ContactInterface& operator=(const ContactInterface&) = delete;
  ContactInterface(ContactInterface&&) = delete;
  ContactInterface& operator=(ContactInterface&&) = delete;
  ~ContactInterface() = default;

  /// Whether project() searches for the facet of each point, or keeps the facet of the last search.
  enum class Search { everywhere, same_facets };

  /// Sets the configuration: searches and projects. It does nothing if this was done for the same positions.
  void project(const PerSide<Matrix3Xd>& position, Search search = Search::everywhere);

  /// Enables or disables the exchange of tractions (Effects::traction); disabled if no node of either surface can move.
  /// It takes effect with the next project(). Multipliers are kept.
  void exchange_traction(bool traction);

  /// Begins a Newton iteration at a state, for whose positions project() has been called (see
  /// MovingGeometry::begin_iteration). Returns true if the loads at this state differ from those before the call, so
  /// that the residual has to be evaluated again.
  bool begin_iteration(const PerSide<SurfaceFields>& fields);
  /// Moves the linearisation point of an iteration to another state (see MovingGeometry::linearise_at), after
  /// project().
  void linearise_at(const PerSide<SurfaceFields>& fields) const;
  /// Ends the iterations: removes the linearisation, such that the laws apply to the true gaps and jumps.
  void end_iterations();
  /// True if a state at the end of iterations is a solution of the true laws.
  bool is_solution(const PerSide<SurfaceFields>& fields) const;
  /// True if the nodes that face contact are the same as at the start of the iteration.
  friend bool faces_as_held(const ContactInterface& contact);
  friend bool reconsiders_edge(ContactInterface& contact, const PerSide<SurfaceFields>& fields);
  friend void join(ContactInterface& contact, PerSide<NodeFlags> nodes);
  friend void set_immovable(ContactInterface& contact, PerSide<NodeFlags> nodes);

  /// Calls `add` with the residual of each part of (2.5). `dt`: time increment [s].
  void residual(const PerSide<SurfaceFields>& fields, double dt, const AddResidual& add) const;
  /// Calls `add` with the blocks of the tangent (2.6). `add_load` (optional) receives nodal loads as load blocks where
  /// possible. `add_rows` (optional) receives the held geometric part by nodes, with a factor and without weak
  /// couplings (see geometric_rows.h).
  void tangent(const PerSide<SurfaceFields>& fields, double dt, const AddTangent& add,
               const AddLoadTangent& add_load = {}, const AddRows& add_rows = {}) const;
  /// Calls `use` with each patch of tangent() for the present status. `use_load` and `use_rows` (both optional) receive
  /// the couplings of load blocks and of rows.
  void for_each_coupling(const UseLocation& use, const UseLoadPlace& use_load = {}, const UseRows& use_rows = {}) const;

  /// Accepts a state as the start of the next step: its tractions, flux-coupled nodes and, with friction, the reference
  /// positions of slips. This ends the iterations.
  void accept_step(const PerSide<SurfaceFields>& fields);
  /// Discards accepted steps: loads and slips begin at the positions of the next projection.
  void forget_steps();

  /// The errors in the contact conditions at the present state, the larger ones of both passes; meets() compares them
  /// with the tolerances.
  GapReport gaps(const PerSide<SurfaceFields>& fields) const;

  /// Performs an augmentation: multipliers become the present loads, and fields that converge slowly get a larger
  /// penalty. Returns true if a penalty has grown.
  bool augment(const PerSide<SurfaceFields>& fields);

  /// The nodes of each surface that are in contact and flux-coupled; all other nodes have ambient values.
  PerSide<NodeFlags> nodes_in_contact() const;

  /// The nodes_in_contact() of an iteration that has begun. To be called once per iteration, if nodes can have ambient
  /// values. Nodes that face contact keep this status until the next iteration, such that those at the edge do not
  /// alternate for ever.
  PerSide<NodeFlags> hold_nodes_in_contact();

  /// Searches, at a solution, for secondary nodes inside the primary body that no pass detects. All secondary nodes
  /// that face the same primary facets become penetration-check nodes, permanently; only these can close in a second
  /// pass. Open ones bear no load. is_solution() decides whether this changes the loads. Returns the penetration that
  /// was detected for the first time.
  ///
  /// It finds nothing with two passes or self-contact, where secondary nodes have laws of their own, and without
  /// traction, where surfaces that cannot move may overlap. If multipliers are unknowns, penetration-check nodes have
  /// default penalties, because unknowns are not possible on both surfaces.
  UndetectedPenetration check_penetration(const PerSide<SurfaceFields>& fields);

  /// The overlap without load found by the last check_penetration().
  const UndetectedPenetration& undetected_penetration() const { return check_.undetected; }

  /// Sets stiffness and conductance of the facets of both surfaces, and computes the penalties again.
  void update_properties(PerSide<VectorXd> stiffness, PerSide<MatrixXd> conductance);

  /// Sets penalties, friction, membrane, tolerances and the offset from `settings`, which may follow load curves; other
  /// settings stay the same. With Enforcement::penalty, a reduced traction penalty has multipliers that keep the
  /// accepted loads.
  void update_laws(const Settings& settings);

  const Effects& effects() const { return effects_; }
  const Settings& settings() const { return settings_; }
  const SurfaceMesh& mesh(Side side) const { return mesh_[side]; }
  /// The pass with this index; index 0 is the pass over the primary surface.
  const ContactPass& pass(std::size_t index) const { return *passes_[index].integral; }
  ContactPass& pass(std::size_t index) { return *passes_[index].integral; }
  std::size_t passes() const { return passes_.size(); }
  /// Times and memory of the contact; const, because hosts add the time of their own work.
  Measurements& measurements() const { return measurements_; }

  using State = ContactState;
  State state() const;
  /// Sets the state, which ends the iterations. Throws std::invalid_argument without any change if the state does not
  /// fit this contact.
  void restore(State state);

 private:
  /// Restricts the second pass to the penetration-check nodes. It makes this pass if there is none.
  void restrict_second_pass();

  PerSide<SurfaceMesh> mesh_;
  Effects effects_;
  Settings settings_;
  PenetrationCheck check_;
  std::vector<SidedPass> passes_;
  PerSide<Matrix3Xd> position_;
  AcceptedState accepted_;
  bool searched_ = false;  ///< true if the last projection was a search for all points
  mutable Measurements measurements_;
};

/// Calls use(side, geometry) for each pass whose surfaces move. `side`: the surface over which it integrates.
template <class Use>
void for_each_moving(const ContactInterface& contact, const Use& use) {
  for (std::size_t pass = 0; pass < contact.passes(); ++pass) {
    ContactGeometry& geometry = contact.pass(pass).geometry();
    if (geometry.moving() != nullptr) use(both_sides.at(pass), *geometry.moving());
  }
}

/// True if the nodes that face contact are the same as at the start of the iteration.
bool faces_as_held(const ContactInterface& contact);

/// True if a state has edge nodes that have to be tried once more (ActiveSet::reconsiders_edge(),
/// reconsiders_facing()); it is not a solution then.
bool reconsiders_edge(ContactInterface& contact, const PerSide<SurfaceFields>& fields);

/// Marks nodes of both surfaces as joined by another interaction such as a tie, or as free. Joined nodes do not close
/// and have no ambient values. This ends the iterations. The next project() finds the opposite points of the free
/// nodes.
void join(ContactInterface& contact, PerSide<NodeFlags> nodes);

/// Sets the nodes of both surfaces that no solution can move (SurfaceMesh::immovable), and computes the penalties
/// again.
void set_immovable(ContactInterface& contact, PerSide<NodeFlags> nodes);

/// Decides status and loads at a state for a residual without a tangent, for explicit dynamics (see
/// MovingGeometry::hold_loads). project() has to be called before.
void hold_loads(const ContactInterface& contact, const PerSide<SurfaceFields>& fields);

/// Discards the data of past iterations and steps, such that later iterations depend on the state only. A continued run
/// then gives the same results.
void forget_past(const ContactInterface& contact);

}  // namespace mixture_contact
