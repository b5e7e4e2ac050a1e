#include "model_contacts.h"

#include "archive.h"
#include "contact/interface/load_rounding.h"
#include "settling.h"
#include "solver/febio/solver_totals.h"
#include "solver/line_search_guard.h"
#include "solver/non_negative_concentrations.h"
#include "solver/predictor.h"
#include "solver/residual_floor.h"
#include "solver/search_after_failure.h"

#include <FEBioMech/FEResidualVector.h>
#include <FEBioMech/FESolidSolver2.h>
#include <FECore/Callback.h>
#include <FECore/FEAnalysis.h>
#include <FECore/FEException.h>
#include <FECore/FEGlobalMatrix.h>
#include <FECore/FELinearConstraintManager.h>
#include <FECore/FEModel.h>
#include <FECore/FENewtonSolver.h>
#include <FECore/FENodalLoad.h>
#include <FECore/FETimeStepController.h>
#include <FECore/log.h>
#include <FECore/vector.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

using mixture_contact::Changed;
using mixture_contact::GoesOn;
using mixture_contact::MatrixUse;
using mixture_contact::SteppedContact;

namespace {

/// The shared objects of all models. Each is owned by its contacts, and its entry expires with the last contact.
std::map<const FEModel*, std::weak_ptr<ModelContacts>>& registry() {
  static std::map<const FEModel*, std::weak_ptr<ModelContacts>> entries;
  return entries;
}

/// FEBio keeps callbacks of contacts that no longer exist.
// NOLINTNEXTLINE(misc-const-correctness): the type that FEBio gives a callback
bool call_back(FEModel* fem, unsigned int when, void* contacts) {
  const auto entry = registry().find(fem);
  const auto alive = entry == registry().end() ? nullptr : entry->second.lock();
  if (alive != nullptr && alive.get() == contacts) alive->on_callback(when);
  return true;
}

/// Writes a line to the log, unless it is empty.
void say(FEModel& fem, const std::string& line) {
  if (!line.empty()) feLogEx(&fem, "\n%s\n", line.c_str());
}

/// True if a solver's residual is the plain sum of the parts of the model, each added through a FEResidualVector.
bool adds_up_residuals(const FENewtonSolver& solver) {
  // The arc-length method scales external loads, and the logarithmic one transforms the sum.
  if (const auto* solids = dynamic_cast<const FESolidSolver2*>(&solver))
    return solids->m_arcLength == 0 && !solids->m_logSolve;
  return has_known_totals(solver);
}

/// True if the assembled matrix predicts which nodes open and close. This requires that FEBio's solution depends on its
/// right-hand side only.
bool asks_the_matrix(const ModelDevices& devices, const newton::FEBioSolver& solver) {
  return devices.is_on(newton::Device::active_set_prediction) && adds_up_residuals(*solver.febio());
}

/// Adds the changes of a residual by the changed loads of contacts. If a part of them is unknown, it adds nothing and
/// returns false.
bool add_changes(FEModel& fem, const std::vector<ContactInModel*>& contacts, std::vector<double>& residual) {
  std::vector<double> change(residual.size());
  std::vector<double> reactions(residual.size());
  FEResidualVector vector(fem, change, reactions);
  const double dt = fem.GetTime().timeIncrement;
  const bool is_known = std::all_of(contacts.begin(), contacts.end(), [&](const ContactInModel* contact) {
    return contact->assembly().residual_change(vector, dt);
  });
  if (is_known) residual += change;
  return is_known;
}

/// True if the switch of a helper is on, as set by the first active contact that sets it, or by default.
bool is_asked_for(const HelperSwitch& which, const std::vector<ContactInModel*>& active) {
  if (active.empty()) return false;
  const auto given = std::find_if(active.begin(), active.end(), [&](ContactInModel* contact) {
    return which.of(contact->bound().parameters()).given;
  });
  return which.of(given == active.end() ? ContactParameters() : (*given)->bound().parameters()).value;
}

/// True if no other contact and no constraint of FEBio couples nodes.
bool are_alone(const std::vector<ContactInModel*>& active, FEModel& fem) {
  return mixture_contact::number_of(active) == fem.SurfacePairConstraints() && fem.NonlinearConstraints() == 0;
}

/// True if FEBio adds the stiffness of loads to the matrix after that of contacts.
bool adds_loads_last(FEModel& fem, const FENewtonSolver& solver) {
  if (dynamic_cast<const FESolidSolver2*>(&solver) != nullptr) return false;
  for (int i = 0; i < fem.ModelLoads(); ++i) {
    const FEModelLoad* const load = fem.ModelLoad(i);
    if (load->IsActive() && dynamic_cast<const FENodalLoad*>(load) == nullptr) return true;
  }
  return false;
}

/// Notes the largest overlaps at the end of a step with reduced penalties.
void note_overlap(const std::vector<ContactInModel*>& contacts, double time, ReduciblePenalties& reducible) {
  for (ContactInModel* each : contacts) {
    if (!reducible.are_reduced() || !each->has_reducible_penalty()) continue;
    const BoundContact& contact = each->bound();
    reducible.note(contact.name(), largest_overlap(contact.core(), contact.fields()), time);
  }
  reducible.accept();
}

/// The squared norm of the error of contact loads by the rounding of positions [N^2].
double load_rounding_square(const std::vector<ContactInModel*>& contacts) {
  double sum = 0;
  for (ContactInModel* contact : contacts)
    sum += mixture_contact::load_rounding_square(contact->bound().core(), contact->bound().fields());
  return sum;
}

/// True if bonds of a contact have softened in the present attempt at a step.
bool is_any_softening(const std::vector<ContactInModel*>& contacts) {
  return std::any_of(contacts.begin(), contacts.end(), [](ContactInModel* each) {
    const ContactOwner* const owner = each->bound().owner();
    return owner != nullptr && owner->is_softening();
  });
}

/// Eliminates the nodes' unknowns from the rows of loads that are unknowns.
newton::RowOperations eliminated(const std::vector<ContactInModel*>& contacts, FEGlobalMatrix& matrix) {
  newton::RowOperations operations;
  for (const ContactInModel* contact : contacts) {
    newton::RowOperations own = contact->assembly().eliminate_nodes(matrix);
    std::move(own.begin(), own.end(), std::back_inserter(operations));
  }
  return operations;
}

/// True if a failed step will be repeated.
bool will_retry(FEModel& fem) {
  const FETimeStepController* const controller = fem.GetCurrentStep()->m_timeController;
  return controller != nullptr && controller->m_nretries < controller->m_maxretries;
}

/// Reduces penalties after a failed step.
void reduce_penalties(FEModel& fem, const std::vector<ContactInModel*>& contacts, ReduciblePenalties& reducible) {
  const auto is_reducible = [](ContactInModel* contact) { return contact->has_reducible_penalty(); };
  if (!will_retry(fem) || std::none_of(contacts.begin(), contacts.end(), is_reducible)) return;
  say(fem, reducible.fail(fem.GetCurrentTime(), fem.GetTime().timeIncrement));
}

class FEBioArchive : public newton::Archive {
 public:
  explicit FEBioArchive(DumpStream& stream) : stream_(stream) {}
  void part(int& value) override { archive(stream_, value); }
  void part(double& value) override { archive(stream_, value); }
  void part(std::vector<double>& values) override { archive(stream_, values); }
  void part(Eigen::MatrixXd& values) override { archive(stream_, values); }

