#pragma once

#include "exec/backend.hpp"
#include "mesogen/plugin/passes.hpp"

namespace mesogen {

/// The pass that adds w . grad f to the rate of an advanced field f, where w is the velocity of the particles relative
/// to the fluid: a rate of change following the particle is Df/Dt + w . grad f.
Pass advection_pass(const FieldDeclaration& field, const Transport& transport, const Backend& backend);

}  // namespace mesogen
