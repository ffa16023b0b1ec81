#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "mesogen/diagnostics/error.hpp"

/// The verbs of the command, one file each. Every function adds its verb with its options; `action` becomes what is to
/// be done if the user chose it.
namespace mesogen::app {

using Action = std::function<ExitCode()>;

void add_run(CLI::App& command, Action& action);
void add_resume(CLI::App& command, Action& action);
void add_branch(CLI::App& command, Action& action);
void add_replay(CLI::App& command, Action& action);
void add_check(CLI::App& command, Action& action);
void add_graph(CLI::App& command, Action& action);
void add_plugin(CLI::App& command, Action& action);
void add_plugin_new(CLI::App& plugin, Action& action);
void add_plugin_check(CLI::App& plugin, Action& action);
void add_field(CLI::App& command, Action& action);
void add_quantity(CLI::App& command, Action& action);
void add_schema(CLI::App& command, Action& action);
void add_reference(CLI::App& command, Action& action);
void add_report(CLI::App& command, Action& action);
void add_chart(CLI::App& command, Action& action);
void add_sweep(CLI::App& command, Action& action);
void add_study(CLI::App& command, Action& action);

}  // namespace mesogen::app
