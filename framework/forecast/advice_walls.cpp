#include <cmath>
#include <numbers>

#include "forecast/advice_rules.hpp"

namespace mesogen::rules {

namespace {

constexpr double strong = std::numbers::pi / 6.0;  // of a jump, rad
constexpr double low_variation = 0.0025;           // of the density: a quarter of the default

}  // namespace

// A jump along a whole wall is narrower than any spacing. Elasticity turns it into a force that compresses the fluid.
std::optional<Advice> wall_jump(const AdviceInput& input) {
  const Setup& setup = input.setup;
  const Distortion& distortion = setup.scene.distortion;
  if (!(distortion.wall_jump > strong) || !(published(setup, "elastic_stress") > 0.0)) return std::nullopt;
  const std::string finding = fmt::format(
      "walls hold the director up to {:.0f} degrees from where the fluid starts: the stress of this jump makes the "
      "first moments violent",
      distortion.wall_jump * 180.0 / std::numbers::pi);
  const auto& director = setup.source.director;
  if (distortion.wall_angle && (director.type == "uniform" || director.type == "perturbed") &&
      director.amplitude < strong)
    return Advice{"wall_jump",
                  finding,
                  {setting("director.angle", *distortion.wall_angle)},
                  "the director starts as the walls hold it, and nothing jumps"};
  const std::string key = key_of(setup, "density_variation");
  if (key.empty() || !(published(setup, "density_variation") > 2.0 * low_variation)) return std::nullopt;
  return Advice{"wall_jump",
                finding,
                {setting(key, low_variation)},
                "faster sound: density varies less, and less energy comes from the jump, in up to twice the steps"};
}

}  // namespace mesogen::rules
