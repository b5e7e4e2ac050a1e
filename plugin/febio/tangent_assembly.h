/// Assembly of a contact's tangent into FEBio's matrix.
#pragma once

#include "bound_contact.h"
#include "load_equations.h"
#include "solver/febio/matrix_rows.h"
#include "solver/splitting.h"

#include <map>
#include <optional>
#include <vector>

class FEElementMatrix;
class FEGlobalMatrix;
class FELinearSystem;

/// Adds the parts of a tangent to FEBio's matrix. Blocks are added directly to the rows of the matrix if FEBio stores
/// it by rows and the equations are free, otherwise by FEBio's own assembly. Loads with equations are added in mixed
/// form.
class TangentAssembly {
 public:
  using Location = mixture_contact::ContactInterface::Location;
  using Rows = mixture_contact::IndexedVector<mixture_contact::TangentBlock>;

  /// The parts that may be added directly.
  struct Takes {
    bool blocks;  ///< blocks of free equations
    bool loads;   ///< loads in mixed form; requires `blocks`
  };
  /// Keeps references.
  TangentAssembly(const mixture_contact::ContactInterface& core, const NodeEquations& equations,
                  const LoadEquations& loads, FELinearSystem& system, FEGlobalMatrix& matrix, Takes takes);

  void add(const Location& rows, const Location& columns, const mixture_contact::MatrixXd& values);
  /// Adds blocks of one effect, each with the rows of one node, times a factor. `beside` (optional) receives the
  /// deferred parts, which are then not added to the matrix.
  void add_rows(mixture_contact::Side first, const Rows& rows, double factor, newton::MatrixPart* beside);
  void add_load(mixture_contact::Side first, const mixture_contact::LoadBlock& load);
  /// Completes the additions to the matrix. Sets the diagonal of loads that are absent, whose unknowns are then zero.
  /// Adds the elapsed time to the effects.
  void finish(mixture_contact::TaskClock& timed);
  /// The sides whose loads are unknowns of the matrix. Loads on rigid bodies are never unknowns.
  mixture_contact::PerSide<bool> has_loads() const;
  /// The tractions that have been added as unknowns and that depend on no prescribed value.
  const std::vector<UnknownTraction>& unknown_tractions() const { return unknown_tractions_; }
  /// The loads that have been added as unknowns.
  const std::vector<UnknownLoad>& unknown_loads() const { return unknown_loads_; }

 private:
  struct Ids {
    std::vector<int> rows;
    std::vector<int> columns;
  };
  Ids ids_of(const Location& rows, const Location& columns) const;
  /// True if a block with these equations may be added directly.
  bool is_free(const Ids& ids, const Location& columns) const;
  /// Removes from the columns of a row the equations of nodes whose entries FEBio's own assembly has to add. Returns
  /// these nodes.
  mixture_contact::IndexedVector<mixture_contact::Index> take_out_bound(const Location& row, const Location& columns,
                                                                        std::vector<int>& equations) const;
  /// Adds a group of blocks on all threads. `begin`: index of the group's first block in `rows`.
  void add_batch(mixture_contact::Side first, const Rows& rows, mixture_contact::Index begin, double factor,
                 newton::MatrixPart* beside);
  /// Adds the entries of a node's rows for the n-th node of their columns by FEBio's own assembly.
  void add_bound(mixture_contact::Side first, const mixture_contact::TangentBlock& row, mixture_contact::Index n,
                 double factor);
  void add_mixed(int own, const mixture_contact::LoadBlock& load, const Location& rows, const Location& columns);
  /// Blocks of one effect that are still to be added to the matrix.
  struct Kept {
    mixture_contact::Patch rows;  ///< rows of the first block
    mixture_contact::IndexedVector<newton::MatrixBlock> blocks;
  };
  Kept& kept_of(const mixture_contact::Patch& rows);
  /// Collects a block; adds all collected blocks when there are enough for all threads.
  void keep(const mixture_contact::Patch& rows, newton::MatrixBlock block);
  void take_over(Kept& kept) const;
  /// Adds a block by FEBio's own assembly, after all collected blocks of the same rows.
  void assemble(const mixture_contact::Patch& rows, const FEElementMatrix& block);

  const mixture_contact::ContactInterface& core_;
  const NodeEquations& equations_;
  const LoadEquations& loads_;
  FELinearSystem& system_;
  FEGlobalMatrix& matrix_;
  newton::MatrixRows rows_;
  Takes takes_;
  std::map<std::optional<int>, Kept> kept_;  ///< by the field of the effect; empty: the traction
  std::vector<UnknownLoad> unknown_loads_;
  std::vector<UnknownTraction> unknown_tractions_;
};

/// True if some equations belong to prescribed values.
bool are_prescribed(const std::vector<int>& equations);

/// True if blocks of free equations may be added directly to a matrix. `is_constrained`: the model has linear
/// constraints.
bool takes_blocks(FEGlobalMatrix& matrix, bool is_constrained);
