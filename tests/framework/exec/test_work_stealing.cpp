#include "mesogen/exec/work_stealing.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

namespace mesogen::exec {
namespace {

class WorkStealingOf : public testing::TestWithParam<int> {
 protected:
  void SetUp() override { omp_set_num_threads(GetParam()); }
  void TearDown() override { omp_set_num_threads(before_); }

 private:
  int before_ = omp_get_max_threads();
};

TEST_P(WorkStealingOf, GiveAllOnce) {
  for (const Index count : {0, 1, 2, 3, 7, 64, 65, 1000, 100'000}) {
    std::vector<int> times(static_cast<std::size_t>(count));
    WorkStealing stealing(count);
#pragma omp parallel
    stealing.take([&](Index i) {
#pragma omp atomic
      ++times[static_cast<std::size_t>(i)];
    });
    EXPECT_EQ(times, std::vector<int>(static_cast<std::size_t>(count), 1)) << count;
  }
}

// A team that is smaller than it was to be.
TEST_P(WorkStealingOf, LeaveNothingWhereThreadsAreMissing) {
  WorkStealing stealing(1000);
  Index done = 0;
  stealing.take([&](Index) { ++done; });
  EXPECT_EQ(done, 1000);
}

INSTANTIATE_TEST_SUITE_P(Threads, WorkStealingOf, testing::Values(1, 2, 3, 5));

/// Waits until something holds; not for ever.
template <class Condition>
void wait_for(const Condition& condition) {
  for (int ms = 0; !condition() && ms < 10000; ++ms) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

// One waits at its first piece: the other does the rest of both parts.
TEST(WorkStealing, OthersTakeWhatASlowThreadLeaves) {
  const int before = omp_get_max_threads();
  omp_set_num_threads(2);
  constexpr Index count = 1280;  // pieces of 10
  WorkStealing stealing(count);
  std::atomic<int> by_other{0};
  std::atomic<bool> begun{false};
#pragma omp parallel
  {
    const bool slow = omp_get_thread_num() == 0;
    stealing.take([&](Index) {
      if (slow) {
        if (!begun.exchange(true)) wait_for([&] { return by_other >= count - 10; });
      } else {
        wait_for([&] { return begun.load(); });
        ++by_other;
      }
    });
  }
  omp_set_num_threads(before);
  EXPECT_EQ(by_other, count - 10);
}

}  // namespace
}  // namespace mesogen::exec
