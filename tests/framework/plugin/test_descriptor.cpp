#include "mesogen/plugin/descriptor.hpp"

#include <gtest/gtest.h>

#include "plugin/loader.hpp"

namespace {

using namespace mesogen;

void* create(Precision, int) { return nullptr; }

PluginDescriptor good() {
  return {descriptor_magic,
          abi_number,
          sizeof(PluginDescriptor),
          MESOGEN_BUILD_TAG,
          PluginKind::kernel,
          "good_1",
          "1.0.0",
          "A good one",
          DimensionSet{2, 3},
          &create};
}

TEST(Descriptor, GoodOneHasNoProblem) { EXPECT_EQ(plugin::descriptor_problem(good()), ""); }

TEST(Descriptor, KindMustBeKnown) {
  auto descriptor = good();
  descriptor.kind = static_cast<PluginKind>(7);
  EXPECT_EQ(plugin::descriptor_problem(descriptor), "its kind is 7; kinds are 1 to 6");
}

TEST(Descriptor, NameMustBeAnIdentifier) {
  auto descriptor = good();
  for (const char* name : {"", "Quintic", "two words", "dash-ed"}) {
    descriptor.name = name;
    EXPECT_EQ(plugin::descriptor_problem(descriptor),
              std::string("its name \"") + name + "\" is not made of small letters, digits and underscores");
  }
  descriptor.name = nullptr;
  EXPECT_EQ(plugin::descriptor_problem(descriptor),
            "its name \"\" is not made of small letters, digits and underscores");
}

TEST(Descriptor, TextsAndFactoryMustBeThere) {
  const std::string expected = "its descriptor lacks a version, a summary or a factory";
  auto descriptor = good();
  descriptor.version = nullptr;
  EXPECT_EQ(plugin::descriptor_problem(descriptor), expected);
  descriptor = good();
  descriptor.summary = nullptr;
  EXPECT_EQ(plugin::descriptor_problem(descriptor), expected);
  descriptor = good();
  descriptor.create = nullptr;
  EXPECT_EQ(plugin::descriptor_problem(descriptor), expected);
}

TEST(Descriptor, SomeDimensionMustBeThere) {
  auto descriptor = good();
  for (const DimensionSet& none : {DimensionSet{}, DimensionSet{1}}) {
    descriptor.dimensions = none;
    EXPECT_EQ(plugin::descriptor_problem(descriptor), "it has no form in any dimension: there are 2 and 3");
  }
}

TEST(Descriptor, NothingBehindAWrongMagicIsRead) {
  auto descriptor = good();
  descriptor.magic = 0;
  // Would crash if it were read.
  descriptor.name = reinterpret_cast<const char*>(std::uintptr_t{1});
  EXPECT_EQ(plugin::descriptor_problem(descriptor), "what it exports as `mesogen_plugin` is not a plugin descriptor");
}

}  // namespace
