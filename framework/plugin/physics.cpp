#include "mesogen/plugin/physics.hpp"

namespace mesogen {

Physics::~Physics() = default;

void Physics::publish(Scene&) const {}

}  // namespace mesogen
