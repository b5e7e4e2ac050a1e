/// The owner of a sliding contact that is not in the model file.
#pragma once

#include "ambient_concentration.h"
#include "host/contact_parameters.h"

/// Another interface to which a sliding contact belongs, such as a tie whose broken nodes are in sliding contact. Only
/// the owner is in the model file.
class ContactOwner {
 public:
  ContactOwner() = default;
  ContactOwner(const ContactOwner&) = delete;
  ContactOwner& operator=(const ContactOwner&) = delete;
  ContactOwner(ContactOwner&&) = delete;
  ContactOwner& operator=(ContactOwner&&) = delete;
  virtual ~ContactOwner() = default;

  /// Sets the parameters of the contact to their present values.
  virtual void give_parameters(ContactParameters& parameters, AmbientConcentrations& ambient) = 0;
  /// Breaks bonds at a state. `left`: fraction of the change of their loads in the last iteration by which iterations
  /// may still change them, 0 at a solution [-]. Returns true if any breaks.
  virtual bool breaks_bonds(double left) = 0;
  /// Called after a time step has been solved and accepted by the contact.
  virtual void step_solved() = 0;
  /// True if bonds have softened in the present attempt at a time step.
  virtual bool is_softening() const = 0;
  /// Called after an attempt at a time step has failed. The contact gives no advice of its own.
  virtual void step_failed() = 0;
};
