#include "newton.h"

#include <algorithm>
#include <cmath>

namespace standalone {
namespace {

constexpr double vanishing_energy = 1e-17;

/// Where the energy, known to fall from `first` at 0 to `last` at s, vanishes if it is a parabola that starts with
/// slope -first: the line search of Bonet and Wood (1997), Nonlinear Continuum Mechanics for Finite Element Analysis.
double next_step(double first, double last, double s) {
  const double ratio = first / last;
  const double a = 1 + ratio * (s - 1);
  const double b = ratio * s * s;
  const double discriminant = b * b - 4 * a * b;
  if (discriminant < 0) return b / (2 * a);
  const double root = std::sqrt(discriminant);
  const double far = (b + root) / (2 * a);
  return std::max(0.0, far < 0 ? (b - root) / (2 * a) : far);
}

}  // namespace

void Effort::operator+=(const Effort& other) {
  iterations += other.iterations;
  reformations += other.reformations;
  residuals += other.residuals;
}

Newton::Newton(Problem& problem, Log& log)
    : problem_(problem), log_(log), control_(problem.model().control), system_(problem.linear_system()) {}

VectorXd Newton::field_norms(const VectorXd& vector) const {
  VectorXd norms = VectorXd::Zero(problem_.model().dofs() - 2);
  for (int i = 0; i < vector.size(); ++i) {
    const int dof = problem_.equations().dof(i);
    if (dof < problem_.model().dofs()) norms[std::max(0, dof - 2)] += vector[i] * vector[i];
  }
  return norms;
}

void Newton::form_matrix(bool evaluated) {
  log_.print("Reforming stiffness matrix: reformation #%d\n\n", control_.max_reformations - allowed_reformations_ + 1);
  if (allowed_reformations_-- == 0) throw StepFailure("Max nr of reformations reached.");
  problem_.assemble(system_);
  system_.factorise(problem_.held());
  ++effort_.reformations;
  log_.print("\tNr of equations ........................... : %d\n", problem_.equations().free());
  log_.print("\tNr of nonzeroes in stiffness matrix ....... : %ld\n", static_cast<long>(system_.entries()));
  if (!evaluated) {
    end_ = problem_.residual();
    ++effort_.residuals;
  }
  start_ = end_ - system_.effect(problem_.pending());
}

void Newton::evaluate(const VectorXd& trial) {
  problem_.set_trial(trial, effort_.iterations);
  end_ = problem_.residual();
  ++effort_.residuals;
}

double Newton::line_search(const VectorXd& change) {
  const double first = change.dot(start_);
  double step = 1;
  double best = 1;
  double least = std::abs(first);
  for (int search = 0;;) {
    evaluate(step * change);
    if (control_.search_tolerance == 0) return step;
    if (step < control_.least_search) break;
    const double energy = change.dot(end_);
    if (search == 0 || std::abs(energy) < least) {
      best = step;
      least = std::abs(energy);
    }
    if (std::abs(energy) < vanishing_energy || std::abs(energy) <= control_.search_tolerance * std::abs(first))
      return step;
    step = next_step(first, energy, step);
    if (++search == control_.max_searches) {
      evaluate(best * change);
      return best;
    }
  }
  constexpr double hope = 0.5;  // no step is good: FEBio then takes half of it
  evaluate(hope * change);
  return hope;
}

bool Newton::converged(const VectorXd& change, double step, double time) {
  const double residual = end_.squaredNorm();
  const double energy = step * std::abs(change.dot(end_));
  const VectorXd fields = step * step * field_norms(change);
  VectorXd tolerances = VectorXd::Constant(fields.size(), control_.concentration_tolerance);
  tolerances[0] = control_.displacement_tolerance;
  tolerances[1] = control_.pressure_tolerance;
  const VectorXd allowed = tolerances.cwiseAbs2().cwiseProduct(field_norms(increment_));
  log_norms(time, step, residual, energy, fields, allowed);
  bool done = (tolerances.array() == 0 || fields.array() <= allowed.array()).all();
  done = done && (control_.residual_tolerance == 0 || residual <= control_.residual_tolerance * first_residual_);
  done = done && (control_.energy_tolerance == 0 || energy <= control_.energy_tolerance * first_energy_);
  done = done && (control_.search_tolerance == 0 || step >= control_.least_search) && energy <= largest_energy_;
  if (!done && residual < control_.least_residual) {
    log_.box("WARNING", "No force acting on the system.");
    return true;
  }
  return done;
}

void Newton::restart_norms_if_diverging(const VectorXd& change, double step) {
  const double energy = step * std::abs(change.dot(end_));
  if (energy <= largest_energy_) return;
  log_.box("WARNING", "Problem is diverging. Stiffness matrix will now be reformed");
  largest_energy_ = first_energy_ = energy;
  first_residual_ = end_.squaredNorm();
  first_fields_ = step * step * field_norms(change);
}

void Newton::log_norms(double time, double step, double residual, double energy, const VectorXd& fields,
                       const VectorXd& allowed) const {
  log_.print(" Nonlinear solution status: time= %g\n", time);
  log_.print("\tstiffness updates             = 0\n\tright hand side evaluations   = %d\n", effort_.residuals);
  log_.print("\tstiffness matrix reformations = %d\n", control_.max_reformations - allowed_reformations_);
  log_.print("\tstep from line search         = %f\n", step);
  log_.print("\tconvergence norms :        INITIAL         CURRENT         REQUIRED\n");
  const auto row = [&](const std::string& name, double first, double now, double required) {
    log_.print("\t %-23s%15e %15e %15e\n", name.c_str(), first, now, required);
  };
  row("residual", first_residual_, residual, control_.residual_tolerance * first_residual_);
  row("energy", first_energy_, energy, control_.energy_tolerance * first_energy_);
  row("displacement", first_fields_[0], fields[0], allowed[0]);
  row("fluid pressure", first_fields_[1], fields[1], allowed[1]);
  for (Index k = 2; k < fields.size(); ++k) {
    row("solute " + std::to_string(k - 1) + " concentration", first_fields_[k], fields[k], allowed[k]);
  }
}

bool Newton::augment(Contact& contact) {
  mixture_contact::ContactInterface& core = contact.core();
  const mixture_contact::Settings& settings = core.settings();
  if (settings.enforcement == mixture_contact::Enforcement::penalty) return true;
  const auto fields = contact.fields(problem_.values());
  const mixture_contact::GapReport report = core.gaps(fields);
  log_.print(" sliding-mixture \"%s\": gap %12.4e", contact.definition().name.c_str(), report.traction.relative);
  for (const mixture_contact::FieldGap& gap : report.flux) log_.print(", jump %12.4e", gap.relative);
  log_.print(" (relative)\n");
  if (settings.enforcement == mixture_contact::Enforcement::lagrange_multipliers) return true;
  if (core.converged(report) && augmentations_ >= settings.min_augmentations) return true;
  if (augmentations_ >= settings.max_augmentations) {
    log_.box("WARNING", "sliding-mixture \"" + contact.definition().name + "\": " + std::to_string(augmentations_) +
                            " augmentations (maxaug) were not enough to meet the tolerances.");
    return true;
  }
  core.augment(fields);
  return false;
}

bool Newton::augment() {
  const auto is_solution = [&](const Contact& contact) { return contact.is_solution(problem_.values()); };
  std::vector<Contact>& contacts = problem_.contacts();
  // What converged with contact and clamps held is a solution only if these agree with it; if not, iterations go on.
  const bool settled = problem_.clamps_settled();
  const bool contact_holds = std::all_of(contacts.begin(), contacts.end(), is_solution);
  if (!settled) log_.print(" Concentrations held at zero have to change.\n");
  if (!contact_holds) log_.print(" Contact has to change.\n");
  if (!settled || !contact_holds) {
    problem_.begin_iteration();
    return false;
  }
  if (contacts.empty()) return true;
  log_.print("\n........................ augmentation # %d\n", augmentations_ + 1);
  bool done = true;
  for (Contact& contact : contacts) done = augment(contact) && done;
  ++augmentations_;
  allowed_reformations_ = control_.max_reformations;
  if (!done) {
    problem_.end_iterations();
    problem_.begin_iteration();
  }
  return done;
}

void Newton::solve_step(double time, double dt) {
  effort_ = {};
  augmentations_ = 0;
  allowed_reformations_ = control_.max_reformations;
  increment_ = VectorXd::Zero(problem_.equations().free());
  problem_.start_step(time, dt);
  problem_.begin_iteration();
  form_matrix(false);
  for (bool done = false; !done; ++effort_.iterations) {
    log_.print(" %d\n", effort_.iterations + 1);
    const VectorXd change = system_.solve(start_);
    const double step = line_search(change);
    if (effort_.iterations == 0) {
      first_residual_ = start_.squaredNorm();
      first_energy_ = largest_energy_ = std::abs(change.dot(start_));
      first_fields_ = field_norms(change);
    }
    increment_ += step * change;
    problem_.accept_trial(step * change);
    const bool balanced = converged(change, step, time);
    done = balanced && augment();
    if (done) continue;
    if (balanced) {
      form_matrix(false);  // augment() has begun the iteration
    } else {
      restart_norms_if_diverging(change, step);
      form_matrix(!problem_.begin_iteration());
    }
  }
  problem_.accept_step();
}

}  // namespace standalone
