#include "settling.h"

#include "contact/interface/corrections.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

using namespace mixture_contact;

namespace {

/// How often a matrix is asked at most. The size is a choice: joints of tetrahedra ask for six.
constexpr int most_answers = 10;

/// The nodes of a contact that open.
class OpeningNodes {
 public:
  /// Keeps a reference.
  OpeningNodes(const Assembly& assembly, bool may_open, double dt)
      : assembly_(assembly), held_(assembly.conditions(dt)) {
    if (may_open) loads_ = assembly.releasable_loads(dt);
    for (const Side side : both_sides) opened_[side] = NodeFlags(core().mesh(side).nodes, false);
  }

  bool may_open() const { return !loads_.empty(); }
  bool any_open() const { return std::any_of(opened_.begin(), opened_.end(), any); }
  /// Of the matrix, with the nodes that have been opened so far.
  void add_conditions(std::vector<newton::Condition>& all) const {
    std::map<int, newton::Condition> conditions;
    for (const newton::Condition& held : held_) conditions[held.key] = held;
    for (const ReleasableLoad& load : loads_) {
      if (opened_[load.surface][load.node]) conditions[load.released.key] = load.released;
    }
    for (auto& [key, condition] : conditions) all.push_back(std::move(condition));
  }
  /// Opens and closes nodes. Returns whether there were any to.
  bool follow(const newton::Answer& answer) {
    if (!may_open()) return false;
    PerSide<NodeFlags> now = opening_nodes(core(), tractions(answer), opened_);
    const bool changed = now != opened_;
    opened_ = std::move(now);
    return changed;
  }
  /// Has the contact begin the iteration with them.
  void open() const { open_nodes(core(), opened_, assembly_.contact().fields()); }

 private:
  ContactInterface& core() const { return assembly_.contact().core(); }
  /// At the end of the iteration, of nodes that may open, should they stay [MPa]; NaN at all others.
  PerSide<VectorXd> tractions(const newton::Answer& answer) const {
    PerSide<VectorXd> found;
    for (const Side side : both_sides) found[side] = unknown_values(opened_[side].count());
    for (const ReleasableLoad& load : loads_) {
      const bool is_open = opened_[load.surface][load.node];
      const double by_release = is_open ? load.change_by_release * answer.z.at(load.released.key) : 0;
      found[load.surface][load.node] = load.traction + newton::product(load.change, answer.x) + by_release;
    }
    return found;
  }

  const Assembly& assembly_;
  std::vector<newton::Condition> held_;  ///< as the iteration begins
  std::vector<ReleasableLoad> loads_;
  PerSide<NodeFlags> opened_;
};

/// Asks the matrix until the nodes stay. Returns the answer that they do with; none where they do not.
std::optional<newton::Answer> settled(std::vector<OpeningNodes>& nodes, KeptMatrix& matrix) {
  for (int answers = 0; answers < most_answers; ++answers) {
    std::vector<newton::Condition> conditions;
    for (const OpeningNodes& of_contact : nodes) of_contact.add_conditions(conditions);
    std::optional<newton::Answer> answer = matrix.answer(conditions);
    if (!answer) return std::nullopt;
    bool changed = false;
    for (OpeningNodes& of_contact : nodes) changed = of_contact.follow(*answer) || changed;
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

void settle(const SettledModel& model, KeptMatrix& matrix) {
  std::vector<OpeningNodes> nodes;
  for (ContactInModel* contact : model.contacts)
    nodes.emplace_back(contact->assembly(), model.may_settle(*contact), model.time_increment);
  const auto may_open = [](const OpeningNodes& of_contact) { return of_contact.may_open(); };
  if (std::none_of(nodes.begin(), nodes.end(), may_open)) return;
  std::optional<newton::Answer> answer = settled(nodes, matrix);
  const auto opens = [](const OpeningNodes& of_contact) { return of_contact.any_open(); };
  if (!answer || std::none_of(nodes.begin(), nodes.end(), opens)) return;
  for (const OpeningNodes& of_contact : nodes) of_contact.open();
  matrix.give_back();
  model.evaluate_residual();
  matrix.hold(conditions(model.contacts, model.time_increment), matrix_parts(model.contacts), std::move(*answer));
}
