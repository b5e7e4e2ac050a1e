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

/// How often a matrix is asked at most. The size is a choice: joints of tetrahedra ask for six.
constexpr int most_answers = 10;

/// The nodes of a contact that open and close.
class UndecidedNodes {
 public:
  /// Keeps a reference.
  UndecidedNodes(const Assembly& assembly, bool may_change, double dt)
      : assembly_(assembly), dt_(dt), held_(assembly.conditions(dt)), opened_(nearing_nodes(core())) {
    if (may_change) loads_ = assembly.undecided_loads(dt);
  }

  bool are_any() const { return !loads_.empty(); }
  bool any_changed() const {
    return std::any_of(loads_.begin(), loads_.end(), [&](const UndecidedLoad& load) { return is_changed(load); });
  }
  /// Of the matrix, with the nodes that have changed so far.
  void add_conditions(std::vector<newton::Condition>& all) const {
    std::map<int, newton::Condition> conditions;
    for (const newton::Condition& held : held_) conditions[held.key] = held;
    for (const UndecidedLoad& load : loads_) {
      if (is_changed(load)) conditions[load.changed.key] = load.changed;
    }
    for (auto& [key, condition] : conditions) all.push_back(std::move(condition));
  }
  /// Opens and closes nodes. Returns whether there were any to.
  bool follow(const newton::Answer& answer) {
    if (!are_any()) return false;
    PerSide<NodeFlags> now = opening_nodes(core(), tractions(answer), opened_);
    const bool changed = now != opened_;
    opened_ = std::move(now);
    return changed;
  }
  /// Looks for nodes that come to overlap, and closes those that stay so. Returns whether there were any to.
  bool find_more(const newton::Answer& answer) {
    if (!are_any()) return false;
    const PerSide<NodeFlags> found = find_nearing_nodes(core(), assembly_.displacements(answer.x),
                                                        assembly_.contact().fields());
    if (std::none_of(found.begin(), found.end(), any)) return false;
    for (const Side side : both_sides)
      std::transform(found[side].begin(), found[side].end(), opened_[side].begin(), opened_[side].begin(),
                     std::logical_or<>());
    loads_ = assembly_.undecided_loads(dt_);
    return follow(answer);
  }
  /// Has the contact begin the iteration with them.
  void begin_iteration() const { open_nodes(core(), opened_, assembly_.contact().fields()); }

 private:
  ContactInterface& core() const { return assembly_.contact().core(); }
  bool is_changed(const UndecidedLoad& load) const { return load.is_in_contact == opened_[load.surface][load.node]; }
  /// At the end of the iteration, of nodes that are undecided, were they in contact [MPa]; NaN at all others.
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
  std::vector<newton::Condition> held_;  ///< as the iteration begins
  std::vector<UndecidedLoad> loads_;
  PerSide<NodeFlags> opened_;  ///< of those that are undecided
};

/// Asks the matrix until the nodes stay. Returns the answer that they do with; none where they do not.
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

newton::MatrixParts matrix_parts(const std::vector<ContactInModel*>& contacts) {
  newton::MatrixParts parts;
  for (const ContactInModel* contact : contacts) parts.push_back(&contact->assembly().beside_matrix());
  return parts;
}

bool settle(const SettledModel& model, newton::KeptMatrix& matrix) {
  const auto may_change = [&](ContactInModel* contact) {
    return model.may_settle(*contact) && may_decide(contact->bound().core());
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
