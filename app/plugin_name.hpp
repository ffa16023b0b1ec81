#pragma once

#include <string>
#include <string_view>

namespace mesogen::app {

/// What is wrong with this name of a new plugin; empty if nothing is.
std::string plugin_name_problem(std::string_view name);

/// my_force -> MyForce, which may be a word of Mesogen's too: the templates add Plugin to it, as no header of its does.
std::string class_name(std::string_view name);

}  // namespace mesogen::app
