#include "plugin/registry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "error_of.hpp"
#include "plugin/instruction_set.hpp"
#include "test_plugins.hpp"

namespace {

using namespace mesogen;
namespace fs = std::filesystem;

fs::path broken(const std::string& folder) { return fs::path(MESOGEN_TEST_BROKEN_PLUGINS) / folder; }

/// Sets a variable of the environment while it lives.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) { setenv(name, value.c_str(), 1); }
  ~Variable() { unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
};

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// The one reason why the library of a broken folder was refused.
std::string reason(const std::string& folder) {
  const auto registry = PluginRegistry::only({broken(folder)});
  EXPECT_TRUE(registry.all().empty());
  if (registry.refused().size() != 1) {
    ADD_FAILURE() << "refused: " << registry.refused().size();
    return {};
  }
  EXPECT_EQ(registry.refused()[0].file.filename(), folder + ".so");
  return registry.refused()[0].reason;
}

TEST(PluginRegistry, FindsEveryKernelAndBoundaryOfTheBuild) {
  const auto& registry = test::built_plugins();
  const auto kernels = registry.names(PluginKind::kernel);
  EXPECT_EQ(kernels, (std::vector<std::string>{"quintic", "wendland_c2", "wendland_c4", "wendland_c6"}));
  EXPECT_EQ(registry.names(PluginKind::boundary),
            (std::vector<std::string>{"periodic_ghosts", "periodic_wrap", "walls"}));
  EXPECT_TRUE(registry.refused().empty()) << registry.refusals().front();
  const auto* quintic = registry.find(PluginKind::kernel, "quintic");
  ASSERT_NE(quintic, nullptr);
  EXPECT_STREQ(quintic->descriptor->version, "1.0.0");
  EXPECT_TRUE(quintic->file.is_absolute());
  EXPECT_EQ(registry.find(PluginKind::boundary, "quintic"), nullptr);
}

TEST(PluginRegistry, RefusesAnotherInterfaceNamingBoth) {
  EXPECT_EQ(reason("wrong_abi"), "it was built for plugin interface 99, this Mesogen has " +
                                     std::to_string(abi_number) + "; build it again");
}

TEST(PluginRegistry, RefusesAnotherDescriptorSize) {
  EXPECT_EQ(reason("wrong_size"), "its descriptor has 8 bytes, this Mesogen expects " +
                                      std::to_string(sizeof(PluginDescriptor)) + "; build it again");
}

TEST(PluginRegistry, RefusesAnotherCompilerNamingBoth) {
  EXPECT_EQ(reason("wrong_tag"),
            "it was built with icc-7, this Mesogen with " MESOGEN_BUILD_TAG "; build it again with the same compiler");
}

TEST(PluginRegistry, RefusesWhatIsNoDescriptor) {
  EXPECT_EQ(reason("wrong_magic"), "what it exports as `mesogen_plugin` is not a plugin descriptor");
  EXPECT_EQ(reason("null_descriptor"), "what it exports as `mesogen_plugin` is not a plugin descriptor");
  EXPECT_EQ(reason("no_descriptor"), "it exports no `mesogen_plugin`, so it is not a Mesogen plugin");
}

TEST(PluginRegistry, RefusesATextFile) { EXPECT_EQ(reason("no_library"), "it is not a shared library"); }

TEST(PluginRegistry, NamesAnUnresolvedSymbol) {
  const auto text = reason("unresolved");
  EXPECT_TRUE(contains(text, "the dynamic linker refuses it")) << text;
  EXPECT_TRUE(contains(text, "function_that_nobody_wrote")) << text;
}

TEST(PluginRegistry, RefusesALibraryCutShortAnywhere) {
  const fs::path folder = fs::path(testing::TempDir()) / "mesogen_cut_short";
  fs::create_directories(folder);
  const fs::path whole = fs::path(MESOGEN_TEST_PLUGIN_FOLDER) / "quintic.so";
  const auto size = fs::file_size(whole);
  for (const auto left : {std::uintmax_t{0}, std::uintmax_t{10}, std::uintmax_t{64}, size / 4, size / 2, size - 1}) {
    fs::copy_file(whole, folder / "cut.so", fs::copy_options::overwrite_existing);
    fs::resize_file(folder / "cut.so", left);
    const auto registry = PluginRegistry::only({folder});
    ASSERT_EQ(registry.refused().size(), 1U) << left << " bytes";
    const auto text = registry.refused()[0].reason;
    EXPECT_TRUE(text == "it is cut short; build or copy it again" || text == "it is not a shared library") << text;
  }
  fs::remove_all(folder);
}

TEST(PluginRegistry, RefusesTwoOfOneKindAndNameNamingBothFiles) {
  const auto text = error_of(
      [] {
        (void)PluginRegistry::only({broken("twin_a"), broken("twin_b")});
      },
      ExitCode::plugin_refused);
  EXPECT_TRUE(contains(text, "two plugins of the kind kernel are called \"twin\"")) << text;
  EXPECT_TRUE(contains(text, "first_twin.so")) << text;
  EXPECT_TRUE(contains(text, "second_twin.so")) << text;
}

TEST(PluginRegistry, TakesTheTwinOfTheFirstFolderIfTold) {
  for (const auto& [first, second] : {std::pair("twin_a", "twin_b"), std::pair("twin_b", "twin_a")}) {
    const auto registry = PluginRegistry::scan({broken(first), broken(second)}, Twins::first_folder);
    const auto* twin = registry.find(PluginKind::kernel, "twin");
    ASSERT_NE(twin, nullptr);
    EXPECT_EQ(twin->file.parent_path(), fs::canonical(broken(first)));
  }
}

TEST(PluginRegistry, TakesAFolderGivenTwiceOnce) {
  const auto registry = PluginRegistry::only({broken("twin_a"), broken("twin_a/../twin_a")});
  EXPECT_EQ(registry.names(PluginKind::kernel), std::vector<std::string>{"twin"});
}

TEST(PluginRegistry, RefusesAFolderThatIsNotThere) {
  const auto text = error_of([] { (void)PluginRegistry::scan({"/nowhere/plugins"}); }, ExitCode::bad_case);
  EXPECT_EQ(text, "plugin folder /nowhere/plugins does not exist or is no folder");
}

TEST(PluginRegistry, SearchesTheVariableAndTheInstallation) {
  const Variable path("MESOGEN_PLUGIN_PATH", "/nowhere:" + broken("twin_a").string() + ":");
  const auto registry = PluginRegistry::scan();
  EXPECT_NE(registry.find(PluginKind::kernel, "twin"), nullptr);
  EXPECT_NE(registry.find(PluginKind::kernel, "quintic"), nullptr);
  ASSERT_EQ(registry.refusals().size(), 1U);
  EXPECT_EQ(registry.refusals()[0], "/nowhere: MESOGEN_PLUGIN_PATH names it, but there is no such folder");
}

TEST(PluginRegistry, SuggestsTheNearestName) {
  const auto error = test::built_plugins().missing(PluginKind::kernel, "quintik");
  EXPECT_EQ(error.code(), ExitCode::bad_case);
  EXPECT_STREQ(
      error.what(),
      "no kernel plugin is called \"quintik\" (there are: quintic, wendland_c2, wendland_c4, wendland_c6); did you "
      "mean \"quintic\"?; a plugin of your own is found with --plugin-path DIR or MESOGEN_PLUGIN_PATH=DIR, DIR being "
      "its folder build/plugins");
}

TEST(PluginRegistry, SuggestsTheNearestNameOfAnyKind) {
  const auto error = test::built_plugins().missing("walks");
  EXPECT_EQ(error.code(), ExitCode::bad_case);
  EXPECT_STREQ(error.what(),
               "no plugin is called \"walks\" (see `mesogen plugin list`); did you mean \"walls\"?; a plugin of your "
               "own is found with --plugin-path DIR or MESOGEN_PLUGIN_PATH=DIR, DIR being its folder build/plugins");
}

TEST(PluginRegistry, SaysWhyAPluginIsMissingIfItWasRefused) {
  const auto registry = PluginRegistry::only({broken("wrong_abi")});
  const auto text = error_of([&] { (void)registry.make_kernel("wrong_abi", 2); }, ExitCode::plugin_refused);
  EXPECT_TRUE(contains(text, "the kernel plugin \"wrong_abi\" was refused: ")) << text;
  EXPECT_TRUE(contains(text, "interface 99")) << text;
}

TEST(PluginRegistry, SaysWhereItLookedIfThereIsNoPluginOfAKind) {
  const auto registry = PluginRegistry::only({broken("twin_a")});
  EXPECT_EQ(std::string(registry.missing(PluginKind::physics, "wcsph").what()),
            "there is no physics plugin at all; looked in: " + fs::canonical(broken("twin_a")).string() +
                "; a plugin of your own is found with --plugin-path DIR or MESOGEN_PLUGIN_PATH=DIR, DIR being its "
                "folder build/plugins");
}

TEST(PluginRegistry, RefusesAFormThatAPluginLacks) {
  const auto registry = PluginRegistry::only({broken("no_form")});
  const auto text = error_of([&] { (void)registry.make_boundary("no_form", 2); }, ExitCode::bad_case);
  EXPECT_EQ(text, "the boundary plugin \"no_form\" has no form for 2 dimensions in double precision");
}

TEST(PluginRegistry, RefusesAPrecisionThatAPluginLacks) {
  const auto registry = PluginRegistry::only({broken("exact")});
  EXPECT_NE(registry.make_physics("exact", Precision::double_precision, 2), nullptr);
  EXPECT_EQ(error_of([&] { (void)registry.make_physics("exact", Precision::single_precision, 2); }, ExitCode::bad_case),
            "the physics plugin \"exact\" has no form for 2 dimensions in single precision");
}

TEST(PluginRegistry, RefusesADimensionThatAPluginLacks) {
  const auto registry = PluginRegistry::only({broken("solid")});
  const auto refusal = [](const std::string& kind) {
    return "the " + kind + " plugin \"solid_" + kind +
           "\" has no form for 2 dimensions: it has one for 3; a scene has as many dimensions as domain.size has "
           "numbers";
  };
  const auto refused = [](const auto& action) { return error_of(action, ExitCode::bad_case); };
  EXPECT_EQ(refused([&] { (void)registry.make_kernel("solid_kernel", 2); }), refusal("kernel"));
  EXPECT_EQ(refused([&] { (void)registry.make_boundary("solid_boundary", 2); }), refusal("boundary"));
  EXPECT_EQ(refused([&] { (void)registry.make_initial("solid_initial", 2); }), refusal("initial"));
  EXPECT_EQ(refused([&] { (void)registry.make_observer("solid_observer", 2); }), refusal("observer"));
  EXPECT_EQ(refused([&] { (void)registry.make_physics("solid_physics", Precision::single_precision, 2); }),
            refusal("physics"));
  EXPECT_EQ(refused([&] { (void)registry.smallest_dimension(PluginKind::physics, "solid_physics"); }),
            refusal("physics"));
}

TEST(PluginRegistry, RefusesADimensionThatIsNotBuilt) {
  const auto registry = PluginRegistry::only({broken("solid")});
  EXPECT_EQ(error_of([&] { (void)registry.make_kernel("solid_kernel", 3); }, ExitCode::bad_case),
            "this Mesogen is built for 2 dimensions, not for 3");
}

TEST(PluginRegistry, KnowsTheDimensionsOfEveryPlugin) {
  const auto& registry = test::built_plugins();
  const auto of = [&](PluginKind kind, const char* name) { return registry.find(kind, name)->descriptor->dimensions; };
  EXPECT_EQ(of(PluginKind::physics, "friction"), (DimensionSet{2, 3})) << "without a constraint";
  EXPECT_EQ(of(PluginKind::physics, "beris_edwards"), DimensionSet{2}) << "requires(Dim == 2)";
  EXPECT_EQ(of(PluginKind::kernel, "quintic"), (DimensionSet{2, 3})) << "without a member `dimensions`";
  EXPECT_EQ(of(PluginKind::observer, "defects"), DimensionSet{2}) << "with one";
  EXPECT_EQ(registry.smallest_dimension(PluginKind::observer, "defects"), 2);
}

TEST(PluginRegistry, LoadsTheBestInstructionSetThatIsAllowed) {
  const auto loaded = [](const std::string& cap) {
    const Variable simd("MESOGEN_SIMD", cap);
    const auto registry = PluginRegistry::only({broken("variants")});
    const auto& plugin = registry.all().at(0);
    EXPECT_EQ(plugin.instruction_set, plugin.descriptor->version);  // the fixture's version says what it was built for
    return plugin.instruction_set;
  };
  EXPECT_EQ(loaded("baseline"), "baseline");
  const auto sets = plugin::usable_instruction_sets();
  EXPECT_EQ(loaded(""), sets.empty() ? "baseline" : sets.front());
  if (std::ranges::find(sets, "x86-64-v3") != sets.end()) {
    EXPECT_EQ(loaded("x86-64-v3"), "x86-64-v3");
  }
}

TEST(InstructionSets, AreCapped) {
  const std::vector<std::string> both{"x86-64-v4", "x86-64-v3"};
  EXPECT_EQ(plugin::capped(both, ""), both);
  EXPECT_EQ(plugin::capped(both, "x86-64-v4"), both);
  EXPECT_EQ(plugin::capped(both, "x86-64-v3"), std::vector<std::string>{"x86-64-v3"});
  EXPECT_TRUE(plugin::capped(both, "baseline").empty());
  EXPECT_EQ(error_of([&] { (void)plugin::capped(both, "avx9"); }, ExitCode::bad_case),
            "MESOGEN_SIMD is \"avx9\"; it must be baseline, x86-64-v3 or x86-64-v4, or not be set");
}

TEST(InstructionSets, CodeForAnotherProcessorIsTold) {
  const std::vector<std::string> both{"x86-64-v4", "x86-64-v3"};
  EXPECT_EQ(plugin::narrow_code_text("baseline", both),
            "sums over neighbours run in code for baseline, but this processor has x86-64-v4: they would be faster if "
            "Mesogen were built on this machine, or with -DMESOGEN_INSTRUCTION_SETS=x86-64-v4");
  EXPECT_NE(plugin::narrow_code_text("x86-64-v3", both), "");
  EXPECT_EQ(plugin::narrow_code_text("x86-64-v4", both), "");
  EXPECT_EQ(plugin::narrow_code_text("x86-64-v4", {"x86-64-v3"}), "") << "capped by MESOGEN_SIMD";
  EXPECT_EQ(plugin::narrow_code_text("baseline", {}), "");
}

}  // namespace
