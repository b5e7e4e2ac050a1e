/// A contact, as the objects that act on all contacts of a model see it.
#pragma once

#include "assembly.h"

class ContactInModel {
 public:
  ContactInModel() = default;
  ContactInModel(const ContactInModel&) = delete;
  ContactInModel& operator=(const ContactInModel&) = delete;
  ContactInModel(ContactInModel&&) = delete;
  ContactInModel& operator=(ContactInModel&&) = delete;
  virtual ~ContactInModel() = default;

  /// Whether the contact is part of the present step of the analysis.
  virtual bool is_active() const = 0;
  virtual BoundContact& bound() = 0;
  /// The ambient value of a degree of freedom outside contact [MPa or mM].
  virtual double ambient_value(int dof) const = 0;
  /// Whether failed steps reduce its traction penalty.
  virtual bool has_reducible_penalty() const = 0;
  virtual const Assembly& assembly() const = 0;
  /// Calls at the start of an analysis step, and after a time step or the run has been solved.
  virtual void on_callback(unsigned int when) = 0;
};
