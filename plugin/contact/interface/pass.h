/// One pass of a contact: the integral (2.5) over one surface against the other.
#pragma once

#include "base/patch.h"
#include "base/times.h"
#include "integration/points.h"
#include "law/penalty.h"
#include "law/point_integral.h"

#include <functional>
#include <optional>
#include <vector>

namespace mixture_contact {

/// A node whose status changes more often within a time step is at the edge of contact: it came, went and came again.
inline constexpr int most_status_changes = 3;
/// Where a node has changed more often than this within a time step, nodes that change together lead each other round
/// in circles: from then on they change one at a time.
inline constexpr int most_joint_changes = 2 * most_status_changes;
/// As most_status_changes, for nodes of the surface that faces the primary one, a change earlier. One that went and
/// came back is not at the edge: where a surface slides over a finer one many do, and they would empty it into the
/// bath.
inline constexpr int most_facing_changes = 2;

/// Of what is seen from one facet, per node of it: INT psi_a da [mm^2] and INT psi_a g da [mm^3], shape (2, n).
using SeenGaps = Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor, 2, max_facet_nodes>;

/// Multipliers of the nodes of the primary surface: the state that only an augmentation changes, or, where multipliers
/// are unknowns, the host with every trial state.
struct Multipliers {
  VectorXd traction;           ///< lambda_n per node [MPa]
  MatrixXd flux;               ///< lambda per (field, node)
  double traction_growth = 1;  ///< factor on eps_n that slow augmentations have built up
  VectorXd flux_growth;        ///< the same per field
};

/// What the laws (2.7)-(2.9) say at the nodes of the primary surface, from averages around each node:
/// g_a = INT psi_a g da / INT psi_a da, jumps alike. Traction and fluxes between nodes are interpolated with psi_a.
///
/// Laws at nodes instead of integration points: as many conditions as the surface has nodes can be met at once.
/// Conditions at more points than that fight each other where meshes do not match, and some of them open and close in
/// turn.
struct NodalLoads {
  VectorXd area;      ///< INT psi_a da over points that see the other surface [mm^2]
  VectorXd gap;       ///< g_a [mm]
  VectorXd traction;  ///< t_a [MPa]; 0 out of contact
  std::vector<bool> in_contact;
  std::vector<bool> sealed;  ///< in contact, and so exchanging fluxes with the other side instead of with the bath
  MatrixXd flux_area;        ///< (fields, nodes): INT psi_a da over points where both sides have the field [mm^2]
  MatrixXd jump;             ///< (fields, nodes)
  MatrixXd flux;             ///< (fields, nodes); 0 out of contact
};

/// Everything at one integration point that carries load.
struct PointContact {
  const FacetPair* pair = nullptr;
  PointKinematics kinematics;
  FacetVector psi;             ///< psi_a here
  FacetGradient psi_gradient;  ///< psi_a,alpha
  std::vector<int> fields;     ///< exchanged scalar fields here, as indices into Effects' order
  PairFields values;           ///< their nodal values
  PointLoads loads;  ///< interpolated from the nodes; derivatives are 0 since they belong to the nodes' averages
};

/// A point with the first variations of its kinematics.
struct VaryingPoint {
  PointContact contact;
  KinematicVariations vary;
};

/// The integral over one surface. Evaluations are const; only project() replaces the pairs, only augment (through
/// `multipliers`) the state.
class ContactPass {
 public:
  ContactPass(const SurfaceMesh& primary, const SurfaceMesh& secondary, const Effects& effects,
              const Settings& settings);

  /// Projects every integration point onto the secondary surface: of the facets that face it within `radius`, the
  /// nearest.
  void project(const Matrix3Xd& x1, const Matrix3Xd& x2, double radius);

  /// The same without a search: points keep to the facets that the last project() found for them.
  void project_on_same_facets(const Matrix3Xd& x1, const Matrix3Xd& x2);

