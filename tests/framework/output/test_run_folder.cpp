#include "output/run_folder.hpp"

#include <sys/wait.h>

#include <csignal>
#include <optional>

#include "output/checkpoint.hpp"
#include "output_fixture.hpp"

namespace mesogen {
namespace {

using namespace output_test;

std::string refusal_of(const fs::path& folder, bool overwrite = false) {
  return error_of([&] { (void)start_run_folder(folder, "new", overwrite); }, ExitCode::bad_case);
}

void fill_with_a_run(const fs::path& folder) {
  const RunLock lock = start_run_folder(folder, "old", false);
  ResultsWriter writer = ResultsWriter::create(options_in(folder));
  declare(writer);
  advance(writer, 0, 4);
  write_checkpoint(folder, Checkpoint{});
  write_checkpoint(folder, Checkpoint{});
  put_bytes(folder / "run.log", "log");
}

TEST(RunFolder, IsMadeWithItsCase) {
  const TemporaryFolder parent;
  for (const char* name : {"run", "a/b/run", "slash/", "dot/."}) {
    const fs::path folder = parent.path() / name;
    EXPECT_FALSE(holds_run(folder));
    const RunLock lock = start_run_folder(folder, "title = \"a\"\n", false);
    EXPECT_EQ(stored_case(folder), "title = \"a\"\n");
    EXPECT_TRUE(holds_run(folder));
  }
  for (const auto& entry : fs::recursive_directory_iterator(parent.path()))
    EXPECT_EQ(entry.path().string().find(".starting"), std::string::npos) << entry.path();
}

TEST(RunFolder, MayBeThereAlreadyIfItIsEmpty) {
  const TemporaryFolder parent;
  fs::create_directory(parent.path() / "empty");
  EXPECT_EQ(stored_case(
                (static_cast<void>(start_run_folder(parent.path() / "empty", "case", false)), parent.path() / "empty")),
            "case");
}

TEST(RunFolder, IsRefusedIfItHoldsFilesButNoRun) {
  const TemporaryFolder parent;
  const fs::path folder = parent.path() / "used";
  fs::create_directories(folder / "bin");
  const std::string why = " is not empty and holds no run: choose another --output, such as a new folder in it";
  for (const bool overwrite : {false, true}) EXPECT_EQ(refusal_of(folder, overwrite), folder.string() + why);
  EXPECT_EQ(refusal_of("/"), "/" + why);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
  (void)start_run_folder(folder / "new", "case", false);
  EXPECT_EQ(stored_case(folder / "new"), "case");
}

TEST(RunFolder, OfARunKilledBetweenItsLockAndItsCaseIsTaken) {
  const TemporaryFolder folder;
  { const RunLock lock(folder.path()); }
  (void)start_run_folder(folder.path(), "case", false);
  EXPECT_EQ(stored_case(folder.path()), "case");
}

TEST(RunFolder, IsRefusedIfItHoldsACaseThatNoRunStored) {
  const TemporaryFolder folder;
  put_bytes(folder.path() / "case.toml", "mine");
  for (const bool overwrite : {false, true})
    EXPECT_EQ(refusal_of(folder.path(), overwrite),
              (folder.path() / "case.toml").string() +
                  " was not stored by a run, and a run keeps its own case.toml there: choose another --output, or move "
                  "it away");
  EXPECT_EQ(stored_case(folder.path()), "mine");
  EXPECT_FALSE(fs::exists(folder.path() / "mesogen.lock"));
}

TEST(RunFolder, OfARunKilledAtItsStartIsOverwritten) {
  const TemporaryFolder parent;
  (void)start_run_folder(parent.path() / "run", "old", false);
  (void)start_run_folder(parent.path() / "run", "new", true);
  EXPECT_EQ(stored_case(parent.path() / "run"), "new");
}

TEST(RunFolder, StartsAfterAStartThatWasKilled) {
  const TemporaryFolder parent;
  fs::create_directory(parent.path() / ".run.starting");
  put_bytes(parent.path() / ".run.starting/case.toml.tmp", "half");
  (void)start_run_folder(parent.path() / "run", "case", false);
  EXPECT_EQ(stored_case(parent.path() / "run"), "case");
  EXPECT_FALSE(fs::exists(parent.path() / ".run.starting"));
}

TEST(RunFolder, IsRefusedIfItHoldsARun) {
  const TemporaryFolder parent;
  const fs::path folder = parent.path() / "run";
  fill_with_a_run(folder);
  EXPECT_EQ(refusal_of(folder), folder.string() +
                                    " already holds a run: continue it with `mesogen resume`, replace it with "
                                    "--overwrite, or choose another --output");
  EXPECT_EQ(stored_case(folder), "old");
  EXPECT_EQ(expect_valid(folder), 3U);
}

TEST(RunFolder, OverwritesOnlyWhatARunWrites) {
  const TemporaryFolder parent;
  const fs::path folder = parent.path() / "run";
  fill_with_a_run(folder);
  fs::create_directory(folder / "figures");
  for (const char* name : {"notes.txt", "results.h5.bak", "frames/picture.h5", "frames/12.h5", "figures/results.h5"})
    put_bytes(folder / name, "mine");
  (void)start_run_folder(folder, "new", true);
  EXPECT_EQ(stored_case(folder), "new");
  for (const char* name : {"results.h5", "results.xdmf", "checkpoint_a.h5", "checkpoint_b.h5", "run.log",
                           "frames/000000.h5", "frames/000002.h5"})
    EXPECT_FALSE(fs::exists(folder / name)) << name;
  for (const char* name : {"notes.txt", "results.h5.bak", "frames/picture.h5", "frames/12.h5", "figures/results.h5"})
    EXPECT_EQ(bytes_of(folder / name), "mine") << name;
}

TEST(RunFolder, IsRefusedIfItIsAFileOrHasNone) {
  const TemporaryFolder parent;
  put_bytes(parent.path() / "file", "x");
  EXPECT_EQ(refusal_of(parent.path() / "file"),
            (parent.path() / "file").string() + " is a file: choose another --output");
  EXPECT_EQ(refusal_of(parent.path() / "file/run", true).rfind("cannot make the folder", 0), 0U);
  EXPECT_EQ(error_of([&] { (void)stored_case(parent.path()); }, ExitCode::bad_case),
            parent.path().string() + " holds no run: it has no case.toml");
}

TEST(RunFolder, TakesOneRunAtATime) {
  const TemporaryFolder parent;
  const fs::path folder = parent.path() / "run";
  std::optional<RunLock> first = start_run_folder(folder, "case", false);
  const std::string in_use =
      "another run is writing into " + folder.string() + ": wait until it ends, or choose another folder with --output";
  EXPECT_EQ(refusal_of(folder, true), in_use);
  EXPECT_EQ(error_of([&] { const RunLock second(folder); }, ExitCode::bad_case), in_use);
  RunLock moved = std::move(*first);
  first.reset();
  EXPECT_EQ(error_of([&] { const RunLock second(folder); }, ExitCode::bad_case), in_use);
  { const RunLock gone = std::move(moved); }
  const RunLock again(folder);
}

TEST(RunFolder, IsFreeAgainWhenItsRunIsKilled) {
  const TemporaryFolder folder;
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const RunLock lock(folder.path());
    (void)!::write(ready[1], "x", 1);
    ::pause();
    ::_exit(0);
  }
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  EXPECT_THROW(RunLock{folder.path()}, Error);
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_NO_THROW(RunLock{folder.path()});
  ::close(ready[0]);
  ::close(ready[1]);
}

}  // namespace
}  // namespace mesogen
