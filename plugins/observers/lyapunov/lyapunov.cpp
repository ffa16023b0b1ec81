/// Largest Lyapunov exponent of the particles' paths: how fast neighbours in the fluid part from each other.
///
/// A tangent vector d is carried along the path of each chosen particle,
///
///     d'(t) = A(t) d,    A_cd = du_c/dx_d at the particle,
///
/// and brought back to length 1 again and again; the sum of the logarithms of what it was brought back from, over the
/// time that it took, tends to the largest exponent whatever the vector's first direction (Benettin, Galgani, Giorgilli
/// & Strelcyn, Meccanica 15, 9, 1980).
///
/// A is known where the observer samples: after every step only positions and fields that are advanced in time are up
/// to date, and the velocity gradient is none of them. So from one sample to the next, h later, d goes by
///
///     d(t + h) = exp(h (A(t) + A(t + h)) / 2) d(t),
///
/// exact for a gradient that stays, and of second order in h for one that changes (the first term of the Magnus series,
/// by the trapezoidal rule). The interval must resolve the flow: be well below the time in which the gradient changes
/// along a path. In active turbulence 0.2 over the root mean square vorticity is enough: the exponent is then within
/// 0.2 % of that with intervals twenty times shorter. Vectors, unlike pairs of tracers, never grow out of the linear
/// range, and the gradient is the one with which the flow itself computes.
///
/// The standard error is that of a mean over independent particles: their number must not exceed by far that of the
/// vortices, or the time average must be long beside the time in which a particle changes vortex.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "mesogen/exec/compensated_sum.hpp"
#include "mesogen/exec/dispatch.hpp"
#include "mesogen/exec/random.hpp"
#include "mesogen/plugin/observer.hpp"
#include "mesogen/plugin/places.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace mesogen {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

struct Moments {
  double mean = none;
  double deviation = none;  // root of the unbiased variance; NaN of fewer than two values
};

Moments moments_of(const std::vector<double>& values) {
  const auto count = static_cast<double>(values.size());
  exec::CompensatedSum sum;
  for (const double value : values) sum.add(value);
  const double mean = sum.value() / count;
  exec::CompensatedSum squares;
  for (const double value : values) squares.add((value - mean) * (value - mean));
  return {mean, values.size() > 1 ? std::sqrt(squares.value() / (count - 1.0)) : none};
}

/// One of each of `count` equal ranges of ids, so that they are spread over the box as it was filled, row by row.
std::vector<std::int64_t> chosen(std::int64_t count, std::int64_t particles, std::int64_t seed) {
  constexpr std::int64_t stream = 0x6c796170;  // "lyap": numbers that nobody else draws
  count = std::min(count, particles);
  std::vector<std::int64_t> ids;
  for (std::int64_t n = 0; n < count; ++n) {
    const std::int64_t begin = n * particles / count;
    const std::int64_t end = (n + 1) * particles / count;
    ids.push_back(begin + static_cast<std::int64_t>(exec::random_bits(seed, n, stream) %
                                                    static_cast<std::uint64_t>(end - begin)));
  }
  return ids;
}

/// A vector of length 1, any direction as likely as any other.
template <int Dim>
std::array<double, Dim> random_direction(std::int64_t seed, std::int64_t id) {
  constexpr std::int64_t stream = 0x64697265;  // "dire"
  std::array<double, Dim> direction{};
  double square = 0.0;
  for (std::int64_t d = 0; d < Dim; ++d) {  // a normal distribution knows no axes (Box & Muller 1958)
    const double radius = std::sqrt(-2.0 * std::log(1.0 - exec::random_uniform(seed, id, stream + 2 * d)));
    const double angle = 2.0 * std::numbers::pi * exec::random_uniform(seed, id, stream + 2 * d + 1);
    direction[static_cast<std::size_t>(d)] = radius * std::cos(angle);
    square += std::pow(direction[static_cast<std::size_t>(d)], 2);
  }
  for (double& component : direction) component /= std::sqrt(square);
  return direction;
}

/// vector = exp(matrix) vector, brought back to length 1. Returns the logarithm of the length that it had.
///
/// By the power series, in as many parts as keep its terms small (Al-Mohy & Higham, SIAM J. Sci. Comput. 33, 488,
/// 2011); each part is brought back by itself, so that no growth is too much. `matrix`: row by row.
template <int Dim>
double stretch(const double* matrix, double* vector) {
  constexpr int terms = 16;  // of 2^-n / n!: the rest is below rounding
  double norm = 0.0;
  for (int c = 0; c < Dim * Dim; ++c) norm += matrix[c] * matrix[c];
  const int parts = std::max(1, static_cast<int>(std::ceil(2.0 * std::sqrt(norm))));
  double logarithm = 0.0;
  for (int part = 0; part < parts; ++part) {
    std::array<double, Dim> term{};
    std::copy(vector, vector + Dim, term.begin());
    for (int n = 1; n <= terms; ++n) {
      std::array<double, Dim> next{};
      for (std::size_t c = 0; c < Dim; ++c)
        for (std::size_t d = 0; d < Dim; ++d) next[c] += matrix[c * Dim + d] * term[d] / (n * parts);
      term = next;
      for (std::size_t d = 0; d < Dim; ++d) vector[d] += term[d];
    }
    double square = 0.0;
    for (int d = 0; d < Dim; ++d) square += vector[d] * vector[d];
    const double length = std::sqrt(square);
    for (int d = 0; d < Dim; ++d) vector[d] /= length;
    logarithm += std::log(length);
  }
  return logarithm;
}

