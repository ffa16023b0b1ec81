#pragma once

#include "mesogen/plugin/passes.hpp"
#include "mesogen/plugin/physics.hpp"
#include "mesogen/plugin/scene.hpp"
#include "plugin/registry.hpp"

namespace mesogen {

/// A scene to ask plugins in what they are when there is no case: a lattice of particles 0.1 m apart in a periodic box
/// of 1 m, with the constants that the physics plugins of the registry publish by default.
MESOGEN_EXPORT Scene sample_scene(const PluginRegistry& registry, int dimension);

/// What a physics plugin declares in that scene with the parameters that it has now. Throws an Error that names the
/// plugin and the call if the plugin refuses.
MESOGEN_EXPORT PassList sample_declaration(Physics& physics, std::string_view plugin, const PluginRegistry& registry,
                                           int dimension);

}  // namespace mesogen