  /// Begins a Newton iteration at a state: decides which nodes are in contact, and holds that and the linearisation of
  /// their gaps and jumps until the next call. Within the iteration and its line search loads are then linear in the
  /// unknowns and no status changes.
  ///
  /// Status: a node in contact stays so while its load, as the last iteration predicts it, is compressive; a node out
  /// of contact enters where it overlaps (primal-dual active sets, Hintermueller, Ito and Kunisch 2002). Linearised
  /// gaps: the load predicted by the linear solve is not multiplied by the second-order error of the gap times a large
  /// penalty, which would make it useless as a measure of contact and as a geometric stiffness (mixed integration
  /// points, Magisano, Leonetti and Garcea 2017).
  ///
  /// A node whose status keeps changing is at the edge of contact: sealed it opens, at the bath's pressure it closes.
  /// There traction and pressure both tend to those of the bath, so it is in contact but not sealed from then on. Where
  /// nodes keep changing together, closed pulled and open overlapping, the first of those that would change does so
  /// alone (least index rule, Murty 1974, Opsearch 11:123-130, which ends where each load grows with its own gap
  /// however the others are held: a P matrix).
  ///
  /// Returns whether the loads at this state differ from those before the call.
  bool begin_iteration(const SurfaceFields& primary, const SurfaceFields& secondary);

  /// Lets only some nodes close, all of whose facets then take part, and no others. Takes effect with the next
  /// project().
  void limit_to(std::vector<bool> nodes) { limited_to_ = std::move(nodes); }

  /// Begins an iteration with every node open: for a pass that joins others within a step.
  void begin_open(const SurfaceFields& primary, const SurfaceFields& secondary);

  /// Moves what an iteration holds to another state of the fields, at which project() has been called: gaps and jumps
  /// are measured and linearised there, while status and predicted loads remain. Nodes that see nothing there open, and
  /// those that overlap there close.
  void move_iteration(const SurfaceFields& primary, const SurfaceFields& secondary);

  /// Uzawa's update: the loads of an equilibrium become the multipliers, lambda <- t_n, w_n, j_n; nodes out of contact
  /// get zero, and multipliers of tractions that are not exchanged stay. The next begin_iteration() takes them for the
  /// geometric part of the tangent, since what the laws say until the gaps are closed, lambda + eps g, is up to twice
  /// the load in equilibrium.
  void augment(const SurfaceFields& primary, const SurfaceFields& secondary);

  /// Forgets what begin_iteration() holds: the laws act on the true gaps and jumps again.
  void end_iterations();

  /// Forgets the configuration: to be called after the effects have changed, before the next project().
  void forget();

  /// Whether a state is a solution of the true laws to a fraction of the loads: a state found with held status and gaps
  /// counts only then.
  bool is_solution(const SurfaceFields& primary, const SurfaceFields& secondary) const;

  /// Calls `use` for every point that carries load, in a fixed order.
  void for_each_contact(const SurfaceFields& primary, const SurfaceFields& secondary, double dt,
                        const std::function<void(const PointContact&)>& use) const;

  /// What the laws say at the nodes.
  NodalLoads nodal_loads(const SurfaceFields& primary, const SurfaceFields& secondary) const;

  /// Residual of (2.5), in one part per pair of facets that carries load.
  void residual(const SurfaceFields& primary, const SurfaceFields& secondary, double dt,
                const std::function<void(const Patch&, const VectorXd&)>& add) const;

  /// Tangent (2.6), effect by effect: the geometric part per pair of facets that carries load, and per node in contact
  /// the part of its laws, which couples all nodes that its averages are taken over.
  void tangent(const SurfaceFields& primary, const SurfaceFields& secondary, double dt,
               const std::function<void(const TangentBlock&)>& add) const;

  /// The patches that tangent() would fill: what a matrix profile has to hold.
  void for_each_coupling(const Matrix3Xd& x1, const Matrix3Xd& x2, const std::function<void(const Patch&)>& use) const;

  /// Which primary nodes are in contact and sealed by it; the others see the bath.
  std::vector<bool> sealed_nodes(const Matrix3Xd& x1, const Matrix3Xd& x2) const;