 private:
  DumpStream& stream_;
};

}  // namespace

std::shared_ptr<ModelContacts> ModelContacts::of(FEModel& fem) {
  if (auto existing = registry()[&fem].lock()) return existing;
  const auto release = [](ModelContacts* contacts) {
    registry().erase(&contacts->fem_);
    delete contacts;  // NOLINT(cppcoreguidelines-owning-memory): the deleter of the pointer that owns it
  };
  std::shared_ptr<ModelContacts> contacts(new ModelContacts(fem), release);
  registry()[&fem] = contacts;
  return contacts;
}

ModelContacts::ModelContacts(FEModel& fem)
    : fem_(fem),
      solver_(fem),
      system_(solver_),
      devices_(fem),
      steps_(*this, newton::Helpers(solver_)),
      matrix_(system_, [this] { return equations(active()); }) {
  const auto offer = [&](const HelperSwitch& which, std::unique_ptr<newton::Helper> helper) {
    const auto is_helper_on = [this, which] { return devices_.is_on(which.device) && is_asked_for(which, active()); };
    steps_.helpers().add(which.device, std::move(helper), is_helper_on, devices_.record());
  };
  offer(non_negative_concentrations, std::make_unique<newton::NonNegativeConcentrations>());
  offer(line_search_guard, std::make_unique<newton::LineSearchGuard>());
  offer(predictor, std::make_unique<newton::Predictor>());
  steps_.helpers().add(
      newton::Device::residual_floor,
      std::make_unique<newton::ResidualFloor>([this] { return load_rounding_square(active()); }),
      [this] { return solver_.is_newton() && devices_.is_on(newton::Device::residual_floor); }, devices_.record());
  const auto is_newton = [this] { return solver_.is_newton(); };
  const auto is_searched = [this] {
    return devices_.is_on(newton::Device::search_after_failure) && is_any_softening(active());
  };
  steps_.helpers().add(std::make_unique<newton::SearchAfterFailure>(is_searched, devices_.record()), is_newton);
  steps_.helpers().add(std::make_unique<newton::RightHandSide>(matrix_), is_newton);
  fem.AddCallback(call_back,
                  CB_STEP_ACTIVE | CB_UPDATE_TIME | CB_MATRIX_REFORM | CB_PRE_MATRIX_SOLVE | CB_MINOR_ITERS |
                      CB_TIMESTEP_SOLVED | CB_TIMESTEP_FAILED | CB_REMESH | CB_SOLVED,
                  this);
}

