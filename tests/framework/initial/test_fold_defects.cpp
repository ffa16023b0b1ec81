// Defects given beyond the faces of the box: folded along periodic axes, refused at walls.

#include <gtest/gtest.h>

#include "case_run.hpp"
#include "initial/defects.hpp"
#include "mesogen/diagnostics/error.hpp"

namespace mesogen::test {
namespace {

CaseText defects_at(const std::string& rows, const std::string& boundary = "periodic_ghosts") {
  CaseText text(10.0, 20);
  text.boundary(boundary)
      .section("director", "type = \"defects\"\ndefects = " + rows)
      .nematic(0.4, 0.7, 0.02)
      .read("\"order_tensor\"");
  return text;
}

TEST(FoldDefects, APlaceBeyondAPeriodicFaceIsThatInside) {
  for (const char* const boundary : {"periodic_ghosts", "periodic_wrap"}) {
    CaseRun inside(defects_at("[[0.0, 2.5, 0.5], [5.0, 7.5, -0.5]]", boundary));
    for (const char* const rows :
         {"[[10.0, 2.5, 0.5], [5.0, 7.5, -0.5]]", "[[-10.0, 12.5, 0.5], [25.0, -2.5, -0.5]]"}) {
      CaseRun folded(defects_at(rows, boundary));
      for (int c = 0; c < 2; ++c) EXPECT_EQ(folded.field("order_tensor", c), inside.field("order_tensor", c)) << rows;
    }
  }
}

std::string refusal_of(const CaseText& text) {
  try {
    const CaseRun run(text);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_case);
    return error.what();
  }
  return "nothing was refused";
}

// Walls lie across y here; x is periodic.
TEST(FoldDefects, BeyondAWallTheyAreRefused) {
  for (const char* const y : {"10.0", "12.5", "-0.1"})
    EXPECT_NE(
        refusal_of(defects_at(std::string("[[5.0, 5.0, 0.5], [17.5, ") + y + ", -0.5]]", "walls"))
            .find("director.defects: row 2: must lie in the box, y from 0 to 10 m, where this axis ends at walls, "
                  "but is at "),
        std::string::npos)
        << y;
}

TEST(FoldDefects, WhatIsTooFarToFoldIsRefused) {
  EXPECT_NE(refusal_of(defects_at("[[1e20, 5.0, 0.5], [5.0, 7.5, -0.5]]"))
                .find("row 1: must lie in the box, x from 0 to 10 m, or within 1e9 boxes of it, but is at 1e+20"),
            std::string::npos);
}

TEST(FoldDefects, ThoseAtOnePlaceAfterFoldingAreRefused) {
  EXPECT_NE(refusal_of(defects_at("[[0.1, 5.0, 0.5], [10.1, -5.0, -0.5]]"))
                .find("director.defects: rows 1 and 2 are at the same place"),
            std::string::npos);
}

}  // namespace
}  // namespace mesogen::test
