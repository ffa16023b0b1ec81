#include <cmath>

#include "forecast/advice_rules.hpp"
#include "forecast/dimensionless_numbers.hpp"

namespace mesogen::rules {

namespace {

constexpr double creeping = 0.1;    // Reynolds number by the box below which a flow is one
constexpr double worthwhile = 1.5;  // times fewer steps: below, the error is not worth it

double reynolds_number(const Setup& setup) {
  for (const SceneNumber& number : dimensionless_numbers(setup.scene))
    if (number.name == "reynolds_box") return number.value;
  return HUGE_VAL;
}

}  // namespace

// Explicit viscosity binds the step by the fluid's mass, which a creeping flow does not feel.
std::optional<Advice> no_inertia(const AdviceInput& input) {
  const Setup& setup = input.setup;
  const std::string key = key_of(setup, "inertia");
  const double density = published(setup, "density");
  const double artificial = published(setup, "creeping_density");
  if (key.empty() || published(setup, "physical_density") > 0.0 || !(artificial > worthwhile * density))
    return std::nullopt;
  const double reynolds = reynolds_number(setup);
  if (!(reynolds < creeping)) return std::nullopt;
  return Advice{
      "no_inertia",
      fmt::format("the Reynolds number by the box is {:.2g}: the fluid's mass plays no part in this flow, but "
                  "binds the step",
                  reynolds),
      {key + "=false"},
      fmt::format("an artificial density, {:.2g} times the fluid's, and as many times fewer steps; growth "
                  "rates are up to 5 % too low",
                  artificial / density)};
}

}  // namespace mesogen::rules
