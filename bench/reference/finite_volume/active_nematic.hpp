// The active nematic by finite volumes on a staggered grid: order tensor and pressure at cell centres, velocities at
// faces, shear and vorticity at corners (F. Harlow, J. Welch, Phys. Fluids 8, 2182 (1965)). All is central, of second
// order, and conserves momentum. Diffusion is implicit, the rest extrapolated from two steps (U. Ascher, S. Ruuth,
// B. Wetton, SIAM J. Numer. Anal. 32, 797 (1995)); then the velocity is projected. In a periodic box the projection
// commutes with diffusion, so that one pressure solve a step leaves no splitting error.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "elliptic.hpp"

namespace finite_volume {

/// A cosine wave: (mx, my) wave lengths along the box, amplitude, phase in rad.
struct Wave {
  double mx, my, amplitude, phase;
};

/// Material and scene, in SI units. The defaults are the deterministic benchmark (cases/accuracy/benchmark).
struct Scene {
  double length = 10.0;          // m
  double density = 1.0;          // kg/m^3
  double viscosity = 2.0 / 3.0;  // Pa s
  double activity = 0.05;        // zeta, Pa
  double elastic = 0.02;         // K, N
  double rotation = 0.4;         // Gamma, 1/(Pa s)
  double alignment = 0.7;        // lambda
  double bulk_a = -1.0;          // A, Pa
  double bulk_c = 0.5;           // C, Pa
  double order = 1.0;            // q at the start
  bool flow = true;              // false: the fluid stays at rest
  std::vector<Wave> director{{1, 0, .05, .3}, {0, 1, .03, 1.1}, {1, 1, .02, 2.}, {2, -1, .02, .7}, {3, 1, .01, 1.9}};
  std::vector<Wave> stream{};  // of the stream function at the start, m^2/s
};

struct Stepping {
  double step = 0.0;         // s; 0: by stability, times `factor`
  double factor = 1.0;       // of the step that stability allows
  bool second_order = true;  // backward differences of second order; false: Euler
};

inline double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// What stepping took so far: steps, processor time (s) in all, of the pressure and of implicit diffusion.
struct Cost {
  long steps = 0, pressure_cycles = 0;
  double total = 0.0, pressure = 0.0, diffusion = 0.0;
};

class ActiveNematic {
 public:
  ActiveNematic(const Scene& scene, const Stepping& stepping, int cells, std::unique_ptr<EllipticSolver> solver)
      : scene_(scene), stepping_(stepping), n_(cells), h_(scene.length / cells), solver_(std::move(solver)) {
    for (auto& unknown : unknowns_) unknown = {Field(n_), Field(n_), Field(n_), Field(n_)};
    for (Field* one : {&pressure_, &pressure_before_, &guess_, &right_, &s11_, &s22_, &s12_, &shear_, &spin_}) {
      *one = Field(n_);
    }
    for (int j = 1; j <= n_; ++j) {
      for (int i = 1; i <= n_; ++i) {
        const double x = (i - 0.5) * h_, y = (j - 0.5) * h_, k = 2.0 * std::numbers::pi / scene.length;
        double angle = 0.0;
        for (const Wave& wave : scene.director) angle += wave.amplitude * std::cos(phase(wave, x, y));
        q11()(i, j) = scene.order * std::cos(2.0 * angle);
        q12()(i, j) = scene.order * std::sin(2.0 * angle);
        for (const Wave& wave : scene.stream) {  // u = d psi/dy, v = -d psi/dx
          u()(i, j) -= wave.amplitude * k * wave.my * std::sin(phase(wave, x - 0.5 * h_, y));
          v()(i, j) += wave.amplitude * k * wave.mx * std::sin(phase(wave, x, y - 0.5 * h_));
        }
      }
    }
    for (auto& unknown : unknowns_) unknown.value.wrap();
  }