// ------------------------------------------------------------ contacts and switches

void ModelContacts::add(ContactInModel& contact) {
  contacts_.push_back(&contact);
  unactivated_.insert(&contact);
}

void ModelContacts::remove(ContactInModel& contact) {
  contacts_.erase(std::remove(contacts_.begin(), contacts_.end(), &contact), contacts_.end());
  unactivated_.erase(&contact);
}

std::vector<ContactInModel*> ModelContacts::active() const {
  std::vector<ContactInModel*> found;
  std::copy_if(contacts_.begin(), contacts_.end(), std::back_inserter(found),
               [](ContactInModel* contact) { return contact->is_active(); });
  return found;
}

std::vector<SteppedContact*> ModelContacts::active_contacts() {
  std::vector<SteppedContact*> found;
  for (ContactInModel* contact : active()) found.push_back(&contact->bound());
  return found;
}

std::vector<std::string> ModelContacts::complaints(ContactInModel& contact) const {
  std::vector<std::string> list;
  for (const HelperSwitch& which : helper_switches) {
    const std::string name = "<" + std::string(newton::name(which.device)) + "> ";
    const Given<bool>& one = which.of(contact.bound().parameters());
    const bool differs = std::any_of(contacts_.begin(), contacts_.end(), [&](ContactInModel* other) {
      const Given<bool>& its = which.of(other->bound().parameters());
      return one.given && its.given && one.value != its.value;
    });
    if (differs) list.push_back(name + "affects the whole model, and another contact has a different value.");
    const std::string unavailable = steps_.helpers().unavailable(which.device);
    if (one.given && one.value && !unavailable.empty()) list.push_back(name + unavailable);
  }
  const std::string complaint = devices_complaint(fem_, contact.bound().parameters().helpers.devices);
  if (!complaint.empty()) list.push_back(complaint);
  return list;
}

// ------------------------------------------------------------ FEBio's calls

void ModelContacts::activate(ContactInModel& contact) {
  unactivated_.erase(&contact);
  steps_.activate(contact.bound());
  // The ambient values of nodes that several contacts share depend on all of these contacts.
  const std::vector<ContactInModel*> contacts = active();
  const bool all_known = std::none_of(contacts.begin(), contacts.end(),
                                      [&](const auto* other) { return unactivated_.count(other) > 0; });
  if (all_known) apply_ambient();
}

void ModelContacts::prepare_step(ContactInModel& contact) {
  if (!steps_.prepare_step(&contact.bound())) return;
  devices_.introduce();
  ambient_.begin_step(solver_);
}

MatrixForm ModelContacts::matrix_form() const {
  using newton::Device;
  MatrixForm form{fem_.GetLinearConstraintManager().LinearConstraints() > 0, {}};
  const FENewtonSolver* const solver = solver_.febio();
  const bool adds_up = solver != nullptr && adds_up_residuals(*solver);
  const auto allow = [&](Device device, bool is_possible) {
    form.devices.set(static_cast<std::size_t>(device), is_possible && devices_.is_on(device));
  };
  allow(Device::loads_as_unknowns, true);
  allow(Device::deferred_coupling, adds_up && !matrix_.needs_parts());
  allow(Device::row_operations,
        adds_up && matrix_.takes_operations() && are_alone(active(), fem_) && !adds_loads_last(fem_, *solver));
  return form;
}

void ModelContacts::added_tangent(const ContactInModel& contact) {
  const std::vector<ContactInModel*> contacts = active();
  if (contacts.back() != &contact) return;
  const bool sums_rows = matrix_form().has(newton::Device::row_operations);
  newton::RowOperations operations = sums_rows ? eliminated(contacts, system_.matrix()) : newton::RowOperations();
  devices_.count_matrix(contacts, !operations.empty());
  matrix_.take(std::move(operations));
}