class Lyapunov final : public Observer {
 public:
  void parameters(ParameterList& list) override {
    list.integer("count", count_)
        .at_least(1.0)
        .doc("number of particles that are followed, spread evenly over the ids; all particles if there are fewer");
    list.number("from", from_)
        .unit("s")
        .at_least(0.0)
        .doc("time at which averages begin; until then vectors only turn to the direction that grows");
    list.integer("seed", seed_).at_least(0.0).doc("seed of the choice of particles and of the first directions");
  }

  void plan(const Scene&, ObserverPlan& plan) override {
    plan.traces_particles();
    plan.reads("velocity_gradient");
    plan.scalar("exponent")
        .unit("1/s")
        .doc(
            "largest Lyapunov exponent: mean over particles, and over time since `from`; correct only if the interval "
            "between samples resolves the flow");
    plan.scalar("exponent_error").unit("1/s").doc("standard error of the exponent, if the particles are independent");
    plan.scalar("finite_time_mean").unit("1/s").doc("mean over particles of their exponents since the last sample");
    plan.scalar("finite_time_deviation")
        .unit("1/s")
        .doc("standard deviation over particles of their exponents since the last sample");
  }

  void start(const ObserverContext& context) override {
    id_ = chosen(count_, static_cast<std::int64_t>(context.id().size()), seed_);
    direction_.clear();
    for (const std::int64_t id : id_) {
      dispatch<AllDimensions>(context.scene().dimension, [&]<int Dim>() {
        const auto direction = random_direction<Dim>(seed_, id);
        direction_.insert(direction_.end(), direction.begin(), direction.end());
      });
    }
    gradient_ = gradient_now(context);
    time_ = context.time();
    growth_.assign(id_.size(), 0.0);
    averaged_ = 0.0;
    window_.assign(id_.size(), none);
  }

  void sample(const ObserverContext& context, Sample& sample) override {
    const auto now = gradient_now(context);
    const double passed = context.time() - time_;
    if (passed > 0.0) advance(now, passed, context.scene().dimension);
    gradient_ = now;
    time_ = context.time();

    std::vector<double> exponents;
    for (const double growth : growth_) exponents.push_back(averaged_ > 0.0 ? growth / averaged_ : none);
    const Moments all = moments_of(exponents);
    const Moments window = moments_of(window_);
    sample.set("exponent", all.mean);
    sample.set("exponent_error", all.deviation / std::sqrt(static_cast<double>(id_.size())));
    sample.set("finite_time_mean", window.mean);
    sample.set("finite_time_deviation", window.deviation);
  }

  [[nodiscard]] std::map<std::string, std::vector<double>> save() const override {
    return {{"id", std::vector<double>(id_.begin(), id_.end())},
            {"direction", direction_},
            {"gradient", gradient_},
            {"growth", growth_},
            {"window", window_},
            {"time", {time_, averaged_}}};
  }

  void restore(const std::map<std::string, std::vector<double>>& saved) override {
    id_.assign(saved.at("id").begin(), saved.at("id").end());
    direction_ = saved.at("direction");
    gradient_ = saved.at("gradient");
    growth_ = saved.at("growth");
    window_ = saved.at("window");
    time_ = saved.at("time").at(0);
    averaged_ = saved.at("time").at(1);
  }

 private:
  /// Over the time since the sample before. What began before `from` does not count.
  void advance(const std::vector<double>& now, double passed, int dimension) {
    const auto components = static_cast<std::size_t>(dimension) * static_cast<std::size_t>(dimension);
    // A sample that falls short of `from` by rounding has reached it.
    const bool counts = time_ >= from_ - 1e-9 * passed;
    if (counts) averaged_ += passed;
    for (std::size_t i = 0; i < id_.size(); ++i) {
      std::array<double, 9> matrix{};
      for (std::size_t c = 0; c < components; ++c)
        matrix[c] = 0.5 * passed * (gradient_[i * components + c] + now[i * components + c]);
      double* const direction = direction_.data() + i * static_cast<std::size_t>(dimension);
      const double growth =
          dispatch<AllDimensions>(dimension, [&]<int Dim>() { return stretch<Dim>(matrix.data(), direction); });
      if (!counts) continue;
      window_[i] = growth / passed;
      growth_[i] += growth;
    }
  }

  /// Row-major: a row a chosen particle, du_c/dx_d in column c * dimension + d.
  [[nodiscard]] std::vector<double> gradient_now(const ObserverContext& context) {
    const auto dimension = static_cast<std::size_t>(context.scene().dimension);
    const std::size_t components = dimension * dimension;
    const auto& place = places_.find(id_, context.id());
    std::vector<double> gradient(id_.size() * components);
    for (std::size_t c = 0; c < components; ++c) {
      const auto values = context.values("velocity_gradient", static_cast<int>(c));
      for (std::size_t i = 0; i < id_.size(); ++i) gradient[i * components + c] = values[place[i]];
    }
    return gradient;
  }

  std::int64_t count_ = 256;
  double from_ = 0.0;
  std::int64_t seed_ = 1;

  std::vector<std::int64_t> id_;
  Places places_;
  std::vector<double> direction_;  // of the vectors, of length 1; row-major
  std::vector<double> gradient_;   // at the sample before, as of gradient_now
  std::vector<double> growth_;     // sum of logarithms, by particle
  std::vector<double> window_;     // exponents of the last time that passed between samples, 1/s
  double time_ = 0.0;              // of the sample before, s
  double averaged_ = 0.0;          // time over which growth_ was summed, s
};

}  // namespace
}  // namespace mesogen

MESOGEN_OBSERVER_PLUGIN(mesogen::Lyapunov, "lyapunov", "1.0.0",
                        "Largest Lyapunov exponent of the particles' paths: chaotic advection")
