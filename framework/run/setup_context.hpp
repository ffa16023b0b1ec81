#pragma once

#include <map>
#include <string>
#include <vector>

#include "case/resolved.hpp"
#include "mesogen/diagnostics/error.hpp"
#include "run/setup.hpp"

namespace mesogen {

/// A case while it is set up: what the stages below share.
struct SetupContext {
  Setup& setup;
  const PluginRegistry& registry;
  Problems& problems;
  const SetupAdditions& additions;
  ResolvedCase resolved;
  std::vector<Prescribed> prescribed;                        ///< all that is, also if it comes out the same everywhere
  std::vector<Prescribed> numbers;                           ///< what might vary, and is given as numbers
  std::map<std::string, std::vector<std::string>> may_vary;  ///< keys, by the name of the field that they may become
  bool refused = false;                                      ///< a plugin that the case needs
  bool initial_missing = false;  ///< no plugin has the name of some section: do not ask as well for what it would set

  /// What a plugin finds wrong by itself is one problem among the others.
  template <class Action>
  void attempt(const PluginChoice& choice, Action&& action) {
    try {
      action();
    } catch (const BadParameter& error) {
      problems.add(choice.section.place_of(error.key()), choice.section.full_key(error.key()), error.what());
    } catch (const Error& error) {
      refused = refused || error.code() == ExitCode::plugin_refused;
      problems.add(choice.section.place(), choice.section.path(), error.what());
    }
  }
};

// The stages, in the order in which they are gone through. Each leaves its problems in the context.

// setup_plugins.cpp: the plugins of the case, with their parameters.
void make_plugins(SetupContext& context);
void choose_kernel(SetupContext& context);

// setup_prescribed.cpp: what the case prescribes in space and time, with the constants that plugins have published so
// far, and how large it gets where particles start; the fields.
void find_prescribed(SetupContext& context, Problems& problems);
void collect_prescribed_fields(SetupContext& context);

// setup_scene.cpp: the scene, as plugins see it and add to it.
void describe_scene(SetupContext& context);
void limit_step(SetupContext& context);

// setup_stepping.cpp: what plugins declare, for explicit or for stabilised steps.
void declare_physics(SetupContext& context);

// setup_fields.cpp: the fields that there are, and those that are stored.
void collect_fields(SetupContext& context);
void choose_output(SetupContext& context);

}  // namespace mesogen
