#pragma once

#include <string>
#include <string_view>

namespace mesogen::app {

/// What is wrong with this name of a new plugin; empty if nothing is.
std::string plugin_name_problem(std::string_view name);

/// my_force -> MyForce
std::string class_name(std::string_view name);

}  // namespace mesogen::app
