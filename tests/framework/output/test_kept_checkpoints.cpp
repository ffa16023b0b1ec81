#include "output/kept_checkpoints.hpp"

#include "output_fixture.hpp"

namespace mesogen {
namespace {

using namespace output_test;

Checkpoint at(std::int64_t step, double time) {
  Checkpoint checkpoint;
  checkpoint.step = step;
  checkpoint.time = time;
  return checkpoint;
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const KeptCheckpoint& kept : kept_checkpoints(folder)) names.push_back(kept.name);
  return names;
}

TEST(KeptCheckpoints, HaveNamesThatSortByTime) {
  const TemporaryFolder folder;
  EXPECT_TRUE(kept_checkpoints(folder.path()).empty());
  for (const auto& [step, time] : {std::pair(1500, 100.0), {20, 0.1 + 0.2}, {7, 2.5e-7}})
    keep_checkpoint(folder.path(), at(step, time));
  EXPECT_EQ(names_in(folder.path()),
            (std::vector<std::string>{"checkpoints/step0000000007_t2.5e-07.h5", "checkpoints/step0000000020_t0.3.h5",
                                      "checkpoints/step0000001500_t100.h5"}));
  for (const KeptCheckpoint& kept : kept_checkpoints(folder.path())) {
    EXPECT_EQ(read_checkpoint(folder.path() / kept.name).step, kept.step);
    EXPECT_NEAR(read_checkpoint(folder.path() / kept.name).time, kept.time, 1e-11 * kept.time);
  }
}

TEST(KeptCheckpoints, AreRemovedAfterAStepAndOtherFilesStay) {
  const TemporaryFolder folder;
  for (const std::int64_t step : {10, 20, 30})
    keep_checkpoint(folder.path(), at(step, 0.5 * static_cast<double>(step)));
  put_bytes(folder.path() / "checkpoints/notes.h5", "mine");
  put_bytes(folder.path() / "checkpoints/step0000000040_t20.h5.tmp", "half");
  remove_kept_checkpoints(folder.path(), 20);
  EXPECT_EQ(names_in(folder.path()),
            (std::vector<std::string>{"checkpoints/step0000000010_t5.h5", "checkpoints/step0000000020_t10.h5"}));
  EXPECT_FALSE(fs::exists(folder.path() / "checkpoints/step0000000040_t20.h5.tmp"));
  remove_kept_checkpoints(folder.path(), -1);
  EXPECT_TRUE(names_in(folder.path()).empty());
  EXPECT_EQ(bytes_of(folder.path() / "checkpoints/notes.h5"), "mine");
}

}  // namespace
}  // namespace mesogen
