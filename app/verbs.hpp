#pragma once

#include "command_line/verb.hpp"

/// The verbs of the command, one file each. Every function adds its verb, with its options and what it does.
namespace mesogen::app {

void add_run(Verb& command);
void add_resume(Verb& command);
void add_branch(Verb& command);
void add_replay(Verb& command);
void add_check(Verb& command);
void add_graph(Verb& command);
void add_plugin(Verb& command);
void add_plugin_new(Verb& plugin);
void add_plugin_check(Verb& plugin);
void add_field(Verb& command);
void add_quantity(Verb& command);
void add_schema(Verb& command);
void add_reference(Verb& command);
void add_report(Verb& command);
void add_chart(Verb& command);
void add_sweep(Verb& command);
void add_study(Verb& command);

}  // namespace mesogen::app
