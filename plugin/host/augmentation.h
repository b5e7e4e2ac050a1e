/// Augmentation of a contact after its host has found a solution.
#pragma once

#include "contact/interface/interface.h"

#include <functional>
#include <string>
#include <vector>

/// The outcome of augment().
struct Augmentation {
  bool done = true;       ///< true if no further augmentation is needed or allowed
  bool stiffens = false;  ///< true if penalties have grown; a matrix that the host keeps contains the smaller ones
  /// Gaps with their tolerances, for the log; empty if the enforcement has no multipliers.
  std::vector<std::string> lines;
  std::string warning;  ///< warning for the log; set if the maximum number has stopped the augmentations
};

/// Compares the gaps of a solution with the tolerances, and calls `take_up` if they are larger. `take_up` has to set
/// the multipliers to the loads, and to return true if penalties have grown.
///
/// `title`: type and name of the contact. `augmentation`: number of augmentations since the start of the time step.
Augmentation augment(const std::string& title, const mixture_contact::GapReport& report,
                     const mixture_contact::Settings& settings, const mixture_contact::Effects& effects,
                     int augmentation, const std::function<bool()>& take_up);

/// Compares the gaps of a contact at a solution with the tolerances, and augments the contact if they are larger.
///
/// `name`: name of the contact. `augmentation`: number of augmentations since the start of the time step.
Augmentation augment(const std::string& name, mixture_contact::ContactInterface& core,
                     const mixture_contact::PerSide<mixture_contact::SurfaceFields>& fields, int augmentation);
