// A frame that cannot be written, though the run went on while it was: the run ends soon, and goes on from before it.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <sstream>
#include <string>
#include <thread>

#include "case/case.hpp"
#include "case_run.hpp"
#include "error_of.hpp"
#include "output/kept_checkpoints.hpp"
#include "run/run.hpp"
#include "test_plugins.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

constexpr int steps_between_frames = 100;

struct Broken {
  std::string error;
  int steps = 0;  ///< of the run
  std::size_t kept_checkpoints = 0;
};

/// A run that loses the folder of its frames after 10 steps.
Broken run_without_folder_of_frames(const std::string& output) {
  const auto folder = std::filesystem::temp_directory_path() / fmt::format("mesogen-lost-frame-{}", ::getpid());
  std::filesystem::remove_all(folder);
  CaseText text(4.0, 8);
  text.modes("velocity", "[[0, 1, 0.1, 0.0]]")
      .flow(0.05)
      .section("time", "end = 4.0\nstep = 0.01")
      .section("output", "interval = 1.0\n" + output);
  Problems problems;
  Case source = read_case_text(text.text(), "test.toml", {}, problems);
  Broken broken;
  // Asked for after each step, which a slow machine could not make shorter.
  const auto clock = [&] {
    if (++broken.steps == 10) std::filesystem::remove_all(folder / "frames");
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    return 0.0;
  };
  Log log(true);
  std::ostringstream told;
  Progress progress(told, Progress::Style::plain, clock);
  RunOptions options;
  options.folder = folder;
  broken.error = error_of([&] { (void)run_case(std::move(source), built_plugins(), options, log, progress); },
                          ExitCode::run_failed);
  broken.kept_checkpoints = kept_checkpoints(folder).size();
  std::filesystem::remove_all(folder);
  return broken;
}

TEST(LostFrame, EndsTheRunLongBeforeTheNextFrame) {
  const Broken broken = run_without_folder_of_frames("");
  EXPECT_NE(broken.error.find("frames/000001.h5"), std::string::npos) << broken.error;
  EXPECT_GE(broken.steps, steps_between_frames);
  EXPECT_LT(broken.steps, 2 * steps_between_frames - 20);
}

TEST(LostFrame, IsMissedByNoCheckpointThatIsKept) {
  const Broken broken = run_without_folder_of_frames("checkpoint_times = [1.0]");
  EXPECT_NE(broken.error.find("frames/000001.h5"), std::string::npos) << broken.error;
  EXPECT_EQ(broken.kept_checkpoints, 0U);
}

}  // namespace
