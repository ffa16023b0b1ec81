#include "forecast/room.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "case/arrangement.hpp"
#include "mesogen/diagnostics/error.hpp"

namespace mesogen {

namespace {

constexpr double particles_of_a_copy = 2e5;
constexpr double far_beyond = 3.0;     // of what is available: beyond all errors of a coarse copy
constexpr double left_free = 0.1;      // of what is available
constexpr double most_steps = 1e9;     // at 0.1 ms a step, which is fast, more than a day
constexpr double bytes_of_a_row = 24;  // of a sample: its step, its time, its number of rows

std::string gigabytes(double bytes) { return fmt::format("{:.3g} GB", bytes / 1e9); }

double count_of(const Case& source) { return lattice_counts(source).total(); }

/// The first spacing from that of so many particles upward that whole columns and rows fit; 0 if none does.
double spacing_of(const Case& source, double particles) {
  const auto& size = source.domain.size;
  const double shortest = *std::ranges::min_element(size);
  constexpr int fewest_across = 4;
  double in_a_cube = particles;  // whose edge is the shortest of the box
  for (const double edge : size) in_a_cube *= shortest / edge;
  const double most_across = std::pow(in_a_cube, 1.0 / static_cast<double>(size.size()));
  if (!(most_across >= fewest_across)) return 0.0;
  for (auto across = static_cast<std::int64_t>(most_across); across >= fewest_across; --across) {
    Case other = source;
    other.particles.spacing = shortest / static_cast<double>(across);
    if (arrangement_problem(other).empty() && count_of(other) <= particles) return other.particles.spacing;
  }
  return 0.0;
}

/// Bytes of a particle, and those that a run takes whatever there is in it.
struct PerParticle {
  double bytes;
  double whatever;
};

std::optional<PerParticle> per_particle(const Case& source, double program, const SetUpWith& set_up_with) {
  std::vector<std::string> settings;
  if (count_of(source) > particles_of_a_copy) {
    const double spacing = spacing_of(source, particles_of_a_copy);
    if (!(spacing > 0.0)) return std::nullopt;
    settings.push_back(fmt::format("particles.spacing={:.12g}", spacing));
  }
  const auto count_with = [&]() -> std::optional<PerParticle> {
    try {
      const auto copy = set_up_with(settings);
      const MemoryForecast memory = forecast_memory(*copy, program);
      const double whatever = memory.lasting.front().bytes;
      return PerParticle{(memory.peak() - whatever) / copy->scene.particle_count, whatever};
    } catch (const Error&) {
      return std::nullopt;
    }
  };
  const auto usual = count_with();
  if (source.time.stepping != "auto") return usual;
  // Finer particles may make stabilised steps the better ones, and these take more memory.
  settings.emplace_back("time.stepping=stabilised");
  const auto stabilised = count_with();
  return stabilised ? stabilised : usual;
}

std::optional<Fitting> fitting(const Case& source, double available, const std::optional<PerParticle>& each) {
  if (!each) return std::nullopt;
  const double most = ((1.0 - left_free) * available - each->whatever) / each->bytes;
  const double spacing = spacing_of(source, std::min(most, count_of(source)));
  if (!(spacing > source.particles.spacing)) return std::nullopt;
  Case other = source;
  other.particles.spacing = spacing;
  return Fitting{spacing, count_of(other)};
}

void refuse_particles(const Case& source, double needed, double available, const std::optional<Fitting>& fits,
                      Problems& problems) {
  const std::string text = fmt::format("{:.6g} particles need {} of memory, but {} are available", count_of(source),
                                       gigabytes(needed), gigabytes(available));
  problems.add(source.place("particles.spacing"), "particles.spacing",
               fits ? fmt::format("{}; {:.6g} particles fit, with a spacing of {:.12g} {}", text, fits->particles,
                                  fits->spacing, source.units.length)
                    : text + "; take fewer particles");
}

double numbers_of(const Quantity& quantity) { return static_cast<double>(std::max<std::size_t>(quantity.columns, 1)); }

/// Of which observer the samples take too much, which are kept until the run ends.
void refuse_samples(const Setup& setup, double available, Problems& problems) {
  const double steps = forecast_steps(setup).expected;
  for (std::size_t n = 0; n < setup.observers.size(); ++n) {
    const auto& observer = setup.observers[n];
    double bytes = bytes_of_a_row;
    for (const Quantity& quantity : observer.plan.quantities()) bytes += sizeof(double) * numbers_of(quantity);
    const double samples = times_due(setup, n, steps);
    if (samples * bytes <= available / 2.0) continue;
    const double fewer = available / 4.0 / bytes;
    const std::string key = "observers." + observer.instance + (observer.timing.every ? ".every" : ".interval");
    problems.add(setup.source.place(key), key,
                 fmt::format("{:.3g} samples are kept in memory until the run ends and need {}, but {} are available; "
                             "choose at least {:.3g}{}",
                             samples, gigabytes(samples * bytes), gigabytes(available),
                             observer.timing.every ? std::ceil(steps / fewer) : setup.source.time.end / fewer,
                             observer.timing.every ? " steps" : " " + setup.source.units.time));
  }
}

}  // namespace

std::optional<Fitting> fitting(const Case& source, double available, double program, const SetUpWith& set_up_with) {
  return fitting(source, available, per_particle(source, program, set_up_with));
}

void refuse_far_beyond_memory(const Case& source, double available, double program, const SetUpWith& set_up_with,
                              Problems& problems) {
  if (!(available > 0.0) || count_of(source) <= particles_of_a_copy) return;
  const auto each = per_particle(source, program, set_up_with);
  if (!each) return;
  const double needed = each->whatever + each->bytes * count_of(source);
  if (needed > far_beyond * available)
    refuse_particles(source, needed, available, fitting(source, available, each), problems);
}

void refuse_beyond_memory(const Setup& setup, const MemoryForecast& memory, double available, double program,
                          const SetUpWith& set_up_with, Problems& problems) {
  // The forecast counts memory of the host. A device refuses by itself what it has no room for
  // (exec/device_memory.hpp).
  if (!(available > 0.0) || !setup.backend->on_host()) return;
  if (memory.peak() > available)
    refuse_particles(setup.source, memory.peak(), available, fitting(setup.source, available, program, set_up_with),
                     problems);
  refuse_samples(setup, available, problems);
}

bool time_stands_still(const StepForecast& steps) { return steps.expected > std::pow(2.0, 53.0); }

std::string beyond_steps(const Setup& setup, const StepForecast& steps) {
  if (!(steps.expected > most_steps)) return {};
  const std::string count = std::isfinite(steps.expected) ? fmt::format("{:.3g}", steps.expected) : "more than 1e308";
  const double end = setup.source.time.end;
  const double mean = end / steps.expected;
  const bool cut = std::isfinite(steps.expected) && mean < steps.at_speed / 2.0;
  std::string text = fmt::format(
      "to {0:.3g} {4} in steps of {1:.3g} {4} (limit: {2}) a run takes {3} steps", end, cut ? mean : steps.at_speed,
      cut ? "the times that samples, frames and checkpoints are asked for" : steps.limit_at_speed, count,
      setup.source.units.time);
  if (time_stands_still(steps)) text += ", and time would stand still before its end";
  return text;
}

}  // namespace mesogen
