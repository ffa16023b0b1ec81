// What is told of a crash; the command's tests crash plugins.

#include "plugin/crash.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <thread>

#include "plugin/plugin_call.hpp"

namespace mesogen {
namespace {

void crash_in_a_thread(bool by_itself) {
  tell_of_crashes(2);
  const PluginCall call{.plugin = "wcsph", .call = "pass", .subject = "momentum"};
  const CallUnderWay under_way(call);
  std::thread([by_itself] {
    if (by_itself) tell_of_crashes_in_this_thread();
    std::raise(SIGILL);
  }).join();
}

// One that works for the main thread crashes in its call, one beside it does not.
TEST(CrashDeathTest, OfAThreadByItselfHasNothingToDoWithTheCallOfTheMainThread) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_DEATH(crash_in_a_thread(false), "error: .*wcsph.*momentum.* crashed: it ran an instruction");
  EXPECT_DEATH(crash_in_a_thread(true), "error: outside of any plugin, Mesogen.* crashed: it ran an instruction");
}

}  // namespace
}  // namespace mesogen
