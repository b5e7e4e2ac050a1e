#include "settling.h"

#include "contact/interface/corrections.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

using namespace mixture_contact;

namespace {

/// Largest number of solutions in a prediction. The size is a choice: joints of tetrahedra need six.
constexpr int most_answers = 10;

/// The nodes of a contact that open and close in a prediction.
class UndecidedNodes {
 public:
  /// Keeps a reference to the assembly.
  UndecidedNodes(const Assembly& assembly, bool may_change, double dt)
      : assembly_(assembly), dt_(dt), held_(assembly.conditions(dt)) {
    for (const Side side : both_sides) opened_[side] = NodeFlags(core().mesh(side).nodes, false);
    for_each_correctable(core(), [&](Side side, const HeldLinearisation& held) {
      for (const int node : held.nearing()) opened_[side][node] = true;
    });
    if (may_change) loads_ = assembly.undecided_loads(dt);
  }

  bool are_any() const { return !loads_.empty(); }
  bool any_changed() const {
    return std::any_of(loads_.begin(), loads_.end(), [&](const UndecidedLoad& load) { return is_changed(load); });
  }
  /// Adds the conditions on the matrix, including those of nodes whose status has changed so far.
  void add_conditions(std::vector<newton::Condition>& all) const {
    std::map<int, newton::Condition> conditions;
    for (const newton::Condition& held : held_) conditions[held.key] = held;
    for (const UndecidedLoad& load : loads_) {
      if (is_changed(load)) conditions[load.changed.key] = load.changed;
    }
    for (auto& [key, condition] : conditions) all.push_back(std::move(condition));
  }
  /// Opens and closes nodes by the tractions of a solution. Returns true if any node has changed.
  bool follow(const newton::Answer& answer) {
    if (!are_any()) return false;
    const PerSide<VectorXd> answered = tractions(answer);
    PerSide<NodeFlags> now = opened_;
    for_each_correctable(core(), [&](Side side, const HeldLinearisation& held) {
      now[side] = held.opening(answered[side], opened_[side]);
    });
    const bool changed = now != opened_;
    opened_ = std::move(now);
    return changed;
  }
  /// Finds nodes that overlap in a solution, and closes them. Returns true if there are any.
  bool find_more(const newton::Answer& answer) {
    if (!are_any()) return false;
    const PerSide<Matrix3Xd> displacements = assembly_.displacements(answer.x);
    const PerSide<SurfaceFields> fields = assembly_.contact().fields();
    bool finds_any = false;
    for_each_correctable(core(), [&](Side side, HeldLinearisation& held) {
      const TaskClock timed = core().measurements().clock(Task::stiffness);
      const NodeFlags found = held.find_nearing(seen_from(side, displacements), seen_from(side, fields));
      finds_any = finds_any || any(found);
      std::transform(found.begin(), found.end(), opened_[side].begin(), opened_[side].begin(), std::logical_or<>());
    });
    if (!finds_any) return false;
    loads_ = assembly_.undecided_loads(dt_);
    return follow(answer);
  }
  /// Begins the iteration of the contact with the predicted status of the nodes.
  void begin_iteration() const {
    const TaskClock timed = core().measurements().clock(Task::stiffness);
    const PerSide<SurfaceFields> fields = assembly_.contact().fields();
    for_each_moving(
        core(), [&](Side side, MovingGeometry& moving) { moving.held().open(opened_[side], seen_from(side, fields)); });
  }

 private:
  ContactInterface& core() const { return assembly_.contact().core(); }
  bool is_changed(const UndecidedLoad& load) const { return load.is_in_contact == opened_[load.surface][load.node]; }
  /// Tractions of the nodes whose status is predicted, at the end of the iteration [MPa]; NaN at all other nodes.
  PerSide<VectorXd> tractions(const newton::Answer& answer) const {
    PerSide<VectorXd> found;
    for (const Side side : both_sides) found[side] = unknown_values(opened_[side].count());
    for (const UndecidedLoad& load : loads_) {
      const double by_condition = is_changed(load) ? load.change_by_condition * answer.z.at(load.changed.key) : 0;
      found[load.surface][load.node] = load.traction + newton::product(load.change, answer.x) + by_condition;
    }
    return found;
  }

  const Assembly& assembly_;
  double dt_;
  std::vector<newton::Condition> held_;  ///< conditions at the start of the iteration
  std::vector<UndecidedLoad> loads_;
  PerSide<NodeFlags> opened_;  ///< open nodes among those whose status is predicted
};

/// Solves with the matrix until no node changes. Returns the last solution; empty if nodes keep changing.
std::optional<newton::Answer> settled(std::vector<UndecidedNodes>& nodes, newton::KeptMatrix& matrix) {
  for (int answers = 0; answers < most_answers; ++answers) {
    std::vector<newton::Condition> conditions;
    for (const UndecidedNodes& of_contact : nodes) of_contact.add_conditions(conditions);
    std::optional<newton::Answer> answer = matrix.answer(conditions);
    if (!answer) return std::nullopt;
    bool changed = false;
    for (UndecidedNodes& of_contact : nodes) changed = of_contact.follow(*answer) || changed;
    if (changed) continue;
    for (UndecidedNodes& of_contact : nodes) changed = of_contact.find_more(*answer) || changed;
    if (!changed) return answer;
  }
  return std::nullopt;
}

}  // namespace

std::vector<newton::Condition> conditions(const std::vector<ContactInModel*>& contacts, double dt) {
  std::vector<newton::Condition> all;
  for (const ContactInModel* contact : contacts) {
    std::vector<newton::Condition> own = contact->assembly().conditions(dt);
    std::move(own.begin(), own.end(), std::back_inserter(all));
  }
  return all;
}

std::vector<int> equations(const std::vector<ContactInModel*>& contacts) {
  std::vector<int> all;
  for (const ContactInModel* contact : contacts) {
    const std::vector<int> own = contact->assembly().equations();
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

newton::MatrixParts matrix_parts(const std::vector<ContactInModel*>& contacts) {
  newton::MatrixParts parts;
  for (const ContactInModel* contact : contacts) parts.push_back(&contact->assembly().beside_matrix());
  return parts;
}

bool settle(const SettledModel& model, newton::KeptMatrix& matrix) {
  const auto may_change = [](ContactInModel* contact) {
    bool found = false;
    for_each_correctable(contact->bound().core(),
                         [&](Side /*side*/, const HeldLinearisation& held) { found = found || held.may_decide(); });
    return found;
  };
  if (std::none_of(model.contacts.begin(), model.contacts.end(), may_change)) return false;
  std::vector<UndecidedNodes> nodes;
  for (ContactInModel* contact : model.contacts)
    nodes.emplace_back(contact->assembly(), may_change(contact), model.time_increment);
  const auto are_any = [](const UndecidedNodes& of_contact) { return of_contact.are_any(); };
  if (std::none_of(nodes.begin(), nodes.end(), are_any)) return false;
  std::optional<newton::Answer> answer = settled(nodes, matrix);
  const auto any_changed = [](const UndecidedNodes& of_contact) { return of_contact.any_changed(); };
  if (!answer || std::none_of(nodes.begin(), nodes.end(), any_changed)) return false;
  for (const UndecidedNodes& of_contact : nodes) of_contact.begin_iteration();
  matrix.give_back();
  model.evaluate_residual();
  matrix.hold(conditions(model.contacts, model.time_increment), matrix_parts(model.contacts), std::move(*answer));
  return true;
}
