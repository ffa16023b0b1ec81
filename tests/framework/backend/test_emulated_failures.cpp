// What stops a run on a device whose memory is apart, played by the host: a copy that somebody forgets, and too little
// memory.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "../run/active_scene.hpp"
#include "emulated_device.hpp"
#include "test_plugins.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

/// Forgets to copy one way. To the host it still copies what is smaller than the doubles of all particles: a loop that
/// goes by a list of indices that was never written would read anywhere.
class ForgetfulMemory final : public exec::EmulatedMemory {
 public:
  explicit ForgetfulMemory(exec::Side forgets) : forgets_(forgets) {}
  void to_device(void* device, const void* host, std::size_t bytes) override {
    if (forgets_ != exec::Side::device) EmulatedMemory::to_device(device, host, bytes);
  }
  void to_host(void* host, const void* device, std::size_t bytes) override {
    if (forgets_ != exec::Side::host || bytes < smallest) EmulatedMemory::to_host(host, device, bytes);
  }

 private:
  static constexpr std::size_t smallest = 400 * sizeof(double);
  exec::Side forgets_;
};

/// What stops a short run whose flow computes on the host and the rest on the device; empty if nothing does.
std::string stopped_by(exec::EmulatedMemory& memory) {
  const EmulatedDevice device(memory);
  try {
    const auto setup = put_together(active_scene("double"), built_plugins(),
                                    device.additions([](const std::string& type) { return type != "wcsph"; }));
    Stepper stepper(*setup);
    stepper.start();
    for (int n = 0; n < 3; ++n) stepper.advance(stepper.next_step(1e6), {false});
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(EmulatedDevice, AForgottenCopyStopsTheRun) {
  exec::EmulatedMemory faithful;
  EXPECT_EQ(stopped_by(faithful), "");
  ForgetfulMemory nothing_to_the_host(exec::Side::host);
  EXPECT_NE(stopped_by(nothing_to_the_host).find("is not finite"), std::string::npos);
  ForgetfulMemory nothing_to_the_device(exec::Side::device);
  EXPECT_NE(stopped_by(nothing_to_the_device), "");
}

// A plugin that keeps a pointer instead of asking for the field at each pass: right on the host, by luck.
TEST(EmulatedDevice, APluginThatKeepsAPointerIsStopped) {
  const PluginRegistry registry = PluginRegistry::only(
      {MESOGEN_TEST_PLUGIN_FOLDER, std::filesystem::path(MESOGEN_TEST_BROKEN_PLUGINS) / "misbehaving"});
  const CaseText text =
      active_scene("double").section("physics.bad", "type = \"misbehaving\"\nmisdeed = \"keeps a pointer\"");
  const auto stopped = [&](const SetupAdditions& additions) -> std::string {
    const auto setup = put_together(text, registry, additions);
    Stepper stepper(*setup);
    try {
      stepper.start();
      for (int n = 0; n < 3; ++n) stepper.advance(stepper.next_step(1e6), {false});
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_EQ(stopped({}), "");
  exec::EmulatedMemory memory;
  const EmulatedDevice device(memory);
  const std::string text_of_error =
      stopped(device.additions([](const std::string& type) { return type != "misbehaving"; }));
  EXPECT_NE(text_of_error.find("is not finite"), std::string::npos) << text_of_error;
}

TEST(EmulatedDevice, ARunThatDoesNotFitIsRefused) {
  exec::EmulatedMemory memory(100'000);
  const std::string text = stopped_by(memory);
  EXPECT_TRUE(text.starts_with("the emulated device has too little memory: an array needs ")) << text;
  EXPECT_NE(text.find("and of its 0.1 MB only "), std::string::npos) << text;
  EXPECT_NE(text.find("Take fewer particles (a larger particles.spacing), run.precision = \"single\", or run.device = "
                      "\"cpu\""),
            std::string::npos)
      << text;
  EXPECT_EQ(memory.held(), 0U);
}

}  // namespace
