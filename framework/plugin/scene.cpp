#include "mesogen/plugin/scene.hpp"

#include <utility>

namespace mesogen {

void StepLimits::add(std::string name, double seconds) { limits_.push_back({std::move(name), seconds}); }

}  // namespace mesogen
