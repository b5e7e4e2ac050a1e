/// The norms that a step begins with, as tolerances of residual and energy are to see them.
#pragma once

#include "contact_in_model.h"
#include "solver/febio/febio_solver.h"
#include "solver/helper.h"

#include <functional>
#include <vector>

/// FEBio takes both from its first residual. Nodes that begin the step in contact though they are open pull there by
/// their penalty, a thousand times what the step's loads are, and a tolerance beside that would be met by any state. So
/// the solver goes on until its norms meet their tolerances beside the first ones without that pull, too.
class FirstNorms : public newton::Helper {
 public:
  using ActiveContacts = std::function<std::vector<ContactInModel*>()>;

  /// Keeps references. `record` counts the steps that begin with such nodes.
  FirstNorms(FEModel& fem, newton::FEBioSolver& solver, ActiveContacts contacts, newton::DeviceRecord& record);

  void begin_step() override;
  void complete_residual() override;
  void try_increment(const std::vector<double>& increment) override;
  bool is_settled() const override;

 private:
  FEModel& fem_;
  newton::FEBioSolver& solver_;
  ActiveContacts contacts_;
  newton::DeviceRecord& record_;
  bool awaits_residual_ = false;  ///< of a step that has begun
  std::vector<double> residual_;  ///< the first one without the nodes that are open; empty where there are none
  double energy_ = 0;             ///< of it and the first increment
};
