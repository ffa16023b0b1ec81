#include <fmt/format.h>

#include <cmath>
#include <set>

#include "contract_run.hpp"

namespace mesogen::testing {

namespace {

/// What the plugin sets, by field and component.
Numbers start_of(const ContractRun& run) {
  PluginHarness harness = run.harness();
  Numbers numbers;
  for (const FieldDeclaration& field : harness.initial_plan().fields())
    for (int c = 0; c < harness.components(field.name); ++c)
      numbers[fmt::format("{} {}", field.name, c)] = harness.values(field.name, c);
  return numbers;
}

}  // namespace

void check_initial(ContractRun& run) {
  run.check("the fields that it sets are named and described", [&]() -> std::string {
    PluginHarness harness = run.harness();
    std::set<std::string> names;
    for (const FieldDeclaration& field : harness.initial_plan().fields()) {
      if (!names.insert(field.name).second) return fmt::format("'{}' is named twice", field.name);
      if (field.doc_text.empty() || field.unit_text.empty())
        return fmt::format("'{}' has no doc text or no unit: add .unit(\"...\").doc(\"...\")", field.name);
    }
    return names.empty() ? "it sets no field: name what it sets in plan()" : "";
  });
  run.check("it sets finite numbers", [&]() -> std::string {
    for (const auto& [name, values] : start_of(run))
      for (std::size_t i = 0; i < values.size(); ++i)
        if (!std::isfinite(values[i]))
          return fmt::format("field and component '{}' of particle {} is {}", name, i, values[i]);
    return {};
  });
  run.check("the same input gives the same bits, again and with 3 threads", [&]() -> std::string {
    const auto start = [&](int threads) { return with_threads(threads, [&] { return start_of(run); }); };
    const Numbers first = start(1);
    const std::string again = difference(first, start(1));
    if (!again.empty()) return again + ": take random numbers from mesogen/exec/random.hpp, by seed and particle";
    const std::string threads = difference(first, start(3));
    return threads.empty() ? "" : threads + " (with 3 threads): set each particle by itself";
  });
}

}  // namespace mesogen::testing
