#include "mesogen/plugin/physics.hpp"

namespace mesogen {

Physics::~Physics() = default;

void Physics::scales(const Scene&, Scales&) const {}

void Physics::constants(Constants&) const {}

void Physics::prepare(const Scene&) {}

void Physics::step_limits(const Scene&, StepLimits&) const {}

double Physics::memory() const { return 0.0; }

void Physics::suggest(const Scene&, const StepLimits&, std::vector<Suggestion>&) const {}

}  // namespace mesogen
