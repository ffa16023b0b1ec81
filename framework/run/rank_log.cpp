#include "run/rank_log.hpp"

#include <fmt/format.h>

#include <array>

namespace mesogen {

void RankLog::begin() {
  before_ = state_.ranks.traffic();
  for_ghosts_before_ = state_.neighbourhood.halo().bytes_sent();
}

void RankLog::tell(Log& log, std::int64_t steps, double seconds) const {
  if (!state_.ranks.several()) return;
  const Ranks::Traffic now = state_.ranks.traffic();
  const Halo& halo = state_.neighbourhood.halo();
  const auto a_step = [&](auto all) { return static_cast<double>(all) / static_cast<double>(steps); };
  std::array most{static_cast<double>(state_.particles.count()),  static_cast<double>(halo.count()),
                  a_step(halo.bytes_sent() - for_ghosts_before_), a_step(now.bytes - before_.bytes),
                  a_step(now.messages - before_.messages),        1e3 * a_step(now.seconds - before_.seconds)};
  state_.ranks.largest(most);
  const auto [particles, of_others, for_ghosts, bytes, messages, waiting] = most;
  const double mean = static_cast<double>(state_.scene.particle_count) / state_.ranks.count();
  log.info(fmt::format(
      "{} ranks; at most, a rank has {:.0f} particles ({:.1f} % more than the mean), sees {:.0f} of others, sends "
      "{:.0f} bytes a step for ghosts and {:.0f} in all, in {:.1f} messages, and spends {:.3f} ms a step on messages "
      "({:.1f} %), mostly waiting",
      state_.ranks.count(), particles, 100.0 * (particles / mean - 1.0), of_others, for_ghosts, bytes, messages,
      waiting, 0.1 * waiting / a_step(seconds)));
}

}  // namespace mesogen
