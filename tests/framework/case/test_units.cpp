#include "case/units.hpp"

#include <gtest/gtest.h>

#include "case_texts.hpp"

namespace mesogen {
namespace {

using testing::changed;
using testing::good_case;
using testing::read_all;

const Units film{"um", "s", "pN"};

TEST(Units, AreSiAndLeftAsDeclaredByDefault) {
  const Units si;
  for (const char* const unit : {"m", "kg/(m3 s)", "kg/m^3", "Pa m6/kg2", "1, m, m/s", "spacings"})
    EXPECT_EQ(si.text(unit), unit);
}

TEST(Units, ExpressWhatPluginsDeclare) {
  EXPECT_EQ(film.text("m"), "um");
  EXPECT_EQ(film.text("s"), "s");
  EXPECT_EQ(film.text("N"), "pN");
  EXPECT_EQ(film.text("m/s"), "um/s");
  EXPECT_EQ(film.text("m/s2"), "um/s2");
  EXPECT_EQ(film.text("1/s"), "1/s");
  EXPECT_EQ(film.text("1/m2"), "1/um2");
  EXPECT_EQ(film.text("Pa"), "pN/um2");
  EXPECT_EQ(film.text("Pa s"), "pN s/um2");
  EXPECT_EQ(film.text("1/(Pa s)"), "um2/(pN s)");
  EXPECT_EQ(film.text("N/m3"), "pN/um3");
  EXPECT_EQ(film.text("kg/m3"), "pN s2/um4");
  EXPECT_EQ(film.text("kg/m^3"), "pN s2/um4");
  EXPECT_EQ(film.text("kg/(m3 s)"), "pN s/um4");
  EXPECT_EQ(film.text("kg m/s"), "pN s");
  EXPECT_EQ(film.text("J/m"), "pN");
  EXPECT_EQ(film.text("(kg/m3)/m"), "pN s2/um5");
  EXPECT_EQ(film.text("Pa m6/kg2"), "um6/(pN s4)");
}

TEST(Units, LeaveOtherWordsAlone) {
  for (const char* const unit : {"1", "rad", "degree", "spacings", "particle spacings", "steps", "s of wall time"})
    EXPECT_EQ(film.text(unit), unit);
  EXPECT_EQ(film.text("1, m, m, 1, rad, m/s, s"), "1, um, um, 1, rad, um/s, s");
}

TEST(Units, OfACaseLabelItsMessagesAndConvertNothing) {
  const std::string text = std::string(good_case) + "[units]\nlength = \"um\"\ntime = \"ms\"\nforce = \"pN\"\n";
  Problems problems;
  const Case read = read_all(text, {}, problems);
  ASSERT_EQ(problems.text(), "");
  EXPECT_EQ(read.units.force, "pN");
  EXPECT_EQ(read.particles.spacing, 0.625);
  EXPECT_NE(read.resolved_text.find("length = \"um\""), std::string::npos);
  Problems wrong;
  read_all(text, {"time.end=-1"}, wrong);
  EXPECT_EQ(wrong.text(), "--set: time.end: must be > 0 ms, but is -1");
  Problems plugins;
  read_all(text, {"physics.flow.viscosity=-1"}, plugins);
  EXPECT_EQ(plugins.text(), "--set: physics.flow.viscosity: must be > 0 pN ms/um2, but is -1");
}

TEST(Units, AreNamesOfLettersAlone) {
  Problems problems;
  read_all(std::string(good_case) + "[units]\nlength = \"1e-6 m\"\n", {}, problems);
  EXPECT_NE(problems.text().find("units.length: must be the name of a unit, letters alone, such as \"um\", but is "
                                 "\"1e-6 m\""),
            std::string::npos)
      << problems.text();
}

}  // namespace
}  // namespace mesogen
