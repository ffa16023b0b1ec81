#include <gtest/gtest.h>

#include <set>

#include "mesogen/plugin/observer.hpp"

namespace mesogen {
namespace {

std::vector<std::string> read_where(const std::set<std::string>& present) {
  ObserverPlan plan;
  plan.reads("volume");
  plan.reads_if_present("colour");
  plan.reads_if_present("energy", "slope");
  return plan.fields([&](const std::string& field) { return present.contains(field); });
}

// Of a field and what is read in its place, one alone: nobody makes both.
TEST(ObserverPlan, ReadsAFieldOrWhatIsReadInItsPlace) {
  using Fields = std::vector<std::string>;
  EXPECT_EQ(read_where({"energy", "slope"}), (Fields{"volume", "energy"}));
  EXPECT_EQ(read_where({"slope", "colour"}), (Fields{"volume", "colour", "slope"}));
  EXPECT_EQ(read_where({}), (Fields{"volume", "slope"}));
}

}  // namespace
}  // namespace mesogen
