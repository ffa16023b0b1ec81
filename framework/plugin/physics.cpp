#include "mesogen/plugin/physics.hpp"

namespace mesogen {

Physics::~Physics() = default;

void Physics::scales(Scales&) const {}

void Physics::constants(Constants&) const {}

void Physics::prepare(const Scene&) {}

void Physics::step_limits(const Scene&, StepLimits&) const {}

}  // namespace mesogen