  /// To this time (s). Throws if the solution is lost.
  void advance(double end) {
    const double before = processor_seconds();
    while (time_ < end) {
      const double steps = std::max(1.0, std::ceil((end - time_) / longest_step() - 1e-9));
      step((end - time_) / steps);
      if (steps == 1.0) time_ = end;
      if (!(std::abs(q11()(1, 1)) < 1e6)) {  // NaN too; an order is about 1
        throw std::runtime_error("the solution is lost at t = " + std::to_string(time_) + " s: choose a shorter step");
      }
    }
    cost_.total += processor_seconds() - before;
  }

  double time() const { return time_; }
  const Cost& cost() const { return cost_; }
  int cells() const { return n_; }

  /// Root of the mean square velocity, m/s.
  double v_rms() const {
    return rms([this](int i, int j) { return std::hypot(u()(i, j), v()(i, j)); });
  }
  /// Root of the mean square vorticity, 1/s.
  double vorticity_rms() const {
    return rms([this](int i, int j) { return (v()(i, j) - v()(i - 1, j) - u()(i, j) + u()(i, j - 1)) / h_; });
  }
  double mean_order() const {
    return sum(n_, [this](int i, int j) { return std::hypot(q11()(i, j), q12()(i, j)); }) / (n_ * n_);
  }
  /// Root of the mean square angle of the director from the x axis, rad.
  double angle_rms() const {
    return rms([this](int i, int j) { return 0.5 * std::atan2(q12()(i, j), q11()(i, j)); });
  }
  /// Root of the mean square divergence, 1/s: what the pressure solver leaves.
  double divergence_rms() const {
    return rms([this](int i, int j) { return divergence(i, j); });
  }

 private:
  /// An unknown with its change in the step before and its rates, diffusion apart, now and one step before.
  struct Unknown {
    Field value, change, rate, rate_before;
  };

  Field& q11() { return unknowns_[0].value; }
  Field& q12() { return unknowns_[1].value; }
  Field& u() { return unknowns_[2].value; }  // at left faces
  Field& v() { return unknowns_[3].value; }  // at lower faces
  const Field& q11() const { return unknowns_[0].value; }
  const Field& q12() const { return unknowns_[1].value; }
  const Field& u() const { return unknowns_[2].value; }
  const Field& v() const { return unknowns_[3].value; }

  double phase(const Wave& wave, double x, double y) const {
    return 2.0 * std::numbers::pi / scene_.length * (wave.mx * x + wave.my * y) + wave.phase;
  }

  template <typename F>
  double rms(F&& f) const {
    return std::sqrt(sum(n_, [&](int i, int j) { return f(i, j) * f(i, j); }) / (n_ * n_));
  }

  double divergence(int i, int j) const { return (u()(i + 1, j) - u()(i, j) + v()(i, j + 1) - v()(i, j)) / h_; }

  /// What is explicit must be slow: half a cell of flow, a quarter of the bulk's fastest relaxation.
  double longest_step() const {
    if (stepping_.step > 0.0) return stepping_.step;
    double fastest = 0.0;
    for (int j = 1; j <= n_; ++j) {
      for (int i = 1; i <= n_; ++i) fastest = std::max(fastest, std::abs(u()(i, j)) + std::abs(v()(i, j)));
    }
    const double bulk = scene_.rotation * (std::abs(scene_.bulk_a) + 6.0 * std::abs(scene_.bulk_c));
    const double step = std::min(fastest > 0.0 ? 0.5 * h_ / fastest : std::numeric_limits<double>::infinity(),
                                 bulk > 0.0 ? 0.25 / bulk : std::numeric_limits<double>::infinity());
    return stepping_.factor * step;
  }

  void step(double dt) {
    for (auto& unknown : unknowns_) std::swap(unknown.rate, unknown.rate_before);
    if (scene_.flow) rate_of_velocity();
    rate_of_tensor();
    for (std::size_t n = 0; n < (scene_.flow ? 4U : 2U); ++n) {
      diffuse(unknowns_[n], n < 2 ? scene_.rotation * scene_.elastic : scene_.viscosity / scene_.density, dt);
    }
    if (scene_.flow) project(dt);
    time_ += dt;
    last_step_ = dt;
    ++cost_.steps;
  }

