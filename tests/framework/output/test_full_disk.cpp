#include <sys/mount.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdlib>
#include <stdexcept>

#include "output/checkpoint.hpp"
#include "output/run_folder.hpp"
#include "output_fixture.hpp"

namespace mesogen {
namespace {

using namespace output_test;

constexpr Index many = 5000;  // a frame is 160 kB

ResultsOptions options_for(const fs::path& folder) {
  ResultsOptions options = options_in(folder);
  options.count = many;
  return options;
}

/// No file may grow beyond a size, as on a full disk; the error is EFBIG instead of ENOSPC.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

/// A file system of a given size; needs the right to mount one.
class SmallDisk {
 public:
  explicit SmallDisk(const std::string& size) {
    mounted_ = ::mount("tmpfs", folder_.path().c_str(), "tmpfs", 0, ("size=" + size).c_str()) == 0;
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  ~SmallDisk() {
    if (mounted_) ::umount(folder_.path().c_str());
  }
  [[nodiscard]] bool is_mounted() const { return mounted_; }
  [[nodiscard]] const fs::path& path() const { return folder_.path(); }
  void make_read_only() const {
    ASSERT_EQ(::mount(nullptr, folder_.path().c_str(), nullptr, MS_REMOUNT | MS_RDONLY, nullptr), 0);
  }

 private:
  TemporaryFolder folder_;
  bool mounted_ = false;
};

constexpr const char* make_room =
    "; what was written before is safe: make room, then `mesogen resume` continues the run";

TEST(FullDisk, LeavesEarlierFrames) {
  const TemporaryFolder folder;
  ResultsWriter writer = ResultsWriter::create(options_for(folder.path()));
  declare(writer);
  advance(writer, 0, 4, many);
  const std::string why = error_of(
      [&] {
        const FileSizeLimit limit(100000);
        advance(writer, 5, 6, many);
      },
      ExitCode::run_failed);
  EXPECT_EQ(why, "cannot write " + (folder.path() / "frames/000003.h5").string() + ": File too large" + make_room);
  EXPECT_EQ(expect_valid(folder.path(), many), 3U);
  EXPECT_FALSE(fs::exists(folder.path() / "frames/000003.h5.tmp"));
  advance(writer, 6, 8, many);
  EXPECT_EQ(expect_valid(folder.path(), many), 5U) << "it goes on when there is room";
}

TEST(FullDisk, StopsAtEachSizeOfEachFile) {
  const TemporaryFolder folder;
  ResultsWriter writer = ResultsWriter::create(options_for(folder.path()));
  declare(writer);
  advance(writer, 0, 2, many);
  for (rlim_t size = 0; size < 260000; size += 20000) {
    const FileSizeLimit limit(size);
    try {
      ResultsWriter again = ResultsWriter::resume(options_for(folder.path()), 2);
      declare(again);
      advance(again, 3, 4, many);
      again.finish();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::run_failed);
    }
    EXPECT_GE(expect_valid(folder.path(), many), 2U) << size;
  }
}

TEST(FullDisk, LeavesTheFramesIfPackingFails) {
  const TemporaryFolder folder;
  ResultsWriter writer = ResultsWriter::create(options_for(folder.path()));
  declare(writer);
  advance(writer, 0, 6, many);
  for (const rlim_t size : {0, 1000, 100000, 400000, 600000}) {
    const std::string why = error_of(
        [&] {
          const FileSizeLimit limit(size);
          writer.finish();
        },
        ExitCode::run_failed);
    EXPECT_EQ(why, "cannot write " + (folder.path() / "results.h5").string() + ": File too large" + make_room) << size;
    EXPECT_EQ(expect_valid(folder.path(), many), 4U);
    EXPECT_FALSE(fs::exists(folder.path() / "results.h5.tmp"));
  }
  writer.finish();
  EXPECT_EQ(expect_valid(folder.path(), many), 4U);
}

TEST(FullDisk, LeavesTheOlderCheckpoints) {
  const TemporaryFolder folder;
  Checkpoint checkpoint;
  checkpoint.numbers["position"].resize(20000);
  write_checkpoint(folder.path(), checkpoint);
  checkpoint.step = 1;
  write_checkpoint(folder.path(), checkpoint);
  checkpoint.step = 2;
  const std::string why = error_of(
      [&] {
        const FileSizeLimit limit(100000);
        write_checkpoint(folder.path(), checkpoint);
      },
      ExitCode::run_failed);
  EXPECT_EQ(why, "cannot write " + (folder.path() / "checkpoint_a.h5").string() + ": File too large" + make_room);
  EXPECT_EQ(read_newest_checkpoint(folder.path()).step, 1);
  EXPECT_EQ(read_checkpoint(folder.path() / "checkpoint_a.h5").step, 0);
}

TEST(FullDisk, OfRealKind) {
  for (int kilobytes = 400; kilobytes <= 1400; kilobytes += 100) {
    const SmallDisk disk(std::to_string(kilobytes) + "k");
    if (!disk.is_mounted())
      GTEST_SKIP() << "only root may mount a small file system to fill, and not in every container";
    std::size_t written = 0;
    const std::string why = error_of(
        [&] {
          ResultsWriter writer = ResultsWriter::create(options_for(disk.path()));
          declare(writer);
          for (std::int64_t step = 0; step <= 6; ++step) {
            advance(writer, step, step, many);
            written = static_cast<std::size_t>(writer.frame_count());
          }
          writer.finish();
        },
        ExitCode::run_failed);
    EXPECT_NE(why.find("o space left on device"), std::string::npos) << why;
    EXPECT_EQ(expect_valid(disk.path(), many), written) << kilobytes << " kB: " << why;
  }
}

TEST(ReadOnlyDisk, IsNamedAndItsFramesAreReadable) {
  const SmallDisk disk("4m");
  if (!disk.is_mounted()) GTEST_SKIP() << "only root may mount a small file system to fill, and not in every container";
  ResultsWriter writer = ResultsWriter::create(options_for(disk.path()));
  declare(writer);
  advance(writer, 0, 4, many);
  disk.make_read_only();
  const std::string why = ": Read-only file system; check its permissions, or choose another folder with --output";
  EXPECT_EQ(error_of([&] { advance(writer, 5, 6, many); }, ExitCode::run_failed),
            "cannot write " + (disk.path() / "frames/000003.h5").string() + why);
  EXPECT_EQ(error_of([&] { write_checkpoint(disk.path(), Checkpoint{}); }, ExitCode::run_failed),
            "cannot write " + (disk.path() / "checkpoint_a.h5").string() + why);
  EXPECT_EQ(expect_valid(disk.path(), many), 3U);
}

TEST(LostFolder, IsNamed) {
  const TemporaryFolder parent;
  const fs::path folder = parent.path() / "run";
  const RunLock lock = start_run_folder(folder, "case", false);
  ResultsWriter writer = ResultsWriter::create(options_in(folder));
  declare(writer);
  advance(writer, 0, 2);
  fs::remove_all(folder);
  EXPECT_EQ(error_of([&] { advance(writer, 3, 4); }, ExitCode::run_failed),
            "cannot write " + (folder / "frames/000002.h5").string() +
                ": No such file or directory; has its folder been removed or renamed?");
  EXPECT_EQ(error_of([&] { write_checkpoint(folder, Checkpoint{}); }, ExitCode::run_failed),
            "cannot write " + (folder / "checkpoint_a.h5").string() +
                ": No such file or directory; has its folder been removed or renamed?");
}

/// Root may write anywhere, so root is somebody else for a while.
class SomebodyElse {
 public:
  SomebodyElse() : before_(::geteuid()) {
    if (before_ == 0 && ::seteuid(65534) != 0) throw std::runtime_error("cannot become nobody");
  }
  SomebodyElse(const SomebodyElse&) = delete;
  SomebodyElse& operator=(const SomebodyElse&) = delete;
  ~SomebodyElse() {
    if (before_ == 0 && ::seteuid(0) != 0) std::abort();
  }

