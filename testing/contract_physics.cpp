#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <set>
#include <tuple>

#include "backend/cuda_library.hpp"
#include "contract_run.hpp"

namespace mesogen::testing {

namespace {

/// Where the state of a run may hide: nothing here is looked at but what the plugin makes.
std::vector<std::string> made_by(PluginHarness& harness) {
  std::set<std::string> fields;
  for (const Pass& pass : harness.passes().passes()) {
    fields.insert(pass.write_list.begin(), pass.write_list.end());
    fields.insert(pass.accumulate_list.begin(), pass.accumulate_list.end());
  }
  return {fields.begin(), fields.end()};
}

Numbers numbers_of(PluginHarness& harness) {
  Numbers numbers;
  for (const std::string& field : made_by(harness))
    for (int c = 0; c < harness.components(field); ++c)
      numbers[harness.components(field) > 1 ? fmt::format("{} {}", field, c) : field] = harness.values(field, c);
  return numbers;
}

/// A scene whose fixed step is a tenth of what the plugin allows.
TestScene small_steps(const ContractRun& run) {
  TestScene scene;
  scene.step = 1e-3;
  PluginHarness probe = run.harness();
  for (const auto& [name, seconds] : probe.step_limits()) scene.step = std::min(scene.step, 0.1 * seconds);
  return scene;
}

std::string declaration_problem(const PassList& list) {
  for (const FieldDeclaration& field : list.fields())
    if (field.doc_text.empty() || field.unit_text.empty())
      return fmt::format("the field '{}' has no doc text or no unit: add .unit(\"...\").doc(\"...\")", field.name);
  std::set<std::string> names;
  for (const Pass& pass : list.passes()) {
    if (pass.name.empty()) return "a pass has no name";
    if (!names.insert(pass.name).second) return fmt::format("two passes are called '{}'", pass.name);
    if (!pass.body) return fmt::format("the pass '{}' does nothing: give it a body with .run(...)", pass.name);
    if (pass.write_list.empty() && pass.accumulate_list.empty() && !pass.at_every_step)
      return fmt::format("the pass '{}' makes no field, so it never runs: name what it writes or accumulates",
                         pass.name);
  }
  return {};
}

std::string finite_problem(PluginHarness& harness) {
  for (const auto& [name, values] : numbers_of(harness))
    for (std::size_t id = 0; id < values.size(); ++id)
      if (!std::isfinite(values[id])) return fmt::format("'{}' of particle {} is {}", name, id, values[id]);
  return {};
}

/// All phases once, on seeded fields, with those that it reads if they are present.
std::string run_all(const ContractRun& run, const TestScene& scene, bool with_optional) {
  PluginHarness harness = run.harness(scene);
  if (with_optional) {
    const PassList declared = harness.passes();
    for (const Pass& pass : declared.passes())
      for (const std::string& field : pass.optional_reads) harness.give(field);
  }
  harness.start();
  harness.run(Phase::end);
  harness.run(Phase::observe);
  return finite_problem(harness);
}

}  // namespace

void check_physics(ContractRun& run) {
  run.check("it can be made in single and double precision, in each of its dimensions", [&]() -> std::string {
    for (const int dimension :
         usable_dimensions(*run.registry().find(PluginKind::physics, run.name())->descriptor).list())
      for (const Precision precision : {Precision::single_precision, Precision::double_precision})
        (void)run.registry().make_physics(run.name(), precision, dimension);
    return {};
  });
  run.check("what it publishes stays the same when it is asked again", [&]() -> std::string {
    PluginHarness harness = run.harness();
    Scene once = harness.scene();
    harness.physics().publish(once);
    Scene twice = once;
    harness.physics().publish(twice);
    for (const auto& [name, value] : twice.constants)
      if (const double before = once.constant(name, std::numeric_limits<double>::quiet_NaN()); before != value)
        return fmt::format("the constant '{}' is {:.9g}, then {:.9g}: publish() is called twice, so set it, do not add",
                           name, before, value);
    for (const auto& [what, before, after] :
         {std::tuple("stress", once.scales.stress, twice.scales.stress),
          std::tuple("passing stress", once.scales.passing_stress, twice.scales.passing_stress),
          std::tuple("speed", once.scales.speed, twice.scales.speed)})
      if (before != after)
        return fmt::format("the {} is {:.9g}, then {:.9g}: publish() is called twice, so raise it by std::max", what,
                           before, after);
    return {};
  });
  run.check("fields and passes are named and described", [&] { return declaration_problem(run.harness().passes()); });
  // A limit that is not positive is refused by the set-up, in words.
  run.check("limits on the step are positive and named", [&]() -> std::string {
    return run.harness().step_limits().contains("") ? "a limit has no name: say what limits, and by which rule" : "";
  });
  run.check("passes touch only what they declared, and make finite numbers", [&]() -> std::string {
    const TestScene scene = small_steps(run);
    const std::string problem = run_all(run, scene, false);
    return problem.empty() ? run_all(run, scene, true) : problem;
  });
  const auto after_steps = [&](int threads) {
    return with_threads(threads, [&] {
      PluginHarness harness = run.harness(small_steps(run));
      harness.step(2);
      return numbers_of(harness);
    });
  };
  run.check("the same input gives the same bits, again and with 3 threads", [&]() -> std::string {
    const Numbers first = after_steps(1);
    std::string problem = difference(first, after_steps(1));
    if (!problem.empty()) return problem + ": something is left over from another run, or not set before it is read";
    problem = difference(first, after_steps(3));
    if (problem.empty()) return {};
    return problem + " (with 3 threads): let each particle write only what is its own, and sum with sph::pair_sum";
  });
  run.check("a resumed run goes on to the same bits as an unbroken one", [&]() -> std::string {
    PluginHarness first = run.harness(small_steps(run));
    first.step(2);
    PluginHarness second = run.harness(small_steps(run));
    second.resume_from(first);
    first.step(2);
    second.step(2);
    const std::string problem = difference(numbers_of(first), numbers_of(second));
    return problem.empty() ? "" : problem + " after a resume: name what passes bring from step to step, by keep()";
  });
  run.check("single precision agrees with double", [&]() -> std::string {
    const auto rates = [&](Precision precision) {
      TestScene scene;
      scene.precision = precision;
      PluginHarness harness = run.harness(scene);
      harness.start();
      return numbers_of(harness);
    };
    const std::string problem =
        difference(rates(Precision::double_precision), rates(Precision::single_precision), 1e-3);
    return problem.empty() ? "" : problem + " in single precision: a number is too large or too small for float";
  });
  if (!run.registry().has_cuda(run.name()))
    return run.note("not checked: that CUDA agrees with the CPU, because this plugin has no library for CUDA");
  if (const CudaBackend cuda = cuda_backend(); cuda.backend == nullptr)
    return run.note("not checked: that CUDA agrees with the CPU, because " + cuda.problem);
  run.check("CUDA agrees with the CPU", [&]() -> std::string {
    const auto on = [&](const std::string& device) {
      TestScene scene = small_steps(run);
      scene.device = device;
      PluginHarness harness = run.harness(scene);
      harness.step(2);
      return numbers_of(harness);
    };
    const std::string problem = difference(on("cpu"), on("cuda"), 1e-9);
    return problem.empty() ? "" : problem + " on CUDA: a functor does something else there";
  });
}

}  // namespace mesogen::testing
