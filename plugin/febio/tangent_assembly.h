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

/// The destinations of the parts of one tangent: the rows of the matrix, directly, where FEBio stores it by rows and
/// equations are free, else FEBio's own assembly; and loads that have equations in mixed form.
class TangentAssembly {
 public:
  using Location = mixture_contact::ContactInterface::Location;
  using Rows = mixture_contact::IndexedVector<mixture_contact::TangentBlock>;

  /// The parts that the matrix takes directly.
  struct Takes {
    bool blocks;  ///< blocks of free equations
    bool loads;   ///< loads in mixed form, if the matrix takes blocks
  };
  /// Keeps references.
  TangentAssembly(const mixture_contact::ContactInterface& core, const NodeEquations& equations,
                  const LoadEquations& loads, FELinearSystem& system, FEGlobalMatrix& matrix, Takes takes);

  void add(const Location& rows, const Location& columns, const mixture_contact::MatrixXd& values);
  /// Adds blocks of one effect that have the rows of one node each, times a factor. Adds parts that the matrix does not
  /// include to `beside`, if given.
  void add_rows(mixture_contact::Side first, const Rows& rows, double factor, newton::MatrixPart* beside);
  void add_load(mixture_contact::Side first, const mixture_contact::LoadBlock& load);
  /// Completes the additions to the matrix. Sets the diagonal of absent loads, whose unknowns are zero. Charges each
  /// effect with its time.
  void finish(mixture_contact::TaskClock& timed);
  /// The sides on which loads are unknowns, except those on rigid bodies.
  mixture_contact::PerSide<bool> has_loads() const;
  /// The tractions added as unknowns that depend on no prescribed values.
  const std::vector<UnknownTraction>& unknown_tractions() const { return unknown_tractions_; }
  /// The loads that have been added as unknowns.
  const std::vector<UnknownLoad>& unknown_loads() const { return unknown_loads_; }

 private:
  struct Ids {
    std::vector<int> rows;
    std::vector<int> columns;
  };
  Ids ids_of(const Location& rows, const Location& columns) const;
  /// Whether the rows of the matrix take a block with these equations directly.
  bool is_free(const Ids& ids, const Location& columns) const;
  /// Removes the equations of nodes from the columns of a node's rows if FEBio's own assembly adds their entries.
  /// Returns these nodes.
  mixture_contact::IndexedVector<mixture_contact::Index> take_out_bound(const Location& row, const Location& columns,
                                                                        std::vector<int>& equations) const;
  /// Adds one group of blocks for the threads, from a position on.
  void add_batch(mixture_contact::Side first, const Rows& rows, mixture_contact::Index begin, double factor,
                 newton::MatrixPart* beside);
  /// Adds a node's rows by the n-th node of its columns by FEBio's own assembly.
  void add_bound(mixture_contact::Side first, const mixture_contact::TangentBlock& row, mixture_contact::Index n,
                 double factor);
  void add_mixed(int own, const mixture_contact::LoadBlock& load, const Location& rows, const Location& columns);
  /// Blocks of one effect that wait for their addition to the matrix.
  struct Kept {
    mixture_contact::Patch rows;  ///< of the first one
    mixture_contact::IndexedVector<newton::MatrixBlock> blocks;
  };
  Kept& kept_of(const mixture_contact::Patch& rows);
  /// Collects blocks until there are enough for all threads.
  void keep(const mixture_contact::Patch& rows, newton::MatrixBlock block);
  void take_over(Kept& kept) const;
  /// Adds a block by FEBio's own assembly, after all earlier blocks of the same rows.
  void assemble(const mixture_contact::Patch& rows, const FEElementMatrix& block);

  const mixture_contact::ContactInterface& core_;
  const NodeEquations& equations_;
  const LoadEquations& loads_;
  FELinearSystem& system_;
  FEGlobalMatrix& matrix_;
  newton::MatrixRows rows_;
  Takes takes_;
  std::map<std::optional<int>, Kept> kept_;  ///< by the field of an effect; none: the traction
  std::vector<UnknownLoad> unknown_loads_;
  std::vector<UnknownTraction> unknown_tractions_;
};

/// Whether some equations stand for prescribed values.
bool are_prescribed(const std::vector<int>& equations);

/// Whether a matrix takes blocks of free equations directly.
bool takes_blocks(FEGlobalMatrix& matrix, bool is_constrained);
