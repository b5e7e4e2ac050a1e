/// Conditions between the friction traction and the slip at nodes: none, or Coulomb friction. Callers use both in the
/// same way.
#pragma once

#include "base/polymorphic.h"
#include "conditions/friction.h"
#include "conditions/nodal_loads.h"

#include <functional>

namespace mixture_contact {

struct Multipliers;
class NodalLaws;

/// Decides which nodes slide and which have a positive friction bound, from the loads at a state.
using DecideFriction = std::function<FrictionStatus(const NodalLoads& now)>;

/// The tangential condition at the nodes of a surface. This class is the condition without friction, which has no
/// unknown, no load and no state: its functions do nothing.
class TangentialCondition : public Polymorphic {
 public:
  /// The number of conditions at a node.
  virtual Index count() const { return 0; }
  /// Discards the friction and the slip status of accepted steps.
  virtual void forget(Index /*nodes*/, Multipliers& /*multipliers*/) const {}
  /// Sets the friction of the nodes in contact from their slips and normal tractions.
  virtual void load(const NodalLaws& /*laws*/, NodalLoads& /*loads*/) const {}
  /// Begins an iteration at the state of `loads`: sets status, reference and traction. The reference consists of the
  /// trials and bounds that the previous iteration predicted, if given, else of its own. For a node that closed after
  /// an iteration, the direction of friction therefore stays fixed: with a large penalty, the bound from its overlap is
  /// much too large.
  virtual void begin(const NodalLaws& /*laws*/, const DecideFriction& /*decide*/, const NodalLoads* /*predicted*/,
                     NodalLoads& /*loads*/) const {}
  /// Accepts the present friction and slip status.
  virtual void accept(const NodalLoads& /*loads*/, Multipliers& /*multipliers*/) const {}
};

/// Coulomb friction (conditions/friction.h), with penalties and multipliers of the last accepted step.
class Coulomb final : public TangentialCondition {
 public:
  Index count() const override { return 1; }
  void forget(Index nodes, Multipliers& multipliers) const override;
  void load(const NodalLaws& laws, NodalLoads& loads) const override;
  void begin(const NodalLaws& laws, const DecideFriction& decide, const NodalLoads* predicted,
             NodalLoads& loads) const override;
  void accept(const NodalLoads& loads, Multipliers& multipliers) const override;
};

/// The condition of a contact.
const TangentialCondition& tangential_condition(FrictionKind kind);

/// A node's trial friction with the vectors from which it is formed.
struct FrictionTrial {
  Vector3d normal;   ///< mean normal n_a
  Vector3d past;     ///< vector lambda_T - eps_T s_a, in the configuration at the start of the step
  Vector3d carried;  ///< vector F_a (lambda_T - eps_T s_a), in the present configuration
  Vector3d value;    ///< trial friction tau_a = (1 - n_a n_a) F_a (lambda_T - eps_T s_a)
};

/// The trial friction of a node.
FrictionTrial friction_trial(const NodalLaws& laws, const NodalFriction& friction, Index node);
/// The trial friction of a vector `past` in the tangent plane at the start of the step, mapped to the present tangent
/// plane.
FrictionTrial carried_trial(const NodalFriction& friction, Index node, const Vector3d& past);

/// The friction bound of a node.
FrictionBound friction_bound(const NodalLaws& laws, const NodalLoads& loads, Index node);
/// The friction bound without <>. A node has a positive friction bound if it is positive.
double rubbing(const NodalLaws& laws, const NodalLoads& loads, Index node);
/// The nodes in contact whose trial exceeds the bound; they slide before any decision.
NodeFlags beyond_bound(const NodalLaws& laws, const NodalLoads& loads);

/// The friction traction of a node in contact, by its status stick or slip.
FrictionTraction friction_law(const NodalLoads& loads, Index node);

/// The error of a node in contact in the condition of stick, with its load.
struct ElasticSlip {
  double slip = 0;      ///< slip of a sticking node in its tangent plane, where friction opposes it [mm]
  double traction = 0;  ///< size of the friction traction [MPa]
};
ElasticSlip elastic_slip(const NodalLoads& loads, Index node);

/// The friction multipliers, convected with the surface since the start of the step.
Matrix3Xd convected_friction(const Multipliers& multipliers, const NodalFriction& friction);

}  // namespace mixture_contact
