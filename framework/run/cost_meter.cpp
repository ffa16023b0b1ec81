#include "run/cost_meter.hpp"

#include <omp.h>

#include <algorithm>

#include "diagnostics/resources.hpp"

namespace mesogen {

void CostMeter::start(std::int64_t step, const RunCost& before) {
  before_ = before;
  first_step_ = step;
  begun_ = std::chrono::steady_clock::now();
  cpu_begun_ = cpu_seconds();
}

double CostMeter::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
}

RunCost CostMeter::at(std::int64_t step) const {
  if (step == first_step_) return before_;
  RunCost cost = before_;
  cost.steps += step - first_step_;
  cost.sessions += 1;
  cost.wall_seconds += seconds();
  cost.cpu_seconds += cpu_seconds() - cpu_begun_;
  cost.threads = omp_get_max_threads();
  cost.peak_memory = std::max(cost.peak_memory, peak_memory());
  return cost;
}

}  // namespace mesogen