  /// Functions psi_a of a primary facet at a place on it, which weight averages and interpolate loads: those of
  /// multiplier_functions(), but that on segments nodes covered least have shared theirs out among the others of the
  /// facet. Far from its node a psi_a says next to nothing, and conditions on such averages contradict those of the
  /// nodes that bear the load.
  ShapeFunctions multiplier_shape(int primary_facet, int sub_facet, const Vector2d& xi) const;

  /// Recomputes the penalties after the properties of the surfaces have changed.
  void update_penalties();

  /// Whether multipliers are unknowns (Enforcement::lagrange_multipliers). Each has an equation then, in residual() and
  /// tangent(): gap or jump = 0 in contact, mu = 0 elsewhere (laws.h), weighted such that the equation is in the units
  /// of the residual of its field, and rows and columns of the tangent are alike.
  bool has_unknown_multipliers() const { return settings_.enforcement == Enforcement::lagrange_multipliers; }
  Enforcement enforcement() const { return settings_.enforcement; }
  MultiplierLayout multiplier_layout() const { return {primary_.nodes, effects_.scalar_fields(), effects_.traction}; }
  /// The unknowns mu = lambda/k in the order of multiplier_layout() [mm, and the units of the fields].
  VectorXd unknown_multipliers() const;
  void set_unknown_multipliers(const VectorXd& mu);

  /// The pairs of facets that see each other, with their integration points.
  const std::vector<FacetPair>& pairs() const { return pairs_; }
  /// Penalties of the primary nodes.
  const Penalties& penalty() const { return penalties_; }
  /// Per field; values and jumps below this are rounding: of the field itself and, as the solvent's pressure comes from
  /// the motion of the solid, of the stress that rounding of positions makes of the stiffness.
  VectorXd field_rounding(const SurfaceFields& primary, const SurfaceFields& secondary) const;
  /// How many integration points see the other surface.
  std::size_t points() const;
  /// Bytes of what is kept between calls: pairs with their points, multipliers, penalties, and what iterations hold.
  std::size_t memory() const;
  /// What linearising and tangent() spend on single effects; whoever times them takes it.
  EffectTimes& effect_times() const { return effect_times_; }

  Multipliers multipliers;

 private:
  /// First variations of a node's averages and the virtual work of its loads, as local vectors of the patch around it.
  /// Where multipliers are unknowns every node has one, out of contact of its multipliers alone.
  struct NodeLinearisation {
    /// Of the jump of one field; the virtual work of its flux is weights times the node's flux_area.
    struct Jump {
      VectorXd drift;    ///< with the displacements, as gap_variation
      VectorXd weights;  ///< with the field's nodal values, in the order of patch.of_field(field, false)
    };
    Patch patch;
    VectorXd gap_variation;   ///< dg_a, in the order of patch.of_displacements()
    VectorXd traction_work;   ///< sum_q w psi_a h a, in the same order
    std::vector<Jump> jumps;  ///< per field of the patch

    bool empty() const { return patch.primary.empty() && !patch.multiplier_node; }
  };

  /// What holds during a Newton iteration.
  struct Held {
    NodalLoads loads;                      ///< at the beginning of the iteration
    std::vector<NodeLinearisation> nodes;  ///< empty for nodes out of contact
    SurfaceFields primary;                 ///< where the linearisation was taken
    SurfaceFields secondary;
    VectorXd geometric_traction;  ///< predicted t_a, for the geometric part of the tangent
    MatrixXd geometric_flux;
    std::vector<int> changes;     ///< of each node's status since the iterations began
    VectorXd multiplier_weights;  ///< of the equations of unknown multipliers, in the order of multiplier_layout()
  };

  /// Surfaces that cannot move: jumps are linear in the fields, with coefficients that are found once.
  struct Frozen {
    NodalLoads geometry;                   ///< areas, gaps and status
    std::vector<NodeLinearisation> nodes;  ///< without displacements; empty for nodes out of contact
  };

