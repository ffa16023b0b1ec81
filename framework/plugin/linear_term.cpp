#include "mesogen/plugin/linear_term.hpp"

#include <limits>

namespace mesogen {

double LinearTerm::longest_step(const Scene& scene) const {
  constexpr double any = std::numeric_limits<double>::infinity();
  if (!limits_step || !(coefficient > 0.0)) return any;
  const double time = usual_divisor / coefficient;
  if (kind == Kind::diffusion) return scene.diffusion_step_of(field) * time;
  return scene.stabilised_steps ? any : 0.25 * time;
}

}  // namespace mesogen
