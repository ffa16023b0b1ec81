#pragma once

#include "case/resolved.hpp"
#include "mesogen/diagnostics/error.hpp"
#include "run/setup.hpp"

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
  void put_together();
  [[nodiscard]] bool refused() const { return refused_; }

 private:
  template <class Make>
  auto make(PluginKind kind, const PluginChoice& choice, Make&& made) -> decltype(made(choice.type));
  void read(const PluginChoice& choice, const ParameterList& list);
  template <class Action>
  void attempt(const PluginChoice& choice, Action&& action);
  void describe_scene();
  void publish_physics();
  void publish_initial_conditions();
  void declare_physics();
  void limit_step();
  void collect_initial_fields();
  void collect_fields();
  void check_fields_of_unsound_case();
  void choose_shown_fields();
  void choose_output();
  void plan_observers();

  Setup& setup_;
  const Case& source_;
  const PluginRegistry& registry_;
  Problems& problems_;
  const SetupAdditions& additions_;
  ResolvedCase resolved_;
  bool refused_ = false;
  bool initial_missing_ = false;  ///< a section is called after no plugin: what it was to set is not asked for as well
};

// What a plugin finds wrong by itself is one problem among the others.
template <class Action>
void SetupBuilder::attempt(const PluginChoice& choice, Action&& action) {
  try {
    action();
  } catch (const BadParameter& error) {
    problems_.add(choice.section.place_of(error.key()), choice.section.full_key(error.key()), error.what());
  } catch (const Error& error) {
    refused_ = refused_ || error.code() == ExitCode::plugin_refused;
    problems_.add(choice.section.place(), choice.section.path(), error.what());
  }
}

}  // namespace mesogen
