#include <fmt/format.h>

#include <set>

#include "contract_run.hpp"

namespace mesogen::testing {

namespace {

/// A scene in which nothing happens by itself.
PluginHarness at_start(const ContractRun& run) {
  TestScene scene;
  scene.step = 1e-3;
  return run.harness(scene);
}

/// Particles that moved after some steps.
PluginHarness moved(const ContractRun& run) {
  PluginHarness harness = at_start(run);
  harness.step(2);
  harness.move([](double, double y) { return 0.3 * y; }, [](double, double) { return 0.1; });
  return harness;
}

Numbers numbers_of(const PluginHarness::Quantities& sampled) { return {sampled.begin(), sampled.end()}; }

}  // namespace

void check_observer(ContractRun& run) {
  run.check("its quantities are named and described", [&]() -> std::string {
    PluginHarness harness = run.harness();
    std::set<std::string> names;
    for (const Quantity& quantity : harness.plan().quantities()) {
      if (!names.insert(quantity.name).second) return fmt::format("'{}' is planned twice", quantity.name);
      if (quantity.doc_text.empty() || quantity.unit_text.empty())
        return fmt::format("'{}' has no doc text or no unit: add .unit(\"...\").doc(\"...\")", quantity.name);
    }
    return names.empty() ? "it plans no quantity: name what it records in plan()" : "";
  });
  run.check("it reads only what it planned, and samples exactly the quantities that it planned", [&]() -> std::string {
    PluginHarness harness = run.harness();
    (void)harness.sample();
    PluginHarness with_optional = run.harness();
    const ObserverPlan plan = with_optional.plan();
    for (const std::string& field : plan.optional_list()) with_optional.give(field);
    (void)with_optional.sample();
    return {};
  });
  const auto sampled = [&](int threads) {
    return with_threads(threads, [&] { return numbers_of(moved(run).sample()); });
  };
  run.check("the same input gives the same bits, again and with 3 threads", [&]() -> std::string {
    const Numbers first = sampled(1);
    std::string problem = difference(first, sampled(1));
    if (!problem.empty()) return problem + ": something is left over from another run, or not set before it is read";
    problem = difference(first, sampled(3));
    return problem.empty() ? "" : problem + " (with 3 threads): sum in one order, such as by particle id";
  });
  run.check("it records the same however the particles are stored", [&]() -> std::string {
    PluginHarness harness = moved(run);
    harness.shuffle(7);
    const Numbers shuffled = with_threads(1, [&] { return numbers_of(harness.sample()); });
    const std::string problem = difference(sampled(1), shuffled, 1e-9);
    return problem.empty() ? "" : problem + " with another order of storage: go by id, see mesogen/plugin/by_id.hpp";
  });
  run.check("a resumed run records the same as an unbroken one", [&]() -> std::string {
    PluginHarness first = moved(run);
    PluginHarness second = at_start(run);
    second.resume_from(first);
    const std::string problem = difference(numbers_of(first.sample()), numbers_of(second.sample()));
    return problem.empty() ? "" : problem + " after restore(): keep in save() all that it has gathered since start()";
  });
}

}  // namespace mesogen::testing
