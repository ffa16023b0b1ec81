#pragma once

#include "case/resolved.hpp"
#include "mesogen/diagnostics/error.hpp"
#include "simulation/setup.hpp"

namespace mesogen {

/// One case being set up: the steps in order, each leaving its problems. First the plugins and their parameters
/// (setup_plugins.cpp), then the scene that they see (setup_scene.cpp), then fields, passes and readers (setup.cpp).
class SetupBuilder {
 public:
  SetupBuilder(Setup& setup, const PluginRegistry& registry, Problems& problems, const SetupAdditions& additions)
      : setup_(setup),
        source_(setup.source),
        registry_(registry),
        problems_(problems),
        additions_(additions),
        resolved_(setup.source) {}

  void choose_backend();
  void make_plugins();
  void choose_kernel();
  void place_defects();
  void put_together();
  [[nodiscard]] bool refused() const { return refused_; }

 private:
  template <class Make>
  auto make(const PluginChoice& choice, Make&& made) -> decltype(made(choice.type));
  void read(const PluginChoice& choice, const ParameterList& list);
  template <class Action>
  void attempt(const PluginChoice& choice, Action&& action);
  void describe_scene();
  void find_distortion();
  void collect_fields();
  void choose_output();
  void plan_observers();

  Setup& setup_;
  const Case& source_;
  const PluginRegistry& registry_;
  Problems& problems_;
  const SetupAdditions& additions_;
  ResolvedCase resolved_;
  bool refused_ = false;
};

// What a plugin finds wrong by itself is one problem among the others.
template <class Action>
void SetupBuilder::attempt(const PluginChoice& choice, Action&& action) {
  try {
    action();
  } catch (const Error& error) {
    refused_ = refused_ || error.code() == ExitCode::plugin_refused;
    problems_.add(choice.section.place(), choice.section.path(), error.what());
  }
}

}  // namespace mesogen
