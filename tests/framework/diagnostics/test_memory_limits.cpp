#include "diagnostics/memory_limits.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "diagnostics/resources.hpp"

namespace mesogen {
namespace {

namespace fs = std::filesystem;

/// A folder with the files that the kernel shows of control groups.
class Groups : public ::testing::Test {
 protected:
  Groups() : root_(fs::temp_directory_path() / ("mesogen-groups-" + std::to_string(::getpid()))) {}
  ~Groups() override { fs::remove_all(root_); }
  Groups(const Groups&) = delete;
  Groups& operator=(const Groups&) = delete;

  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((root_ / name).parent_path());
    std::ofstream(root_ / name) << text;
  }
  [[nodiscard]] std::optional<double> left() const { return memory_left_in_groups(root_); }

 private:
  fs::path root_;
};

TEST_F(Groups, TheLeastOfAGroupAndThoseAroundIt) {
  write("proc/self/cgroup", "0::/slice/job\n");
  write("sys/fs/cgroup/slice/job/memory.max", "max\n");
  write("sys/fs/cgroup/slice/job/memory.current", "300\n");
  EXPECT_FALSE(left());
  write("sys/fs/cgroup/slice/memory.max", "1000\n");
  write("sys/fs/cgroup/slice/memory.current", "400\n");
  EXPECT_EQ(left(), 600.0);
  write("sys/fs/cgroup/slice/memory.stat", "anon 250\nfile 150\ninactive_file 100\n");
  EXPECT_EQ(left(), 700.0);
  write("sys/fs/cgroup/slice/job/memory.max", "500\n");
  EXPECT_EQ(left(), 200.0);
  write("sys/fs/cgroup/slice/job/memory.current", "600\n");
  EXPECT_EQ(left(), 0.0);
}

TEST_F(Groups, OfAContainerThatSeesItsOwnAlone) {
  write("proc/self/cgroup", "0::/../outside\n");
  write("sys/fs/cgroup/memory.max", "1000\n");
  write("sys/fs/cgroup/memory.current", "100\n");
  EXPECT_EQ(left(), 900.0);
}

TEST_F(Groups, OfVersionOne) {
  write("proc/self/cgroup", "5:cpu:/other\n4:cpuset,memory:/job\n0::/\n");
  write("sys/fs/cgroup/memory/job/memory.limit_in_bytes", "2000\n");
  write("sys/fs/cgroup/memory/job/memory.usage_in_bytes", "1500\n");
  write("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
  write("sys/fs/cgroup/memory/memory.usage_in_bytes", "1700\n");
  EXPECT_EQ(left(), 500.0);
}

TEST_F(Groups, NoneWhereTheSystemHasNone) { EXPECT_FALSE(left()); }

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define MESOGEN_TEST_LARGE_ADDRESS_SPACE
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define MESOGEN_TEST_LARGE_ADDRESS_SPACE
#endif
#endif

TEST(AvailableMemory, HeedsALimitOnTheAddressSpace) {
#ifdef MESOGEN_TEST_LARGE_ADDRESS_SPACE
  GTEST_SKIP() << "sanitizers take an address space beyond all limits";
#endif
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_AS, &before), 0);
  EXPECT_GT(available_memory(), std::int64_t{1} << 20);
  const rlimit small{std::min<rlim_t>(before.rlim_max, rlim_t{4} << 30), before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_AS, &small), 0);
  EXPECT_LT(available_memory(), std::int64_t{4} << 30);
  setrlimit(RLIMIT_AS, &before);
}

}  // namespace
}  // namespace mesogen
