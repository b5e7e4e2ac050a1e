/// A contact as those know it who act on all contacts of a model.
#pragma once

#include "bound_contact.h"

class FEGlobalVector;

class ContactInModel {
 public:
  ContactInModel() = default;
  ContactInModel(const ContactInModel&) = delete;
  ContactInModel& operator=(const ContactInModel&) = delete;
  ContactInModel(ContactInModel&&) = delete;
  ContactInModel& operator=(ContactInModel&&) = delete;
  virtual ~ContactInModel() = default;

  /// Whether the present step of the analysis has it.
  virtual bool is_active() const = 0;
  virtual BoundContact& bound() = 0;
  /// That of a degree of freedom outside contact.
  virtual double ambient_value(int dof) const = 0;
  /// Whether its traction penalty is reduced where steps fail.
  virtual bool has_reducible_penalty() const = 0;
  /// Whether the matrix has room for the present active set.
  virtual bool fits_matrix() const = 0;
  /// Adds what the loads that have changed as the iteration began change of the residual. Returns whether that is
  /// known.
  virtual bool add_residual_change(FEGlobalVector& residual) const = 0;
  /// Adds what the correction of a held linearisation changes of it.
  virtual void add_residual_correction(FEGlobalVector& residual) const = 0;
  /// Equations of loads that the matrix has and the status has not.
  virtual std::vector<int> released_loads() const = 0;
  /// Adds what of the residual is of nodes that begin the step in contact though they are open.
  virtual void add_residual_ahead(FEGlobalVector& residual) const = 0;
  /// When a step or the run has been solved.
  virtual void on_callback(unsigned int when) = 0;
};
