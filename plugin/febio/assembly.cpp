#include "assembly.h"

#include "columns_beside.h"
#include "contact/base/in_order.h"
#include "contact/interface/corrections.h"
#include "host/mixed_form.h"
#include "matrix_requests.h"
#include "rigid_shell_bottoms.h"
#include "solver/febio/matrix_profile.h"
#include "solver/febio/matrix_rows.h"
#include "tangent_assembly.h"

#include <FECore/FEGlobalMatrix.h>
#include <FECore/FEGlobalVector.h>

#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

using namespace mixture_contact;

namespace {

/// The condition that adds a load to the matrix with the other contact status. `follows`: condition for a load that
/// depends on its variables. `traction`: traction at the start of the iteration, which is in the residual if the node
/// is in contact, and otherwise has to be added.
newton::Condition changed_condition(newton::Condition follows, double traction, double factor, bool is_in_contact) {
  if (is_in_contact) {
    follows.row.clear();
    follows.diagonal = 1;
    follows.value = -traction;
  } else {
    follows.value = -traction / factor;
  }
  return follows;
}

/// The numbers 0, 1, ... up to `count`.
IndexedVector<int> counted(Index count) {
  IndexedVector<int> numbers(indexing::entries(count));
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

/// The equations of a contact's nodes, which are gathered when they are first needed.
class GatheredOnce {
 public:
  /// Keeps a reference.
  explicit GatheredOnce(const BoundContact& contact) : contact_(contact) {}
  const NodeEquations& operator()() const {
    if (!equations_) equations_.emplace(contact_);
    return *equations_;
  }

 private:
  const BoundContact& contact_;
  mutable std::optional<NodeEquations> equations_;
};

}  // namespace

void Assembly::for_each_coupling(const UseBlock& use_block, const UseLoad& use_load, const UseRow& use_row) const {
  const ContactInterface& core = contact_.core();
  const NodeEquations equations(contact_);
  ContactInterface::UseRows use_rows;
  if (takes_rows_)
    use_rows = [&](Side first, const IndexedVector<TangentBlock>& rows) {
      in_order(
          rows.count(), [&](Index n) { return coupled_row(equations, first, rows[n]); },
          [&](Index /*n*/, const CoupledRow& row) {
            use_row(row.own, row.others);
            if (row.both_ways) use_row(row.others, row.own);
          });
    };
  core.for_each_coupling([&](const Location& place) { use_block(equations.coupled(place)); },
                         [&](Side first, const LoadPlace& load) {
                           const UnknownLoad own = loads_.unknown(equations, core, first, load);
                           const std::vector<int> others = equations.coupled({first, load.columns});
                           if (own.equation >= 0) {
                             use_load(own, others);
                           } else {
                             use_block(others);
                           }
                         },
                         use_rows);
}

Assembly::CoupledRow Assembly::coupled_row(const NodeEquations& equations, Side first, const TangentBlock& row) const {
  Patch rows = row.rows;
  const bool is_rigid = equations.are_rigid({first, rows});
  // FEBio couples all unknowns of a rigid body's nodes with each other.
  rows.displacements = rows.displacements || is_rigid;
  return {equations.coupled({first, rows}), equations.coupled({first, in_matrix(equations, first, row)}),
          is_rigid || equations.are_rigid({first, row.columns})};
}

Patch Assembly::in_matrix(const NodeEquations& equations, Side first, const TangentBlock& row) const {
  if (!splits(first)) return row.columns;
  const Location columns{first, row.columns};
  return without(row.columns, columns_beside(equations, {first, row.rows}, columns, equations.equations(columns)));
}

void Assembly::add_to_profile(FEGlobalMatrix& matrix, const MatrixForm& form) {
  const TaskClock timed = contact_.core().measurements().clock(Task::stiffness);
  form_ = form;
  const bool takes_all = takes_blocks(matrix, form.is_constrained);
  const bool takes_loads = takes_all && form.has(newton::Device::loads_as_unknowns);
  takes_rows_ = takes_all && takes_any_structure(*contact_.surfaces()[Side::primary].GetFEModel());
  SparseMatrixProfile& profile = *matrix.GetSparseMatrixProfile();
  newton::CoupledBlocks blocks(profile.Columns());
  for_each_coupling([&](const std::vector<int>& ids) { blocks.add(ids); },
                    [&](const UnknownLoad& load, const std::vector<int>& others) {
                      if (!takes_loads) return blocks.add(others);
                      blocks.add_star(load.equation, others);
                      if (form.has(newton::Device::row_operations)) blocks.add_sum(load.equation, load.node);
                    },
                    [&](const std::vector<int>& own, const std::vector<int>& others) { blocks.add_rows(own, others); });
  blocks.insert_into(profile);
}

ContactInterface::AddResidual Assembly::adder(const NodeEquations& equations, FEGlobalVector& residual) {
  return [&](const Location& place, const VectorXd& values) {
    std::vector<int> nodes = equations.nodes(place);
    std::vector<int> ids = equations.equations(place);
    std::vector<double> entries(values.data(), values.data() + values.size());
    residual.Assemble(nodes, ids, entries);
  };
}

void Assembly::residual(FEGlobalVector& residual, double dt) const {
  const ContactInterface& core = contact_.core();
  const TaskClock timed = core.measurements().clock(Task::residual);
  const PerSide<SurfaceFields> fields = contact_.fields();
  const RigidShellBottoms arms(contact_.surfaces());
  core.residual(fields, dt, adder(NodeEquations(contact_), residual));
}

bool Assembly::residual_change(FEGlobalVector& residual, double dt) const {
  const PerSide<SurfaceFields> fields = contact_.fields();
  const RigidShellBottoms arms(contact_.surfaces());
  const ContactInterface& core = contact_.core();
  return mixture_contact::residual_change(core, fields, dt, adder(NodeEquations(contact_), residual));
}

std::vector<newton::Condition> Assembly::conditions(double dt) const {
  const ContactInterface& core = contact_.core();
  const GatheredOnce equations(contact_);
  std::vector<newton::Condition> found;
  for_each_correctable(core, [&](Side side, const HeldLinearisation& held) {
    for (const int node : held.released())
      found.push_back(newton::given_unknown(loads_.of(equations(), core, side, {node, std::nullopt, {}}), 0));
  });
  for_each_correctable(core, [&](Side side, const HeldLinearisation& held) {
    const auto add = [&](const LoadBlock& load) { found.push_back(condition_of(equations(), side, load)); };
    held.add_loads(held.added(), dt, add);
  });
  return found;
}

std::vector<UndecidedLoad> Assembly::undecided_loads(double dt) const {
  const ContactInterface& core = contact_.core();
  const PerSide<SurfaceFields> fields = contact_.fields();
  PerSide<VectorXd> tractions;
  for (const Side side : both_sides) tractions[side] = unknown_values(core.mesh(side).nodes);
  for_each_correctable(core, [&](Side side, const HeldLinearisation& held) {
    tractions[side] = held.undecided(seen_from(side, fields));
  });
  std::vector<UndecidedLoad> found;
  for (const auto& [side, node, equation, of_one] : unknown_tractions_) {
    const double traction = tractions[side][node];
    if (!std::isfinite(traction)) continue;
    newton::Condition released = newton::given_unknown(equation, -traction / of_one);
    found.push_back(
        {side, node, traction, true, std::move(released), {{equation, of_one}}, load_unknown_scale * of_one});
  }
  const GatheredOnce equations(contact_);
  const auto add = [&](Side first, const LoadBlock& load, bool is_in_contact) {
    const double traction = tractions[first][load.place.node];
    const std::vector<int> columns = equations().equations({first, load.place.columns});
    if (!std::isfinite(traction) || are_prescribed(columns)) return;
    found.push_back({first, load.place.node, traction, is_in_contact,
                     changed_condition(condition_of(equations(), first, load), traction, load.factor, is_in_contact),
                     equations().entries({first, load.place.columns}, load.factor * load.variation), 0});
  };
  for (const bool in_contact : {true, false}) {
    for_each_correctable(core, [&](Side side, const HeldLinearisation& held) {
      const IndexedVector<int> nodes = in_contact ? held.added() : held.nearing();
      held.add_loads(nodes, dt, [&](const LoadBlock& load) { add(side, load, in_contact); });
    });
  }
  return found;
}

std::vector<int> Assembly::equations() const {
  const ContactInterface& core = contact_.core();
  const Patch whole{counted(core.mesh(Side::primary).nodes), counted(core.mesh(Side::secondary).nodes),
                    counted(core.effects().nodal_fields())};
  std::vector<int> found = NodeEquations(contact_).coupled({Side::primary, whole});
  found.resize(found.size() + indexing::entries(loads_.count()));
  std::iota(found.end() - loads_.count(), found.end(), loads_.first());
  return found;
}

PerSide<Matrix3Xd> Assembly::displacements(const std::vector<double>& increment) const {
  return NodeEquations(contact_).displacements(increment);
}

newton::Condition Assembly::condition_of(const NodeEquations& equations, Side first, const LoadBlock& load) const {
  // The load as an additional unknown: with K = -dR/du and z = factor variation.du, K du - work z = R.
  return {loads_.of(equations, contact_.core(), first, load.place), equations.entries({first, load.rows}, -load.work),
          equations.entries({first, load.place.columns}, load.variation), -1 / load.factor, 0};
}

void Assembly::forget_matrix() {
  beside_.clear();
  unknown_loads_.clear();
  unknown_tractions_.clear();
}

void Assembly::tangent(FELinearSystem& system, FEGlobalMatrix& matrix, double dt) {
  const ContactInterface& core = contact_.core();
  TaskClock timed = core.measurements().clock(Task::stiffness);
  const PerSide<SurfaceFields> fields = contact_.fields();
  const RigidShellBottoms arms(contact_.surfaces());
  const NodeEquations equations(contact_);
  TangentAssembly parts(core, equations, loads_, system, matrix,
                        {takes_blocks(matrix, form_.is_constrained), form_.has(newton::Device::loads_as_unknowns)});
  beside_.clear();
  ContactInterface::AddRows add_rows;
  if (takes_rows_)
    add_rows = [&](Side first, const IndexedVector<TangentBlock>& rows, double factor) {
      parts.add_rows(first, rows, factor, splits(first) ? &beside_ : nullptr);
    };
  core.tangent(
      fields, dt,
      [&](const Location& rows, const Location& columns, const MatrixXd& values) { parts.add(rows, columns, values); },
      [&](Side first, const LoadBlock& load) { parts.add_load(first, load); }, add_rows);
  parts.finish(timed);
  unknown_loads_ = parts.unknown_loads();
  unknown_tractions_ = parts.unknown_tractions();
  has_matrix(contact_.core(), parts.has_loads());
}

newton::RowOperations Assembly::eliminate_nodes(FEGlobalMatrix& matrix) const {
  const TaskClock timed = contact_.core().measurements().clock(Task::stiffness);
  const newton::MatrixRows rows(matrix);
  IndexedVector<std::optional<newton::RowOperation>> made(count_of(unknown_loads_));
  in_parallel(made.count(), [&](Index n) {
    const UnknownLoad& load = mixture_contact::at(unknown_loads_, n);
    made[n] = rows.eliminate(load.node, load.equation);
  });
  newton::RowOperations operations;
  for (std::optional<newton::RowOperation>& each : made) {
    if (each) operations.push_back(std::move(*each));
  }
  return operations;
}
