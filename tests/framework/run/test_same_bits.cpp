// The same bits from any number of threads, and from a run that was saved and restored.

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>

#include "active_scene.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

class SameBits : public testing::TestWithParam<std::tuple<const char*, const char*, const char*>> {
 protected:
  [[nodiscard]] static CaseText scene() {
    const auto [precision, boundary, stepping] = GetParam();
    return active_scene(precision, boundary, stepping);
  }
};

TEST_P(SameBits, FromOneThreadAndTwo) {
  const int threads = omp_get_max_threads();
  const auto run_with = [&](int count) {
    omp_set_num_threads(count);
    CaseRun run(scene());
    run.run_steps(60);
    omp_set_num_threads(threads);
    EXPECT_GT(run.state().neighbourhood.sortings(), 3);
    return state_of(run);
  };
  const auto one = run_with(1);
  EXPECT_EQ(one, run_with(2));
  EXPECT_EQ(one, run_with(3));
}

TEST_P(SameBits, FromASavedAndRestoredRun) {
  CaseRun unbroken(scene());
  unbroken.run_steps(20);
  Checkpoint checkpoint;
  unbroken.stepper().save(checkpoint);
  const auto half_way = state_of(unbroken);
  unbroken.run_steps(20);

  CaseRun resumed = CaseRun::unstarted(scene());
  resumed.stepper().restore(checkpoint);
  EXPECT_EQ(state_of(resumed), half_way);
  EXPECT_EQ(resumed.time(), checkpoint.time);
  resumed.run_steps(20);
  EXPECT_EQ(resumed.state().step, 40);
  EXPECT_EQ(resumed.time(), unbroken.time());
  EXPECT_EQ(state_of(resumed), state_of(unbroken));
}

INSTANTIATE_TEST_SUITE_P(All, SameBits,
                         testing::Combine(testing::Values("single", "double"),
                                          testing::Values("periodic_ghosts", "periodic_wrap", "walls"),
                                          testing::Values("explicit", "stabilised")),
                         [](const auto& set) {
                           return std::string(std::get<0>(set.param)) + "_" + std::get<1>(set.param) + "_" +
                                  std::get<2>(set.param);
                         });

TEST(Restore, RefusesTheCheckpointOfAnotherCase) {
  CaseRun run(active_scene("double"));
  Checkpoint checkpoint;
  run.stepper().save(checkpoint);
  checkpoint.numbers.erase("field order_tensor 1");
  CaseRun other = CaseRun::unstarted(active_scene("double"));
  try {
    other.stepper().restore(checkpoint);
    FAIL() << "restored";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_case);
    EXPECT_STREQ(error.what(),
                 "the checkpoint has no 'field order_tensor 1' for 400 particles: it belongs to another case");
  }
}

TEST(Restore, RefusesParticlesThatAreNotThose) {
  CaseRun run(active_scene("double"));
  for (const std::int64_t wrong : {-1, 17, 400}) {
    Checkpoint checkpoint;
    run.stepper().save(checkpoint);
    auto& id = checkpoint.integers.at("id");
    *std::find(id.begin(), id.end(), 18) = wrong;
    CaseRun other = CaseRun::unstarted(active_scene("double"));
    try {
      other.stepper().restore(checkpoint);
      FAIL() << "restored " << wrong;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_case);
      EXPECT_EQ(error.what(), "the checkpoint names particle " + std::to_string(wrong) +
                                  " twice, or it is none of this case: it belongs to another one");
    }
  }
}

}  // namespace
