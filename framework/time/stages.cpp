#include "time/stages.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesogen/exec/dispatch.hpp"
#include "particles/field_loops.hpp"

namespace mesogen {

namespace {

constexpr auto device = exec::Side::device;

// Disordered particles take the shortest waves down faster than a lattice does.
constexpr double margin = 1.2;

/// b_j of the method.
double weight(int stage) {
  if (stage < 2) return 1.0 / 3.0;
  const double j = stage;
  return (j * j + j - 2.0) / (2.0 * j * (j + 1.0));
}

/// Stage j: Y_j = mu Y_{j-1} + nu Y_{j-2} + step (mu_tilde L Y_{j-1} + (mu_tilde + gamma_tilde) M_0) of increments Y,
/// where M_0 = F + L f at the start.
struct Coefficients {
  double mu, nu, mu_tilde, gamma_tilde;

  Coefficients(int stage, int stages) {
    const double j = stage;
    const double s = stages;
    const double w = 4.0 / (s * s + s - 2.0);
    mu = (2.0 * j - 1.0) / j * weight(stage) / weight(stage - 1);
    nu = -(j - 1.0) / j * weight(stage) / weight(stage - 2);
    mu_tilde = mu * w;
    gamma_tilde = -(1.0 - weight(stage - 1)) * mu_tilde;
  }
};

}  // namespace

double largest_rate(const LinearTerms& terms, double eigenvalue) {
  return margin * (terms.diffusion.number * eigenvalue + terms.damping.number + terms.damping_along_axis.number) /
         terms.usual_divisor;
}

int stages_needed(double rate, double step_size) {
  const double stiffness = rate * step_size;  // (s^2 + s - 2) / 2 is the most that s stages take
  if (stiffness <= 2.0) return 2;
  const int least = static_cast<int>(std::ceil((std::sqrt(9.0 + 8.0 * stiffness) - 1.0) / 2.0));
  return least + 1 - least % 2;
}

Stages::Stages(State& state, DerivedFields& derived, const std::vector<LinearTerms>& staged, double eigenvalue)
    : state_(state), derived_(derived), staged_(staged), eigenvalue_(eigenvalue) {
  for (const LinearTerms& terms : staged) {
    const Field& field = state.fields.at(terms.field);
    const auto add = [&](const std::string& name) {
      Field& made = state.add_field(name + " of " + terms.field, field.components(), false);
      made.kind = field.kind;
      made.difference = true;
      made.follows_positions = true;
      return &made;
    };
    increments_[terms.field] = {{add("increment"), add("earlier increment")},
                                terms.diffusion.any() ? add("Laplacian in stages") : nullptr};
  }
}

const LinearTerms* Stages::of(std::string_view field) const {
  const auto at = std::ranges::find_if(staged_, [&](const LinearTerms& terms) { return terms.field == field; });
  return at == staged_.end() ? nullptr : &*at;
}

void Stages::take(const LinearTerms& terms, double step_size) {
  const Increments& increments = increments_.at(terms.field);
  if (increments.laplacian != nullptr) derived_.laplacian(state_.fields.at(terms.field), *increments.laplacian);
  dispatch(state_.scene.precision, [&]<class Real>() {
    add_linear<Real>(terms, increments);
    if (step_size > 0.0)
      run<Real>(terms, increments, step_size, stages_needed(largest_rate(terms, eigenvalue_), step_size));
  });
  ++state_.fields.at(terms.rate).version;
}

template <class Real>
exec::LinearCoefficients<Real> Stages::coefficients(const LinearTerms& terms, double times) const {
  return linear_coefficients<Real>(terms, times, [this](const std::string& field) {
    return std::as_const(state_.fields.at(field)).template view<Real>(device);
  });
}

template <class Real>
void Stages::add_linear(const LinearTerms& terms, const Increments& increments) {
  exec::LinearArguments<Real> all{};
  Field& rate = state_.fields.at(terms.rate);
  all.value = std::as_const(state_.fields.at(terms.field)).view<Real>(device);
  if (increments.laplacian != nullptr) all.laplacian = std::as_const(*increments.laplacian).view<Real>(device);
  all.linear = coefficients<Real>(terms, 1.0);
  all.rate = rate.view<Real>(device, exec::Access::read_write);
  all.components = rate.components();
  state_.backend.fields<Real>().add_linear(all, state_.particles.count());
}

template <class Real>
void Stages::run(const LinearTerms& terms, const Increments& increments, double step_size, int stages) {
  constexpr auto read_write = exec::Access::read_write;
  const exec::FieldLoops<Real>& loops = state_.backend.fields<Real>();
  const Index count = state_.particles.count();
  Field& rate = state_.fields.at(terms.rate);
  Field* latest = increments.field[0];
  Field* before = increments.field[1];
  exec::StageArguments<Real> stage{};
  stage.slope = std::as_const(rate).view<Real>(device);
  stage.components = rate.components();
  // Y_0 = 0, Y_1 = b_1 w dt M_0.
  before->fill_zero();
  const Coefficients second(2, stages);
  loops.scale(stage.slope, Real(step_size * second.mu_tilde / second.mu * weight(1)),
              latest->view<Real>(device, read_write), stage.components, count);
  ++latest->version;
  for (int j = 2; j <= stages; ++j) {
    const Coefficients of(j, stages);
    stage.latest = std::as_const(*latest).view<Real>(device);
    stage.before = before->view<Real>(device, read_write);
    stage.of_latest = Real(of.mu);
    stage.of_before = Real(of.nu);
    stage.of_slope = Real(step_size * (of.mu_tilde + of.gamma_tilde));
    stage.linear = coefficients<Real>(terms, step_size * of.mu_tilde);
    increments.laplacian != nullptr ? derived_.stage(*latest, stage, *increments.laplacian)
                                    : loops.stage(stage, {}, count);
    ++before->version;
    std::swap(latest, before);
  }
  loops.scale(std::as_const(*latest).view<Real>(device), Real(1.0 / step_size), rate.view<Real>(device, read_write),
              rate.components(), count);
}

}  // namespace mesogen
