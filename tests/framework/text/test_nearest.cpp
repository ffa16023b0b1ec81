#include "text/nearest.hpp"

#include <gtest/gtest.h>

namespace mesogen {
namespace {

const std::vector<std::string> keys = {"activity", "viscosity", "viscosity_form", "density", "periodic_ghosts",
                                       "A",        "C"};

TEST(Nearest, MendsTypingErrors) {
  EXPECT_EQ(nearest("activty", keys), "activity");      // left out
  EXPECT_EQ(nearest("acitvity", keys), "activity");     // swapped
  EXPECT_EQ(nearest("viscossity", keys), "viscosity");  // doubled
  EXPECT_EQ(nearest("Density", keys), "density");
  EXPECT_EQ(nearest("a", keys), "A");
}

TEST(Nearest, CompletesWords) { EXPECT_EQ(nearest("periodik", keys), "periodic_ghosts"); }

TEST(Nearest, StaysSilentWhereNothingIsClose) {
  EXPECT_EQ(nearest("B", keys), "");
  EXPECT_EQ(nearest("temperature", keys), "");
  EXPECT_EQ(nearest("", keys), "");
  EXPECT_EQ(nearest("activity", {}), "");
  EXPECT_EQ(nearest(std::string(1000000, 'a'), keys), "");
}

TEST(Nearest, IsAskedAsAQuestion) {
  EXPECT_EQ(did_you_mean("activty", keys), "; did you mean \"activity\"?");
  EXPECT_EQ(did_you_mean("temperature", keys), "");
}

}  // namespace
}  // namespace mesogen