  const Facet& primary_facet(const FacetPair& pair) const;
  const Facet& secondary_facet(const FacetPair& pair) const;
  /// Takes pairs of facets that see each other with their points.
  void see(std::vector<FacetPair> pairs, const Matrix3Xd& x1, const Matrix3Xd& x2);
  /// Of the facets that are seen for the first time in a step.
  void find_bearing_nodes(const Matrix3Xd& x1, const Matrix3Xd& x2);
  PointKinematics kinematics(const FacetPair& pair, const IntegrationPoint& point, const Matrix3Xd& x1,
                             const Matrix3Xd& x2) const;
  PairVector pair_values(const FacetPair& pair, int field, const SurfaceFields& primary,
                         const SurfaceFields& secondary) const;
  std::vector<int> exchanged_fields(const FacetPair& pair) const;
  Patch facet_patch(const FacetPair& pair) const;

  SeenGaps gap_sums(const FacetPair& pair, const Matrix3Xd& x1, const Matrix3Xd& x2) const;
  void average_gaps(const Matrix3Xd& x1, const Matrix3Xd& x2, NodalLoads& loads) const;
  void average_jumps(const SurfaceFields& primary, const SurfaceFields& secondary, NodalLoads& loads) const;
  double traction_penalty(Index node) const { return multipliers.traction_growth * penalties_.traction[node]; }
  double flux_penalty(int field, Index node) const {
    return multipliers.flux_growth[field] * penalties_.flux(field, node);
  }
  Frozen freeze(const Matrix3Xd& x1, const Matrix3Xd& x2) const;
  NodalLoads frozen_loads(const Frozen& frozen, const SurfaceFields& primary, const SurfaceFields& secondary) const;
  static VectorXd frozen_residual(Index node, const NodeLinearisation& linear, const NodalLoads& loads, double dt);
  NodalLoads averages(const SurfaceFields& primary, const SurfaceFields& secondary, std::vector<bool> in_contact,
                      std::vector<bool> sealed) const;
  NodalLoads predicted_loads(const Held& held, const SurfaceFields& primary, const SurfaceFields& secondary) const;
  void apply_laws(NodalLoads& loads) const;
  /// Whether a node exchanges a field with the other side.
  static bool passes(const NodalLoads& loads, int field, Index node) {
    return loads.sealed[static_cast<std::size_t>(node)] && loads.flux_area(field, node) > 0;
  }
  static bool seen(const NodalLoads& loads, Index node);
  /// What a large penalty makes of the rounding of gaps [MPa].
  double traction_rounding() const;
  double negligible_traction(const NodalLoads& loads) const;
  /// Whether a node that is not in contact comes into it, given what it sees.
  bool closes(const NodalLoads& now, Index node, double negligible) const;
  bool loads_differ(const NodalLoads& one, const NodalLoads& other, double part, const SurfaceFields& primary,
                    const SurfaceFields& secondary) const;
  std::vector<bool> natural_status(const Matrix3Xd& x1, const Matrix3Xd& x2) const;
  std::vector<bool> next_status(const SurfaceFields& primary, const SurfaceFields& secondary) const;
  PointContact contact(const FacetPair& pair, const IntegrationPoint& place, const NodalLoads& loads,
                       const SurfaceFields& primary, const SurfaceFields& secondary, double dt) const;
  bool carries_load(const FacetPair& pair, const std::vector<bool>& in_contact) const;
  bool may_close(Index node) const { return !limited_to_ || (*limited_to_)[static_cast<std::size_t>(node)]; }
  void keep_limited();
  Held held_at(const SurfaceFields& primary, const SurfaceFields& secondary, std::vector<bool> in_contact,
               std::vector<bool> sealed) const;
  std::vector<std::vector<const FacetPair*>> pairs_around_nodes(const std::vector<bool>& in_contact) const;
  Patch node_patch(Index node, const std::vector<const FacetPair*>& pairs) const;
  std::vector<NodeLinearisation> linearise(const NodalLoads& loads, const SurfaceFields& primary,
                                           const SurfaceFields& secondary) const;
  static double jump_of(const NodeLinearisation& linear, std::size_t k, const SurfaceFields& primary,
                        const SurfaceFields& secondary);
  static NodeLinearisation zero_linearisation(const Patch& patch);
  static void add(NodeLinearisation& sum, const NodeLinearisation& pair);
  std::vector<VaryingPoint> varying_points(const FacetPair& pair, const NodalLoads& loads, const SurfaceFields& primary,
                                           const SurfaceFields& secondary, double dt) const;
  static PointShare share_of(const VaryingPoint& point, Index corner);
  static void add_gap(NodeLinearisation& linear, const NodalLoads& loads, Index node, const VaryingPoint& point,
                      const PointShare& share);
  static void add_jump(NodeLinearisation& linear, std::size_t k, const NodalLoads& loads, Index node,
                       const VaryingPoint& point, const PointShare& share);
  std::vector<NodeLinearisation> linearise_corners(const FacetPair& pair, const NodalLoads& loads,
                                                   const SurfaceFields& primary, const SurfaceFields& secondary) const;
  void pair_residuals(const NodalLoads& loads, const SurfaceFields& primary, const SurfaceFields& secondary, double dt,
                      const std::function<void(const Patch&, const VectorXd&)>& add) const;
  std::vector<TangentBlock> law_tangent(Index node, const NodeLinearisation& linear, const NodalLoads& loads,
                                        double dt) const;
  std::vector<TangentBlock> geometric_tangent(const FacetPair& pair, const NodalLoads& loads,
                                              const SurfaceFields& primary, const SurfaceFields& secondary,
                                              double dt) const;
  Patch field_columns(const Patch& patch, int field) const;
  TangentBlock traction_block(const Patch& patch, MatrixXd values) const;
  static VectorXd jump_row(const NodeLinearisation::Jump& jump, const Patch& columns);

