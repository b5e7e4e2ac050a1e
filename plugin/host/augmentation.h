/// The work on a contact after its host has found a solution.
#pragma once

#include "contact/interface/interface.h"

#include <functional>
#include <string>
#include <vector>

/// The outcome of augment().
struct Augmentation {
  bool done = true;                ///< no augmentation is needed, or allowed, any more
  bool stiffens = false;           ///< penalties have grown: a matrix that a host keeps is of smaller ones
  std::vector<std::string> lines;  ///< gaps with their tolerances, for the log; none without multipliers
  std::string warning;             ///< set if the limit has stopped the augmentations
};

/// Reports the gaps of a solution, and calls `take_up` if they miss the tolerances. `take_up` sets the multipliers to
/// the loads, and returns whether penalties have grown.
///
/// `title`: type and name of the contact; `augmentation`: how many there have been since the time step began.
Augmentation augment(const std::string& title, const mixture_contact::GapReport& report,
                     const mixture_contact::Settings& settings, const mixture_contact::Effects& effects,
                     int augmentation, const std::function<bool()>& take_up);

/// Reports the gaps of a contact at a solution, and augments it where they miss the tolerances.
///
/// `name`: of the contact; `augmentation`: how many there have been since the time step began.
Augmentation augment(const std::string& name, mixture_contact::ContactInterface& core,
                     const mixture_contact::PerSide<mixture_contact::SurfaceFields>& fields, int augmentation);
