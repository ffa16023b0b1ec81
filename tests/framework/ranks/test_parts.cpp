// How a box is shared among ranks.

#include <gtest/gtest.h>

#include <vector>

#include "error_of.hpp"
#include "ghosts/parts.hpp"
#include "ranks/ranks.hpp"
#include "test_plugins.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

/// Of a box of 8 x 12 in which neighbours are looked for as far as 2: 12 rows.
Parts parts_of(const std::string& boundary_name, int ranks) {
  Scene scene;
  scene.dimension = 2;
  scene.box = {8.0, 12.0, 0.0};
  const auto boundary = built_plugins().make_boundary(boundary_name, 2);
  return {CellGrid(scene, *boundary, 2.0), ranks};
}

TEST(Parts, AreWholeRowsOfCells) {
  const Parts parts = parts_of("periodic_ghosts", 5);
  EXPECT_EQ(parts.rows(), 12);
  EXPECT_EQ(parts.begins(), (std::vector<int>{0, 2, 4, 7, 9, 12}));
  for (int rank = 0; rank < 5; ++rank)
    for (int row = parts.begin(rank); row < parts.end(rank); ++row) EXPECT_EQ(parts.owner_of(row), rank);
  // A row has 16 cells, narrow along x.
  EXPECT_EQ(parts.cells(1).first, 2 * 16);
  EXPECT_EQ(parts.cells(1).end, 4 * 16);
  EXPECT_EQ(parts.row_of(2 * 16 - 1), 1);
  EXPECT_EQ(parts.row_of(2 * 16), 2);
}

TEST(Parts, SeeRowsBesideTheirs) {
  const Parts ghosts = parts_of("periodic_ghosts", 4);  // three rows each
  EXPECT_TRUE(ghosts.sees(1, 2, 1));
  EXPECT_TRUE(ghosts.sees(1, 2, 7));
  EXPECT_FALSE(ghosts.sees(1, 2, 0));
  EXPECT_FALSE(ghosts.sees(1, 2, 8));
  EXPECT_TRUE(ghosts.sees(0, 2, -2));  // beyond the face
  EXPECT_FALSE(ghosts.sees(0, 2, 11));
  EXPECT_TRUE(ghosts.sees_wrapped(0, 2, 11));  // as an image
  EXPECT_TRUE(ghosts.slab(1, 2).holds(1.0));
  EXPECT_TRUE(ghosts.slab(1, 2).holds(7.99));
  EXPECT_FALSE(ghosts.slab(1, 2).holds(0.99));
  EXPECT_FALSE(ghosts.slab(1, 2).holds(8.01));
  const Parts wrapped = parts_of("periodic_wrap", 4);
  EXPECT_TRUE(wrapped.sees(0, 2, 11));
  EXPECT_FALSE(wrapped.sees(0, 2, 9));
  EXPECT_TRUE(wrapped.slab(0, 2).holds(9.0));  // goes by rows
}

TEST(Parts, MoveWhereOneRankHasTooMuch) {
  Parts parts = parts_of("periodic_ghosts", 3);
  std::vector<std::int64_t> in_row(12, 100);
  EXPECT_FALSE(parts.balance(in_row));
  in_row = {400, 100, 100, 100, 100, 100, 50, 50, 50, 50, 50, 50};  // 1200: 400 each
  EXPECT_TRUE(parts.balance(in_row));
  EXPECT_EQ(parts.begins(), (std::vector<int>{0, 1, 5, 12}));
  EXPECT_FALSE(parts.balance(in_row));
  in_row.assign(12, 0);
  in_row[11] = 1000;  // no border can help
  (void)parts.balance(in_row);
  for (int rank = 0; rank < 3; ++rank) EXPECT_LT(parts.begin(rank), parts.end(rank));
}

TEST(Parts, ComeBackFromACheckpoint) {
  Parts parts = parts_of("periodic_ghosts", 3);
  using Rows = std::vector<std::int64_t>;
  EXPECT_TRUE(parts.can_take(Rows{0, 1, 2, 12}));
  EXPECT_FALSE(parts.can_take(Rows{0, 1, 12}));
  EXPECT_FALSE(parts.can_take(Rows{0, 2, 2, 12}));
  EXPECT_FALSE(parts.can_take(Rows{0, 1, 2, 11}));
  parts.take(Rows{0, 1, 2, 12});
  EXPECT_EQ(parts.begins(), (std::vector<int>{0, 1, 2, 12}));
}

TEST(Parts, NeedARowForEachRank) {
  EXPECT_EQ(parts_of("periodic_ghosts", 12).begins().size(), 13U);
  EXPECT_EQ(error_of([] { parts_of("periodic_ghosts", 13); }, ExitCode::bad_case),
            "13 ranks cannot share a box of 12 rows of cells: take at most 12 ranks");
}

TEST(Ranks, AloneAreOne) {
  const Ranks& alone = Ranks::alone();
  EXPECT_EQ(alone.count(), 1);
  EXPECT_TRUE(alone.is_first());
  EXPECT_FALSE(alone.several());
  const std::vector<int> own{3, 1, 2};
  EXPECT_EQ(gather(alone, std::span<const int>(own)), own);
  double number = 2.5;
  alone.add(std::span(&number, 1));
  EXPECT_EQ(number, 2.5);
  EXPECT_TRUE(any(alone, true));
  EXPECT_FALSE(any(alone, false));
}

}  // namespace