  // Multipliers as unknowns
  double traction_unit(Index node) const;
  double flux_unit(int field, Index node) const;
  VectorXd multiplier_weights(const NodalLoads& loads, const Matrix3Xd& x1) const;
  VectorXd present_multiplier_weights(const NodalLoads& loads, const Matrix3Xd& x1) const;
  ConditionValue traction_condition(Index node, const NodalLoads& loads) const;
  ConditionValue flux_condition(int field, Index node, const NodalLoads& loads) const;
  VectorXd multiplier_residual(Index node, const NodalLoads& loads, const VectorXd& weights, double dt) const;
  TangentBlock traction_multiplier_tangent(Index node, const NodeLinearisation& linear, const NodalLoads& loads,
                                           const VectorXd& weights) const;
  TangentBlock flux_multiplier_tangent(int field, Index node, const NodeLinearisation& linear, const NodalLoads& loads,
                                       const VectorXd& weights, double dt) const;
  std::vector<TangentBlock> multiplier_tangent(Index node, const NodeLinearisation& linear, const NodalLoads& loads,
                                               const VectorXd& weights, double dt) const;

  /// Surfaces closer than this part of their size touch to rounding.
  static constexpr double touch_fraction = 1e-10;
  /// Rounding of averaged gaps and jumps, over the size of the surface or the field.
  static constexpr double rounding_fraction = 1e-13;

  const SurfaceMesh& primary_;
  const SurfaceMesh& secondary_;
  const Effects& effects_;
  const Settings& settings_;
  Penalties penalties_;
  std::unique_ptr<PointFinder> points_;
  std::vector<FacetPair> pairs_;
  std::optional<std::vector<bool>> limited_to_;  ///< nodes that may close; none: all
  std::optional<Held> held_;
  bool augmented_ = false;            ///< since the last iteration began
  mutable EffectTimes effect_times_;  ///< a measurement, which no result depends on
  std::optional<Frozen> frozen_;      ///< where no traction is exchanged
  std::vector<FacetVector> bearing_;  ///< per facet which of its nodes bear load, 1 or 0, decided where it is first
                                      ///< seen in a step; on segments alone
  double radius_ = 0;                 ///< within which the last project() looked for facets [mm]
  double touch_ = 0;                  ///< distance at which surfaces touch to rounding [mm]
};

}  // namespace mixture_contact