  /// The unknown of the next step, for a velocity before its projection: (c0 - dt D lap) change = dt (rates + D lap
  /// value) + c2 (change before), where c0 and c2 are those of backward differences on steps that differ.
  void diffuse(Unknown& unknown, double diffusivity, double dt) {
    const double ratio = stepping_.second_order && cost_.steps > 0 ? dt / last_step_ : 0.0;
    const double c0 = (1.0 + 2.0 * ratio) / (1.0 + ratio), c2 = ratio * ratio / (1.0 + ratio);
    const double side = dt * diffusivity / (h_ * h_);
    for (int j = 1; j <= n_; ++j) {
      const double *below = unknown.value.row(j - 1), *above = unknown.value.row(j + 1), *f = unknown.value.row(j);
      const double *now = unknown.rate.row(j), *before = unknown.rate_before.row(j);
      double *change = unknown.change.row(j), *right = right_.row(j);
      for (int i = 1; i <= n_; ++i) {
        const double laplacian = (f[i - 1] + f[i + 1]) + (below[i] + above[i]) - 4.0 * f[i];
        right[i] = dt * ((1.0 + ratio) * now[i] - ratio * before[i]) + side * laplacian + c2 * change[i];
        change[i] *= ratio;  // the guess
      }
    }
    const double begun = processor_seconds();
    solver_->solve(c0, dt * diffusivity, right_, unknown.change);
    cost_.diffusion += processor_seconds() - begun;
    for (int j = 0; j <= n_ + 1; ++j) {
      for (int i = 0; i <= n_ + 1; ++i) unknown.value(i, j) += unknown.change(i, j);
    }
  }

  /// Takes the divergence out of the velocity.
  void project(double dt) {
    for (int j = 1; j <= n_; ++j) {
      for (int i = 1; i <= n_; ++i) {
        right_(i, j) = -divergence(i, j) / dt;
        guess_(i, j) = 2.0 * pressure_(i, j) - pressure_before_(i, j);
      }
    }
    std::swap(pressure_, pressure_before_);
    std::swap(pressure_, guess_);
    const double begun = processor_seconds();
    cost_.pressure_cycles += solver_->solve(0.0, 1.0, right_, pressure_);
    cost_.pressure += processor_seconds() - begun;
    const double factor = dt / h_;
    for (int j = 1; j <= n_; ++j) {
      const double *p = pressure_.row(j), *below = pressure_.row(j - 1);
      double *along = u().row(j), *up = v().row(j);
      double *change_u = unknowns_[2].change.row(j), *change_v = unknowns_[3].change.row(j);
      for (int i = 1; i <= n_; ++i) {
        const double du = -factor * (p[i] - p[i - 1]), dv = -factor * (p[i] - below[i]);
        along[i] += du;
        change_u[i] += du;
        up[i] += dv;
        change_v[i] += dv;
      }
    }
    u().wrap();
    v().wrap();
  }

