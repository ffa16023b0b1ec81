// Loops by which a step changes fields and moves particles, as the host runs them, and how a device numbers its
// threads.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "mesogen/exec/for_each.hpp"
#include "particles/field_loops.hpp"

namespace {

using namespace mesogen;

double found(exec::Reduction reduction) {
  Backend::host().wait();
  return Backend::host().found(reduction);
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// As a device counts them: at 1e8 particles, and at the most that an Index can count.
TEST(Loops, EveryThreadHasANumberAndEveryNumberAThread) {
  using Blocks = exec::ThreadBlocks<128>;
  for (const Index count : {1, 127, 128, 129, 100'000'000, std::numeric_limits<Index>::max()}) {
    const unsigned blocks = Blocks::number(count);
    const auto all = static_cast<unsigned>(count);
    EXPECT_LE(blocks, 2'147'483'647U) << "what a device can start";
    EXPECT_GE(Blocks::thread(blocks - 1, Blocks::size - 1), all - 1) << count;
    EXPECT_LT(Blocks::thread(blocks - 1, 0), all) << count << ": no block is in vain";
    EXPECT_EQ(Blocks::thread(blocks - 1, 0), Blocks::thread(blocks - 1, Blocks::size - 1) - (Blocks::size - 1))
        << count << ": numbers do not begin anew";
  }
}

TEST(Loops, AdvanceInDoubleAndRoundForPasses) {
  const std::vector<double> from{1.0, 2.0, 3.0, 4.0};  // two components of two particles
  const std::vector<float> rate{0.5F, -1.0F, 0.25F, 2.0F};
  std::vector<double> exact(4);
  std::vector<float> rounded(4);
  const auto largest = Backend::host().fields<float>().advance_and_look(
      {{from.data(), 2}, {rate.data(), 2}, 0.1, {exact.data(), 2}, {rounded.data(), 2}, 2}, 2);
  for (std::size_t n = 0; n < 4; ++n) {
    EXPECT_DOUBLE_EQ(exact[n], from[n] + 0.1 * static_cast<double>(rate[n]));
    EXPECT_EQ(rounded[n], static_cast<float>(exact[n]));
  }
  EXPECT_DOUBLE_EQ(found(largest), exact[1] * exact[1] + exact[3] * exact[3]);
  EXPECT_DOUBLE_EQ(found(largest.next()), 5.0);
}

TEST(Loops, MoveTellsHowFarParticlesAreFromWhereTheyWereSorted) {
  std::vector<double> x{1.0, 2.0};
  const std::vector<double> velocity{0.5, -0.5};
  const std::vector<double> shift{0.0, 8.0};
  exec::MoveArguments<double> moving{};
  moving.position[0] = x.data();
  moving.velocity = {velocity.data(), 2};
  moving.by = 2.0;
  moving.shift = {shift.data(), 2};
  moving.shift_by = 0.25;
  moving.dimension = 1;
  const exec::FieldLoops<double>& loops = Backend::host().fields<double>();
  EXPECT_EQ(found(loops.move_and_look(moving, 2)), 0.0) << "nobody said where they were sorted";
  EXPECT_EQ(x, (std::vector<double>{2.0, 3.0}));
  const std::vector<double> sorted{1.0, 5.0};
  moving.sorted[0] = sorted.data();
  EXPECT_EQ(found(loops.move_and_look(moving, 2)), 4.0) << "from 1 to 3, and from 5 to 4";
  moving.by = nan;
  EXPECT_EQ(found(loops.move_and_look(moving, 2)), HUGE_VAL) << "nowhere";
}

TEST(Loops, ParticlesMoveInTheSameWayWhetherOrNotSomebodyLooks) {
  const std::vector<double> velocity{0.1, -0.3, 0.7};
  exec::MoveArguments<double> moving{};
  moving.velocity = {velocity.data(), 3};
  moving.by = 0.3;
  moving.dimension = 1;
  std::vector<double> unseen{1.0, 2.0, 3.0};
  std::vector<double> seen = unseen;
  moving.position[0] = unseen.data();
  Backend::host().fields<double>().move(moving, 3);
  moving.position[0] = seen.data();
  (void)found(Backend::host().fields<double>().move_and_look(moving, 3));
  EXPECT_EQ(unseen, seen);
}

TEST(Loops, PartialSumsAddUpToTheSum) {
  const exec::FieldLoops<double>& loops = Backend::host().fields<double>();
  std::vector<double> values(3 * static_cast<std::size_t>(loops.parts) + 7);
  std::iota(values.begin(), values.end(), 1.0);
  std::vector<double> sums(static_cast<std::size_t>(loops.parts), nan);
  loops.partial_sums(values.data(), static_cast<Index>(values.size()), sums.data());
  const auto count = static_cast<double>(values.size());
  EXPECT_EQ(std::accumulate(sums.begin(), sums.end(), 0.0), count * (count + 1.0) / 2.0);
}

}  // namespace
