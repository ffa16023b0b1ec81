#include "time/marks.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mesogen {

EqualSteps equal_steps(double way, double longest) {
  const double count = std::max(1.0, std::ceil(way / longest * (1.0 - 1e-9)));
  const double seconds = way / count;
  return {seconds < longest * (1.0 - 1e-9) ? seconds : longest, count};
}

Marks::Marks(std::vector<Timing> readers, KeptTimes kept) : readers_(std::move(readers)), kept_(std::move(kept)) {}

double Marks::next(const Arrival& now, double end, double longest) const {
  double next = kept_.next(now.reaches(), end);
  for (const Timing& reader : readers_) next = std::min(next, reader.next(now.reaches(), end));
  // The end is met exactly, so a mark just before it makes way.
  const Arrival there{next, equal_steps(next - now.time, longest).seconds};
  return std::max(there.reaches(), next * (1.0 + 1e-12)) < end ? next : end;
}

std::vector<bool> Marks::due(const Arrival& from, const Arrival& to, std::int64_t steps) const {
  std::vector<bool> due;
  for (const Timing& reader : readers_) due.push_back(reader.due(from.reaches(), to.reaches(), steps));
  return due;
}

bool Marks::keeps(const Arrival& from, const Arrival& to) const { return kept_.due(from.reaches(), to.reaches()); }

bool Marks::has(double time) const {
  return kept_.has(time) || std::ranges::any_of(readers_, [&](const Timing& reader) { return reader.has(time); });
}

}  // namespace mesogen
