#include "run/marks_of.hpp"

#include <utility>

namespace mesogen {

Marks marks_of(const Setup& setup) {
  const Case::Output& output = setup.source.output;
  std::vector<Timing> readers;
  for (const auto& member : setup.observers) readers.push_back({member.timing.interval, member.timing.every});
  readers.push_back({output.interval, {}});
  return {std::move(readers), KeptTimes(output.checkpoint_times, output.checkpoint_every)};
}

}  // namespace mesogen
