// Whole cases with something broken in them, set up with real plugins: each is refused with a message, or every key in
// it had its effect. Never a crash, never a key ignored.

#include <gtest/gtest.h>

#include <toml++/toml.h>
#include <map>
#include <sstream>

#include "case/arrangement.hpp"
#include "mutator.hpp"
#include "run/setup.hpp"
#include "test_plugins.hpp"

namespace mesogen {
namespace {

constexpr const char* good_case = R"(title = "mutated"
[domain]
size = [10.0, 10.0]
boundary = "periodic_ghosts"
[particles]
spacing = 0.625
arrangement = "jittered"
jitter = 0.1
seed = 3
[kernel]
type = "quintic"
smoothing_length = 1.3333333
[director]
type = "modes"
modes = [[1, 0, 0.05, 0.3], [0, 1, 0.03, 1.1]]
order = 1.0
[physics.flow]
type = "wcsph"
density = 1.0
viscosity = 0.6667
sound_speed = "auto"
shift = 1.0
[physics.nematic]
type = "beris_edwards"
rotational_diffusivity = 0.4
flow_alignment = 0.7
elastic_constant = 0.02
bulk = { A = -1.0, B = 0.0, C = 0.5 }
[physics.activity]
type = "active_stress"
activity = 0.05
[time]
end = 60.0
[observers.flow]
type = "flow_statistics"
interval = 1.0
[observers.paths]
type = "pathlines"
count = 4
every = 10
[output]
interval = 10.0
checkpoint_interval = 60.0
fields = ["velocity", "order_tensor"]
[run]
precision = "double"
device = "cpu"
)";

// Every key that holds a value, and the value as text; numbers without the difference between 1 and 1.0.
void leaves(const toml::node& node, const std::string& path, std::map<std::string, std::string>& out) {
  if (const auto* table = node.as_table()) {
    for (const auto& [key, value] : *table) leaves(value, path + "." + std::string(key.str()), out);
    return;
  }
  if (const auto* array = node.as_array()) {
    for (std::size_t n = 0; n < array->size(); ++n) leaves((*array)[n], path + "[" + std::to_string(n) + "]", out);
    return;
  }
  std::ostringstream text;
  text.precision(17);
  if (const auto number = node.value<double>(); number && !node.is_boolean()) {
    text << *number;
  } else if (const auto word = node.value<std::string>()) {
    text << *word;
  } else if (const auto flag = node.value<bool>()) {
    text << *flag;
  }
  out[path] = text.str();
}

std::map<std::string, std::string> leaves_of(const std::string& text) {
  std::map<std::string, std::string> all;
  leaves(toml::parse(text), "", all);
  return all;
}

void try_mutations(std::uint32_t first, std::uint32_t last) {
  int accepted = 0;
  for (std::uint32_t seed = first; seed < last; ++seed) {
    const std::string text = test::Mutator(seed).mutated(good_case);
    SCOPED_TRACE("seed " + std::to_string(seed) + "\n" + text);
    Problems problems;
    Case source = read_case_text(text, "case.toml", {}, problems);
    // A good case with very many particles would only take long.
    if (problems.empty()) {
      if (lattice_counts(source).total() > 3e5) continue;
    }
    try {
      const auto setup = set_up(std::move(source), test::built_plugins(), problems);
      const auto resolved = leaves_of(setup->resolved_text);
      for (const auto& [key, value] : leaves_of(text)) {
        if (key.starts_with(".output.fields") || key == ".domain.boundary.type") continue;
        const auto at = resolved.find(key);
        ASSERT_NE(at, resolved.end()) << key << " was accepted and forgotten:\n" << setup->resolved_text;
        ASSERT_EQ(at->second, value) << key;
      }
      ++accepted;
    } catch (const Error& error) {
      const std::string said = error.what();
      ASSERT_TRUE(error.code() == ExitCode::bad_case || error.code() == ExitCode::plugin_refused) << said;
      ASSERT_NE(said.find("case.toml"), std::string::npos) << said;
    }
  }
  EXPECT_GT(accepted, 100);
  testing::Test::RecordProperty("accepted", accepted);
}

TEST(MutatedCasesWithPlugins, AreRefusedOrObeyed) { try_mutations(0, 14000); }

}  // namespace
}  // namespace mesogen