  /// The divergence of the flux of momentum over density: -u u - zeta Q / rho.
  void rate_of_velocity() {
    const double active = scene_.activity / scene_.density;
    for (int j = 1; j <= n_; ++j) {
      const double *a = u().row(j), *b = v().row(j), *a_below = u().row(j - 1), *b_above = v().row(j + 1);
      const double *q = q11().row(j), *p = q12().row(j), *p_below = q12().row(j - 1);
      double *s11 = s11_.row(j), *s22 = s22_.row(j), *s12 = s12_.row(j), *shear = shear_.row(j), *spin = spin_.row(j);
      for (int i = 1; i <= n_; ++i) {
        const double middle_u = 0.5 * (a[i] + a[i + 1]), middle_v = 0.5 * (b[i] + b_above[i]);
        s11[i] = -middle_u * middle_u - active * q[i];
        s22[i] = -middle_v * middle_v + active * q[i];
        s12[i] = -0.25 * ((a[i] + a_below[i]) * (b[i] + b[i - 1]) +
                          active * ((p[i] + p[i - 1]) + (p_below[i] + p_below[i - 1])));
        const double dudy = (a[i] - a_below[i]) / h_, dvdx = (b[i] - b[i - 1]) / h_;
        shear[i] = 0.5 * (dudy + dvdx);
        spin[i] = dvdx - dudy;
      }
    }
    for (Field* one : {&s11_, &s22_, &s12_, &shear_, &spin_}) one->wrap();
    for (int j = 1; j <= n_; ++j) {
      const double *s11 = s11_.row(j), *s22 = s22_.row(j), *s12 = s12_.row(j);
      const double *s22_below = s22_.row(j - 1), *s12_above = s12_.row(j + 1);
      double *rate_u = unknowns_[2].rate.row(j), *rate_v = unknowns_[3].rate.row(j);
      for (int i = 1; i <= n_; ++i) {
        rate_u[i] = ((s11[i] - s11[i - 1]) + (s12_above[i] - s12[i])) / h_;
        rate_v[i] = ((s12[i + 1] - s12[i]) + (s22[i] - s22_below[i])) / h_;
      }
    }
  }

  /// Transport, alignment, rotation and the bulk's relaxation of the order tensor.
  void rate_of_tensor() {
    const double lambda = scene_.alignment, a = scene_.rotation * scene_.bulk_a, c = scene_.rotation * scene_.bulk_c;
    const double half = 0.5 / h_;
    for (int j = 1; j <= n_; ++j) {
      const double *along = u().row(j), *up = v().row(j), *up_above = v().row(j + 1);
      const double *shear = shear_.row(j), *shear_above = shear_.row(j + 1);
      const double *spin = spin_.row(j), *spin_above = spin_.row(j + 1);
      const double *q = q11().row(j), *q_below = q11().row(j - 1), *q_above = q11().row(j + 1);
      const double *p = q12().row(j), *p_below = q12().row(j - 1), *p_above = q12().row(j + 1);
      double *rate_q = unknowns_[0].rate.row(j), *rate_p = unknowns_[1].rate.row(j);
      for (int i = 1; i <= n_; ++i) {
        const double left = half * along[i], right = half * along[i + 1], low = half * up[i], high = half * up_above[i];
        const double e11 = right - left - high + low;  // half of du/dx - dv/dy, alike without divergence
        const double e12 = 0.25 * ((shear[i] + shear[i + 1]) + (shear_above[i] + shear_above[i + 1]));
        const double w = 0.25 * ((spin[i] + spin[i + 1]) + (spin_above[i] + spin_above[i + 1]));
        const double carried_q = right * (q[i] + q[i + 1]) - left * (q[i - 1] + q[i]) + high * (q[i] + q_above[i]) -
                                 low * (q_below[i] + q[i]);
        const double carried_p = right * (p[i] + p[i + 1]) - left * (p[i - 1] + p[i]) + high * (p[i] + p_above[i]) -
                                 low * (p_below[i] + p[i]);
        const double slowed = 4.0 * lambda * (q[i] * e11 + p[i] * e12) + a + 2.0 * c * (q[i] * q[i] + p[i] * p[i]);
        rate_q[i] = lambda * e11 - w * p[i] - slowed * q[i] - carried_q;
        rate_p[i] = lambda * e12 + w * q[i] - slowed * p[i] - carried_p;
      }
    }
  }

  Scene scene_;
  Stepping stepping_;
  int n_;
  double h_, time_ = 0.0, last_step_ = 0.0;
  std::unique_ptr<EllipticSolver> solver_;
  std::array<Unknown, 4> unknowns_;
  Field pressure_, pressure_before_, guess_, right_;
  Field s11_, s22_, s12_, shear_, spin_;  // flux of momentum; shear rate and vorticity at lower left corners
  Cost cost_;
};

}  // namespace finite_volume
