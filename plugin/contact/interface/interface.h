/// A contact between two surfaces: what a host talks to.
#pragma once

#include "base/times.h"
#include "interface/augmentation.h"

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace mixture_contact {

/// The two surfaces of a contact, in the host's order.
enum class Side { primary = 0, secondary = 1 };
inline constexpr std::array<Side, 2> both_sides{Side::primary, Side::secondary};

template <class T>
class PerSide : public std::array<T, 2> {
 public:
  T& operator[](Side side) { return this->at(static_cast<std::size_t>(side)); }
  const T& operator[](Side side) const { return this->at(static_cast<std::size_t>(side)); }
};

inline Side other(Side side) { return side == Side::primary ? Side::secondary : Side::primary; }

/// What crosses the interface, as it acts on the primary surface; the secondary surface gets the exact opposite.
struct Balance {
  Vector3d force{0, 0, 0};  ///< contact force on the primary surface [N]
  double area = 0;          ///< area in contact [mm^2]
  VectorXd flow;            ///< flow out of the primary body per exchanged field [mm^3/s] or [nmol/s]
};

/// Values at the nodes of a surface for output, from the points in contact around each.
struct NodalOutput {
  VectorXd gap;       ///< [mm]
  VectorXd pressure;  ///< -t_n [MPa]
  MatrixXd flux;      ///< (fields, nodes), out of this surface's body
  MatrixXd jump;      ///< (fields, nodes), this side minus the other
  VectorXd coverage;  ///< area in contact that belongs to the node [mm^2]
};

/// A node counts as in contact where the contact of the nodes facing it, by the pass over their surface and
/// interpolated, reaches this share; with two passes also where its own pass has it in contact.
inline constexpr double covered = 0.5 - 1e-9;

/// What a node of the surface that a pass does not integrate over faces.
struct FacingNode {
  int facet = -1;  ///< of the surface integrated over; -1: none
  double gap = 0;  ///< along the node's own normal [mm]
  bool in_contact = false;
};

/// Secondary nodes inside the primary body at facets away from contact, which share no node with one that has a node in
/// contact. The laws hold as averages around primary nodes: what is smaller than a primary facet may overlap it without
/// any load, unless a second pass notices it. Beside facets in contact the average reaches that far: an overlap there
/// is the error of the edge of contact, which no second law mends.
struct UnnoticedOverlap {
  int nodes = 0;     ///< how many lie deeper than sound_overlap
  double depth = 0;  ///< of the deepest [mm]
  double share = 0;  ///< largest depth over the longest edge of the facet that the node faces [-]
};

/// What sound meshes show, relative to the longest edge of a facet: a facet bulges out of the arc between its ends, or
/// stays behind it, by 1/8 of the angle of that arc, here 0.4 (16 facets around a circle).
inline constexpr double sound_overlap = 0.05;

/// What a contact keeps in memory.
struct Memory {
  std::size_t points = 0;  ///< integration points that see the other surface
  std::size_t bytes = 0;   ///< for them, their facets and nodes, between calls
};

/// A contact between two surfaces. Evaluations are const; project() sets the configuration, augment() the multipliers,
/// notice_overlap() the nodes that a second pass is limited to.
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
  /// Moves what an iteration holds to another state (see ContactPass::move_iteration), after project().
  void move_iteration(const PerSide<SurfaceFields>& fields);
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

  /// Unknown multipliers (see ContactPass::has_unknown_multipliers): none unless the enforcement says so, and then in
  /// one pass only. The host gives each an equation, and sets them with every trial state before residual() or
  /// tangent().
  MultiplierLayout multiplier_layout() const;
  VectorXd unknown_multipliers() const;
  void set_unknown_multipliers(const VectorXd& mu);

  /// One augmentation: multipliers take the current loads, and slow fields a larger penalty.
  void augment(const PerSide<SurfaceFields>& fields);

  /// Which nodes of each surface are in contact and sealed by it; the others see the bath.
  PerSide<std::vector<bool>> nodes_in_contact() const;

  /// The same for an iteration that has begun: once in each, and only where there is a bath. Nodes that face contact
  /// are held until the next one, so that those at the edge of contact do not come and go for ever.
  PerSide<std::vector<bool>> hold_nodes_in_contact();

  /// Looks, at a solution, for secondary nodes inside the primary body that no pass notices. All secondary nodes that
  /// face the same primary facets become nodes of a second pass, in which no others can close, and remain so: open they
  /// bear nothing. Whether that changes the loads, is_solution() tells. Returns what is noticed for the first time.
  ///
  /// Nothing with two passes, where secondary nodes have laws of their own already, and without traction: surfaces that
  /// cannot move stay as the user placed them. Beside unknown multipliers noticed nodes have the default penalties:
  /// there is no room for unknowns on both surfaces.
  UnnoticedOverlap notice_overlap(const PerSide<SurfaceFields>& fields);

  /// What the last notice_overlap() left without load.
  const UnnoticedOverlap& unnoticed_overlap() const { return unnoticed_; }

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
  Multipliers& multipliers(std::size_t index) { return passes_[index].integral->multipliers; }

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
  struct Pass {
    Side side;  ///< the surface integrated over
    std::unique_ptr<ContactPass> integral;
    std::optional<std::vector<bool>> faced;  ///< nodes of the other surface that face contact, during iterations
    std::vector<int> faced_changes;          ///< of these, since the iterations began
  };

  Pass make_pass(Side side, const Settings& settings) const;
  void find_points(Pass& pass);
  /// For each secondary node, its overlap with a primary facet away from contact, over the facet's longest edge; else
  /// 0.
  VectorXd overlap_shares(const std::vector<FacingNode>& nodes, const std::vector<bool>& primary_in_contact) const;
  void notice(const std::vector<FacingNode>& nodes, const VectorXd& shares, const PerSide<SurfaceFields>& fields);
  void limit_second_pass();
  /// Throws std::invalid_argument unless a state has this contact's nodes, fields and passes.
  void check(const State& state) const;
  /// Area in contact that belongs to each node of a side, given that of each pass: two full passes cover the same area,
  /// each with the errors of its own integration; a pass of noticed nodes covers what the first one leaves, and its
  /// edge.
  VectorXd coverage(const std::vector<VectorXd>& areas) const;
  /// The facet of one side that a point lies on, or faces; `integrated`: whether its pass integrates over that side.
  const Facet& facet_at(const PointContact& contact, Side side, bool integrated) const;
  double search_radius(const PerSide<Matrix3Xd>& position) const;
  void hold_facing_contact(Pass& pass);
  std::vector<bool> sealed_nodes(const Pass& pass) const;
  void note_memory();
  /// What the nodes of the surface that a pass does not integrate over face, given which of its own are in contact.
  std::vector<FacingNode> facing_nodes(const Pass& pass, const std::vector<bool>& in_contact) const;

  PerSide<SurfaceMesh> mesh_;
  Effects effects_;
  Settings settings_;
  Settings settings_of_noticed_;  ///< of a second pass that is limited to noticed nodes
  std::vector<bool> noticed_;     ///< secondary nodes that it is limited to
  UnnoticedOverlap unnoticed_;
  std::vector<Pass> passes_;
  PerSide<Matrix3Xd> position_;
  bool searched_ = false;  ///< whether the last projection was a search everywhere
  Memory memory_;
  mutable Times times_;  ///< a measurement, which no result depends on
};

}  // namespace mixture_contact