void ModelContacts::serialize(ContactInModel& contact, DumpStream& ar) {
  if (ar.IsLoading()) unactivated_.erase(&contact);
  if (!dumps_.opens(&contact.bound())) return;
  FEBioArchive archive(ar);
  if (!ar.IsShallow()) {
    steps_.helpers().archive(archive);
    reducible_.for_each_value([&](auto& value) { ar & value; });
    matrix_.serialize(ar);
  }
  if (!ar.IsLoading()) return;
  if (ar.IsShallow()) {
    steps_.rewind();
  } else {
    steps_.restart();
  }
}

void ModelContacts::on_callback(unsigned int when) {
  const std::vector<ContactInModel*> contacts = when == CB_SOLVED ? contacts_ : active();
  if (contacts.empty()) return;
  // A mesh adaptor may have renumbered the unknowns since FEBio saved the state with which it repeats a step.
  if (when == CB_UPDATE_TIME && fem_.MeshAdaptors() > 0 && solver_.is_newton()) begin_at_nodal_values(*solver_.febio());
  if (when == CB_MATRIX_REFORM && solver_.is_newton()) {
    steps_.matrix_formed();
    matrix_.formed(matrix_parts(contacts));
    const auto evaluate_loads = [&] { evaluate_residual(Changed::loads); };
    if (asks_the_matrix(devices_, solver_) && settle({contacts, evaluate_loads, solver_.time_increment()}, matrix_))
      devices_.record().acted(newton::Device::active_set_prediction);
  }
  if (when == CB_MINOR_ITERS && solver_.is_newton()) {
    steps_.end_iteration();
    matrix_.go_on(matrix_parts(contacts), steps_.has_begun());
  }
  if (when == CB_PRE_MATRIX_SOLVE && solver_.is_newton()) matrix_.solve();
  for (ContactInModel* contact : contacts) contact->on_callback(when);
  if (when == CB_TIMESTEP_SOLVED) {
    note_overlap(contacts, fem_.GetCurrentTime(), reducible_);
    devices_.record().resume();
    steps_.end_step();
    matrix_.end_step();
  }
  if (when == CB_TIMESTEP_FAILED) {
    reduce_penalties(fem_, contacts, reducible_);
    devices_.fail_step(will_retry(fem_) && solver_.is_newton());
  }
  if (when == CB_SOLVED) {
    say(fem_, reducible_.summary());
    say(fem_, devices_.record().summary());
  }
}

mixture_contact::ReducedPenalty ModelContacts::penalty_reduction() const {
  return reducible_.at(fem_.GetTime().timeIncrement);
}

// ------------------------------------------------------------ the model, as the contacts' steps know it

bool ModelContacts::apply_ambient() { return ambient_.apply(fem_, solver_, steps_.helpers(), active()); }
void ModelContacts::evaluate() { solver_.febio()->UpdateModel(); }
void ModelContacts::evaluate_bodies_after_contacts() { fem_.SetMeshUpdateFlag(true); }
void ModelContacts::request_matrix(bool is_needed) { matrix_.request(is_needed); }

bool ModelContacts::replaces_matrix() {
  if (!matrix_.is_spent()) return false;
  system_.form_matrix();
  return true;
}

void ModelContacts::evaluate_residual(Changed what) {
  const bool adds_up = what == Changed::loads && adds_up_residuals(*solver_.febio());
  if (!adds_up || !add_changes(fem_, active(), solver_.vectors().residual)) system_.renew_residual();
}

void ModelContacts::correct_residual() {
  evaluate_residual(Changed::loads);
  matrix_.correct(conditions(active(), solver_.time_increment()), matrix_parts(active()));
  devices_.record().acted(newton::Device::kept_matrix);
}

MatrixUse ModelContacts::matrix_use() {
  const newton::MatrixStrategy strategy = system_.strategy();
  if (strategy == newton::MatrixStrategy::none || strategy == newton::MatrixStrategy::residuals_alone)
    return MatrixUse::none;
  const bool is_kept = strategy == newton::MatrixStrategy::unchanged || system_.most_updates() > 0;
  return is_kept ? MatrixUse::kept : MatrixUse::each_iteration;
}

void ModelContacts::rejected(int n, GoesOn with) {
  if (!solver_.is_newton()) return;
  // FEBio resets its count of matrices after this call, but the limit has to apply to the whole step.
  if (with == GoesOn::correction) return matrix_.keep_next();
  if (n > system_.most_matrices()) throw MaxStiffnessReformations();
  // Other nodes may be in contact: quasi-Newton methods would continue with the matrix of the previous ones.
  matrix_.force_next();
}

void ModelContacts::accepted() { matrix_.accept(); }
