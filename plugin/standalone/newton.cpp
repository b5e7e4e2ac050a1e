#include "newton.h"

#include "error.h"
#include "host/augmentation.h"
#include "host/warnings.h"

#include <cmath>

namespace standalone {

void Effort::operator+=(const Effort& other) {
  iterations += other.iterations;
  reformations += other.reformations;
  residuals += other.residuals;
}

namespace {

/// A contact at the current state of the problem.
class ContactAtState : public mixture_contact::SteppedContact {
 public:
  ContactAtState(const Problem& problem, Contact& contact, Log& log)
      : problem_(problem), contact_(contact), log_(log) {}

  mixture_contact::ContactInterface& core() const override { return contact_.core(); }
  mixture_contact::PerSide<mixture_contact::SurfaceFields> fields() const override {
    return contact_.fields(problem_.values());
  }
  void project() override { contact_.project(problem_.values()); }

 protected:
  void report(const mixture_contact::UndetectedPenetration& undetected) override {
    const ContactDefinition& definition = contact_.definition();
    const auto& surfaces = definition.surfaces;
    log_.print("%s\n", penetration_line(definition.name, surfaces.front(), surfaces.back(), undetected).c_str());
  }

 private:
  const Problem& problem_;
  Contact& contact_;
  Log& log_;
};

}  // namespace

Newton::Newton(Problem& problem, Log& log)
    : problem_(problem), log_(log), system_(problem.values().size()), steps_(*this) {
  for (Contact& contact : problem.contacts())
    contacts_.push_back(std::make_unique<ContactAtState>(problem, contact, log));
}

std::vector<mixture_contact::SteppedContact*> Newton::active_contacts() {
  std::vector<mixture_contact::SteppedContact*> all;
  for (const auto& contact : contacts_) all.push_back(contact.get());
  return all;
}

Newton::Norms Newton::norms(const VectorXd& residual, const VectorXd& change) const {
  const Index dofs = problem_.values().rows();
  const VectorXd squares = change.reshaped(dofs, problem_.values().cols()).rowwise().squaredNorm();
  VectorXd fields(dofs - 2);
  fields << squares.head<3>().sum(), squares.tail(dofs - 3);
  return {residual.squaredNorm(), std::abs(change.dot(residual)), fields};
}

void Newton::evaluate_residual(mixture_contact::Changed /*what*/) { evaluate_residual(); }

void Newton::evaluate_residual() {
  end_ = problem_.residual();
  ++effort_.residuals;
}

void Newton::form_matrix(bool evaluated) {
  log_.print("Reforming stiffness matrix: reformation #%d\n\n", control().max_reformations - allowed_reformations_ + 1);
  if (allowed_reformations_-- == 0) throw StepFailure("Max nr of reformations reached.");
  steps_.before_matrix();
  problem_.assemble(system_);
  system_.factorise(problem_.free());
  ++effort_.reformations;
  steps_.matrix_formed();
  if (!evaluated) evaluate_residual();
  // Prescribed values change in the first iteration of a step; their effect on the unknowns counts as a force.
  const std::vector<bool> free = problem_.free();
  start_ = end_ - system_.times(problem_.pending());
  for (std::size_t i = 0; i < free.size(); ++i) {
    if (!free[i]) start_[static_cast<Index>(i)] = 0;
  }
}

bool Newton::converged(const Norms& now, double time) {
  VectorXd tolerances = VectorXd::Constant(now.fields.size(), control().concentration_tolerance);
  tolerances.head<2>() << control().displacement_tolerance, control().pressure_tolerance;
  const Norms required{control().residual_tolerance * first_.residual, control().energy_tolerance * first_.energy,
                       tolerances.cwiseAbs2().cwiseProduct(norms(end_, increment_).fields)};
  log_norms(now, required, time);
  const bool fields_met = (tolerances.array() == 0 || now.fields.array() <= required.fields.array()).all();
  const bool residual_met = control().residual_tolerance == 0 || now.residual <= required.residual;
  const bool energy_met = control().energy_tolerance == 0 || now.energy <= required.energy;
  if (fields_met && residual_met && energy_met) return true;
  if (now.residual >= control().least_residual) return false;
  log_.box("WARNING", "No force acting on the system.");
  return true;
}

void Newton::log_norms(const Norms& now, const Norms& required, double time) const {
  log_.print(" Nonlinear solution status: time= %g\n", time);
  log_.print("\tright hand side evaluations   = %d\n", effort_.residuals);
  log_.print("\tstiffness matrix reformations = %d\n", control().max_reformations - allowed_reformations_);
  log_.print("\tconvergence norms :        INITIAL         CURRENT         REQUIRED\n");
  const auto row = [&](const std::string& name, double first, double current, double enough) {
    log_.print("\t %-23s%15e %15e %15e\n", name.c_str(), first, current, enough);
  };
  row("residual", first_.residual, now.residual, required.residual);
  row("energy", first_.energy, now.energy, required.energy);
  for (Index k = 0; k < now.fields.size(); ++k) {
    const std::string solute = "solute " + std::to_string(k - 1) + " concentration";
    row(k == 0 ? "displacement" : (k == 1 ? "fluid pressure" : solute), first_.fields[k], now.fields[k],
        required.fields[k]);
  }
}

bool Newton::augment() {
  const std::vector<Contact>& contacts = problem_.contacts();
  // A state that has converged with constant contact status is a solution only if the status agrees with it; otherwise
  // iterations continue.
  if (!steps_.accepts(this)) {
    log_.print(" Contact has to change.\n");
    begin();
    return false;
  }
  const std::vector<TiedContact>& ties = problem_.ties();
  if (contacts.empty() && ties.empty()) return true;
  log_.print("\n........................ augmentation # %d\n", augmentations_ + 1);
  bool done = true;
  const auto take = [&](const Augmentation& outcome) {
    for (const std::string& line : outcome.lines) log_.print("%s\n", line.c_str());
    if (!outcome.warning.empty()) log_.box("WARNING", outcome.warning);
    done = done && outcome.done;
  };
  const MatrixXd& values = problem_.values();
  for (const Contact& contact : contacts)
    take(::augment(contact.definition().name, contact.core(), contact.fields(values), augmentations_));
  for (const TiedContact& tie : ties) take(tie.augment(values, augmentations_));
  ++augmentations_;
  allowed_reformations_ = control().max_reformations;
  if (!done) begin();
  return done;
}

void Newton::solve_step(double time, double dt) {
  effort_ = {};
  augmentations_ = 0;
  allowed_reformations_ = control().max_reformations;
  increment_ = VectorXd::Zero(problem_.values().size());
  problem_.start_step(time, dt);
  begin();
  steps_.prepare_step(this);
  form_matrix(false);
  for (bool done = false; !done; ++effort_.iterations) {
    log_.print(" %d\n", effort_.iterations + 1);
    const VectorXd change = system_.solve(start_);
    if (effort_.iterations == 0) first_ = norms(start_, change);
    problem_.advance(change);
    steps_.try_increment(this, {});
    steps_.evaluate(this);
    evaluate_residual();
    increment_ += change;
    const bool balanced = converged(norms(end_, change), time);
    done = balanced && augment();
    if (done) continue;
    // If the forces are balanced, augment() has begun the next iteration, and the loads have to be evaluated.
    form_matrix(!balanced);
  }
  problem_.accept_step();
}

}  // namespace standalone
