#include <gtest/gtest.h>

#include "output/h5md_unit.hpp"

namespace mesogen::output {
namespace {

TEST(H5mdUnit, SpellsProductsOfPowers) {
  for (const auto& [plain, spelled] :
       std::initializer_list<std::pair<const char*, const char*>>{{"1", "1"},
                                                                  {"m", "m"},
                                                                  {"rad", "rad"},
                                                                  {"m/s", "m s-1"},
                                                                  {"1/s", "s-1"},
                                                                  {"m2/s", "m+2 s-1"},
                                                                  {"kg/m^3", "kg m-3"},
                                                                  {"kg/(m3 s)", "kg m-3 s-1"},
                                                                  {"Pa m6/kg2", "Pa m+6 kg-2"},
                                                                  {"1/(Pa s)", "Pa-1 s-1"},
                                                                  {"um/s", "um s-1"},
                                                                  {"pN s/um2", "pN s um-2"}})
    EXPECT_EQ(h5md_unit(plain), spelled);
}

/// The module lets each symbol stand only once.
TEST(H5mdUnit, GathersPowersOfASymbol) {
  EXPECT_EQ(h5md_unit("(m/s)/m"), "s-1");
  EXPECT_EQ(h5md_unit("(1/m)/m2"), "m-3");
  EXPECT_EQ(h5md_unit("m2 m"), "m+3");
  EXPECT_EQ(h5md_unit("m/m"), "1");
}

/// The module's own examples, and what this function made before.
TEST(H5mdUnit, KeepsWhatIsSpelledSo) {
  for (const char* text : {"nm+3", "um+2 s-1", "60 s", "10+3 m", "m s-1", "kg m-3 s-1", "s-1", "1"})
    EXPECT_EQ(h5md_unit(text), text);
}

TEST(H5mdUnit, KnowsWhatIsNoUnit) {
  for (const char* text : {"", " ", "particle spacings", "m, m, 1, rad", "degree", "m/", "/m", "m//s", "(m", "m)", "m^",
                           "m+", "m99999", "m/60 s", "((((("})
    EXPECT_EQ(h5md_unit(text), std::nullopt) << text;
}

}  // namespace
}  // namespace mesogen::output
