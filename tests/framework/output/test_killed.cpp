#include <sys/wait.h>

#include <csignal>
#include <cstdlib>
#include <random>

#include "output/checkpoint.hpp"
#include "output/run_folder.hpp"
#include "output_fixture.hpp"

namespace mesogen {
namespace {

using namespace output_test;

constexpr std::int64_t last = 60;
constexpr Index many = 2000;

ResultsOptions options_for(const fs::path& folder) {
  ResultsOptions options = options_in(folder);
  options.count = many;
  return options;
}

/// A run as the framework makes it: a sample each step, a frame each second, a checkpoint each fifth.
void run_to_the_end(const fs::path& folder) {
  const RunLock lock = fs::exists(folder) ? RunLock(folder) : start_run_folder(folder, "case", false);
  const std::int64_t start = has_checkpoint(folder) ? read_newest_checkpoint(folder).step : -1;
  ResultsWriter writer = ResultsWriter::resume(options_for(folder), start);
  declare(writer);
  for (std::int64_t step = start + 1; step <= last; ++step) {
    record(writer, step, step, many);
    if (step % 5 != 0) continue;
    writer.flush();
    Checkpoint checkpoint;
    checkpoint.step = step;
    checkpoint.numbers["position"].assign(std::size_t{3} * many, value_at(step, 0));
    write_checkpoint(folder, checkpoint);
  }
  writer.finish();
}

/// Runs in a process of its own; kills it after a while. True if it came to its end before.
bool run_and_kill(const fs::path& folder, unsigned microseconds) {
  const pid_t child = ::fork();
  if (child == 0) {
    try {
      run_to_the_end(folder);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
      ::_exit(1);
    }
    ::_exit(0);
  }
  int status = 0;
  ::usleep(microseconds);
  ::kill(child, SIGKILL);
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status) || WEXITSTATUS(status) == 0) << "the run failed";
  return WIFEXITED(status);
}

/// Runs killed at random moments until one comes to its end.
void expect_unbroken_bytes(int kills_wanted) {
  const TemporaryFolder parent;
  run_to_the_end(parent.path() / "unbroken");
  const std::string expected = bytes_of(parent.path() / "unbroken/results.h5");
  std::mt19937 random(11);
  int kills = 0;
  int runs = 0;
  int interrupted_packing = 0;
  while (kills < kills_wanted) {
    const fs::path folder = parent.path() / ("run" + std::to_string(runs++));
    // The later attempts are given more time, so that each run ends.
    for (unsigned attempt = 1;
         !run_and_kill(folder, static_cast<unsigned>(500 + random() % (std::size_t{30000} * attempt))); ++attempt) {
      ++kills;
      if (!fs::exists(folder)) continue;
      EXPECT_EQ(stored_case(folder), "case");
      std::size_t frames = 0;
      if (fs::exists(folder / "results.h5")) frames = expect_valid(folder, many);
      if (has_checkpoint(folder)) {
        EXPECT_GE(frames, static_cast<std::size_t>(read_newest_checkpoint(folder).step / 2 + 1))
            << "the checkpoint is newer";
      }
      if (fs::exists(folder / "results.h5.tmp")) ++interrupted_packing;
      ASSERT_FALSE(testing::Test::HasFailure()) << "after kill " << kills;
    }
    EXPECT_TRUE(bytes_of(folder / "results.h5") == expected) << "run " << runs;
    EXPECT_FALSE(fs::exists(folder / "frames"));
    EXPECT_FALSE(fs::exists(folder / "results.h5.tmp"));
  }
  std::printf("%d kills in %d runs, %d of them while results.h5 was written\n", kills, runs, interrupted_packing);
}

TEST(KilledRun, IsReadableAndContinuesToTheSameBytes) { expect_unbroken_bytes(40); }

}  // namespace
}  // namespace mesogen
