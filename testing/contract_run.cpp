#include "contract_run.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <regex>

#include "contract_settings.hpp"
#include "plugin/plugin_call.hpp"
#include "test_registry.hpp"

namespace mesogen::testing {

namespace {

ParameterList parameters_of(PluginKind kind, const std::string& name, const PluginRegistry& registry,
                            std::shared_ptr<void>& owner) {
  ParameterList list;
  const auto take = [&](auto plugin) {
    call_plugin(name, "parameters()", [&] { plugin->parameters(list); });
    owner = std::shared_ptr<void>(std::move(plugin));
  };
  const int dimension = registry.smallest_dimension(kind, name);
  switch (kind) {
    case PluginKind::kernel: take(registry.make_kernel(name, dimension)); break;
    case PluginKind::boundary: take(registry.make_boundary(name, dimension)); break;
    case PluginKind::shape: take(registry.make_shape(name, dimension)); break;
    case PluginKind::initial: take(registry.make_initial(name, dimension)); break;
    case PluginKind::physics: take(registry.make_physics(name, Precision::double_precision, dimension)); break;
    case PluginKind::observer: take(registry.make_observer(name, dimension)); break;
  }
  return list;
}

}  // namespace

ContractRun::ContractRun(PluginKind kind, std::string name, const ContractSettings& settings,
                         const ContractWatch& watch)
    : kind_(kind),
      name_(std::move(name)),
      settings_(settings),
      registry_(registry_of(settings.folders)),
      watch_(watch) {
  if (registry_.find(kind_, name_) == nullptr) throw registry_.missing(kind_, name_);
  watch_.begun("it can be made, and names its parameters");
  std::shared_ptr<void> owner;
  const ParameterList list = parameters_of(kind_, name_, registry_, owner);
  keys_ = keys_of(kind_, name_, list, registry_, settings);
  owner.reset();
  attempt("it can be put into a scene", [&] { require_constants(kind_, name_, keys_, registry_, settings); });
}

void ContractRun::check(const std::string& what, const std::function<std::string()>& action) {
  if (watch_.done.contains(what)) return;
  watch_.begun(what);
  std::string problem;
  try {
    problem = action();
  } catch (const std::exception& error) {
    problem = error.what();
  }
  checks_.push_back({what, problem.empty() ? ContractCheck::Outcome::held : ContractCheck::Outcome::broken, problem});
  watch_.ended(checks_.back());
}

void ContractRun::note(const std::string& text) {
  if (watch_.done.contains(text)) return;
  checks_.push_back({text, ContractCheck::Outcome::note, {}});
  watch_.ended(checks_.back());
}

void ContractRun::attempt(const std::string& what, const std::function<void()>& action) {
  if (watch_.done.contains(what)) return;
  watch_.begun(what);
  action();
}

PluginHarness ContractRun::harness(TestScene scene) const {
  scene.constants.insert(settings_.constants.begin(), settings_.constants.end());
  return {kind_, name_, keys_, scene, settings_.folders};
}

void ContractRun::check_descriptor() {
  check("its descriptor has a version and a summary", [this]() -> std::string {
    const auto& descriptor = *registry_.find(kind_, name_)->descriptor;
    if (!std::regex_match(descriptor.version, std::regex(R"(\d+\.\d+\.\d+)")))
      return fmt::format("its version is \"{}\": make it three numbers, such as 1.0.0", descriptor.version);
    if (*descriptor.summary == '\0') return "its summary is empty: say in a few words what it does";
    return {};
  });
}

void ContractRun::check_parameters(const ParameterList& list) {
  check("every parameter has a unit and a doc text, and no name twice", [&]() -> std::string {
    std::vector<std::string> names;
    for (const Parameter& parameter : list.all()) {
      if (std::ranges::find(names, parameter.name) != names.end())
        return fmt::format("'{}' is declared twice", parameter.name);
      names.push_back(parameter.name);
      if (parameter.doc_text.empty()) return fmt::format("'{0}' has no doc text: add .doc(\"...\")", parameter.name);
      if (parameter.unit_text.empty())
        return fmt::format("'{}' has an empty unit: leave .unit() out for a plain number", parameter.name);
    }
    return {};
  });
  check("every default is a value that a case may give", [&]() -> std::string {
    // The case reader itself judges: every default written out, one at a time, so that it names the one that is wrong.
    for (const Parameter& parameter : list.all()) {
      const std::string value = parameter.value_text();
      if (parameter.is_required || !list.applies(parameter) || value.empty() ||
          settings_.values.contains(parameter.name))
        continue;
      TestScene scene;
      scene.constants = settings_.constants;
      PluginHarness written(kind_, name_, keys_ + fmt::format("{} = {}\n", parameter.name, value), scene,
                            settings_.folders);
      (void)written.scene();
    }
    return {};
  });
}

std::vector<ContractCheck> check_contract(PluginKind kind, std::string_view name, const ContractSettings& settings) {
  return check_contract(kind, name, settings, ContractWatch());
}

std::vector<ContractCheck> check_contract(PluginKind kind, std::string_view name, const ContractSettings& settings,
                                          const ContractWatch& watch) {
  ContractRun run(kind, std::string(name), settings, watch);
  run.check_descriptor();
  std::shared_ptr<void> owner;
  run.check_parameters(parameters_of(kind, run.name(), run.registry(), owner));
  switch (kind) {
    case PluginKind::kernel: check_kernel(run); break;
    case PluginKind::boundary: check_boundary(run); break;
    case PluginKind::shape: check_shape(run); break;
    case PluginKind::initial: check_initial(run); break;
    case PluginKind::physics: check_physics(run); break;
    case PluginKind::observer: check_observer(run); break;
  }
  return run.checks();
}

Numbers with_threads(int threads, const std::function<Numbers()>& action) {
  const int before = omp_get_max_threads();
  omp_set_num_threads(threads);
  Numbers numbers;
  try {
    numbers = action();
  } catch (...) {
    omp_set_num_threads(before);
    throw;
  }
  omp_set_num_threads(before);
  return numbers;
}

namespace {

std::string compare(const Numbers& one, const Numbers& other,
                    const std::function<bool(double a, double b, double largest)>& same) {
  for (const auto& [name, values] : one) {
    const auto& others = other.at(name);
    if (values.size() != others.size())
      return fmt::format("'{}' has {} numbers, and {} the other time", name, values.size(), others.size());
    double largest = 0.0;
    for (const double value : values)
      if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!same(values[i], others[i], largest))
        return fmt::format("'{}' of {} is {:.9g}, and {:.9g} the other time", name, i, values[i], others[i]);
  }
  return {};
}

}  // namespace

std::string difference(const Numbers& one, const Numbers& other) {
  return compare(one, other, [](double a, double b, double) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (std::isnan(a) && std::isnan(b));
  });
}

std::string difference(const Numbers& one, const Numbers& other, double tolerance) {
  return compare(one, other, [tolerance](double a, double b, double largest) {
    return std::abs(a - b) <= tolerance * largest || (std::isnan(a) && std::isnan(b));
  });
}

}  // namespace mesogen::testing