 private:
  uid_t before_;
};

TEST(ForbiddenFolder, IsNamed) {
  const TemporaryFolder parent;
  const fs::path run = parent.path() / "run";
  const std::string why = ": Permission denied; check its permissions, or choose another folder with --output";
  ResultsWriter writer = ResultsWriter::create(options_in(parent.path()));
  fs::permissions(parent.path() / "frames", fs::perms(0555));
  fs::permissions(parent.path(), fs::perms(0555));
  {
    const SomebodyElse somebody;
    EXPECT_EQ(error_of([&] { (void)start_run_folder(run, "case", false); }, ExitCode::bad_case),
              "cannot make the folder " + run.string() + why);
    EXPECT_EQ(error_of([&] { const RunLock lock(parent.path()); }, ExitCode::bad_case),
              "cannot lock the folder by " + (parent.path() / "mesogen.lock").string() + why);
    EXPECT_EQ(error_of(
                  [&] {
                    writer.add_frame(frame_at(0), 0, 0.0);
                    writer.flush();
                  },
                  ExitCode::run_failed),
              "cannot write " + (parent.path() / "frames/000000.h5").string() + why);
  }
  fs::permissions(parent.path() / "frames", fs::perms::owner_all);
  fs::permissions(parent.path(), fs::perms::owner_all);
}

}  // namespace
}  // namespace mesogen
