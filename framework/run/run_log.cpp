#include "run/run_log.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>

#include "plugin/instruction_set.hpp"
#include "sph/standard_passes.hpp"
#include "text/rounded_text.hpp"

namespace mesogen {

void log_beginning(Log& log, const Setup& setup, const Stepper::Step& first) {
  const std::string_view precision = to_string(setup.scene.precision);
  const int threads = omp_get_max_threads();
  const int ranks = setup.ranks->count();
  log.info(fmt::format("{} particles, {}{} thread{}, {} precision, first {}step {} (limit: {})",
                       setup.scene.particle_count, ranks > 1 ? fmt::format("{} ranks of ", ranks) : std::string(),
                       threads, threads == 1 ? "" : "s", precision, setup.scene.stabilised_steps ? "stabilised " : "",
                       setup.source.units.time_text(first.seconds), first.limit));
  if (const std::string fitted = fitted_spacing_text(setup.source); !fitted.empty())
    log.info("particles.spacing is " + rounded_text(setup.scene.spacing) + " " + setup.source.units.length + ": " +
             fitted);
}

void log_device(Log& log, const Setup& setup) {
  if (!setup.why_on_host.empty()) log.info("computing on the host: " + setup.why_on_host);
  if (setup.backend->on_host()) {
    const auto sets = plugin::usable_instruction_sets();
    if (const auto text = plugin::narrow_code_text(sph::instruction_set(), sets); !text.empty()) log.warn(text);
    return;
  }
  log.info("computing on " + setup.backend->device());
  for (const auto& member : setup.physics)
    if (!member.on_device)
      log.warn(member.instance + " computes on the host, since '" + member.type +
               "' has no code for CUDA: its fields are copied to the host and back at every step");
}

void log_changes(Log& log, const Setup& setup, Stepper& stepper) {
  for (const std::string& change : stepper.changes())
    log.info(fmt::format("t = {} {}, {}", rounded_text(stepper.state().time), setup.source.units.time, change));
}

void log_speed(Log& log, const Setup& setup, std::int64_t steps, double seconds, std::int64_t sortings) {
  log.info(fmt::format("{} steps in {:.1f} s: {:.3f} ms a step, {:.3g} particle-steps/s; neighbours sorted {} times",
                       steps, seconds, 1e3 * seconds / static_cast<double>(steps),
                       static_cast<double>(steps) * setup.scene.particle_count / seconds, sortings));
}

void log_shares(Log& log, std::vector<Counter> all, const std::vector<Counter>& before, std::int64_t steps,
                double seconds) {
  for (std::size_t n = 0; n < all.size(); ++n) {
    all[n].runs -= before[n].runs;
    all[n].seconds -= before[n].seconds;
  }
  std::ranges::stable_sort(all, std::ranges::greater(), &Counter::seconds);
  for (const Counter& share : all) {
    if (share.runs == 0) continue;
    log.info(fmt::format("{:6.2f} %  {:9.3f} ms a step  {:8} runs  {}", 100.0 * share.seconds / seconds,
                         1e3 * share.seconds / static_cast<double>(steps), share.runs, share.title));
  }
}

}  // namespace mesogen
