/// A contact as it is used by objects that act on all contacts of a model.
#pragma once

#include "assembly.h"
#include "contact/base/polymorphic.h"

/// Access to a contact of a model.
class ContactInModel : public mixture_contact::Polymorphic {
 public:
  /// True if the contact is active in the present step of the analysis.
  virtual bool is_active() const = 0;
  virtual BoundContact& bound() = 0;
  /// The ambient value of a degree of freedom [MPa or mM].
  virtual double ambient_value(int dof) const = 0;
  /// True if failed steps may reduce the contact's traction penalty.
  virtual bool has_reducible_penalty() const = 0;
  virtual const Assembly& assembly() const = 0;
  /// Called by FEBio at the start of an analysis step, after a time step has been solved, and at the end of the run.
  virtual void on_callback(unsigned int when) = 0;
};
