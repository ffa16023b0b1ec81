// Frames that are written while the run goes on.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <stdexcept>
#include <thread>
#include <utility>

#include "output_fixture.hpp"

namespace mesogen {
namespace {

using namespace output_test;

/// A frame whose values come when `begin` has been called.
TakenFrame frame_behind(std::int64_t step, std::function<void()> begin) {
  TakenFrame frame{frame_at(step), {}};
  for (FrameField& field : frame.fields) field.values.clear();
  frame.fill = [step, begin = std::move(begin)](std::vector<FrameField>& fields) {
    begin();
    fields = frame_at(step);
  };
  return frame;
}

/// Keeps whoever passes until it is opened. Nobody waits for ever: a test is to fail, not to hang.
class Gate {
 public:
  void open() { opened_.set_value(); }
  void pass() {
    if (open_.wait_for(std::chrono::seconds(30)) != std::future_status::ready)
      throw std::runtime_error("the gate stayed closed");
  }

 private:
  std::promise<void> opened_;
  std::shared_future<void> open_ = opened_.get_future().share();
};

TEST(FramesBesideTheRun, AreCompleteAndInOrderHoweverSlowTheyAreWritten) {
  const TemporaryFolder folder;
  ResultsWriter writer = ResultsWriter::create(options_in(folder.path()));
  declare(writer);
  for (std::int64_t step = 0; step < 12; ++step) {
    add_samples(writer, step);
    if (step % 2 == 0)
      writer.add_frame(frame_behind(step, [] { std::this_thread::sleep_for(std::chrono::milliseconds(5)); }), step,
                       time_at(step));
  }
  EXPECT_EQ(writer.frame_count(), 6);
  writer.flush();
  EXPECT_EQ(expect_valid(folder.path()), 6U);
  writer.finish();
  EXPECT_EQ(expect_valid(folder.path()), 6U);
}

TEST(FramesBesideTheRun, HoldWhatWasAdded) {
  const TemporaryFolder folder;
  ResultsWriter writer = ResultsWriter::create(options_in(folder.path()));
  declare(writer);
  add_samples(writer, 0);
  std::vector<FrameField> fields = frame_at(0);
  writer.add_frame(fields, 0, time_at(0));
  for (FrameField& field : fields) field.values.assign(field.values.size(), -1.0);
  writer.flush();
  EXPECT_EQ(expect_valid(folder.path()), 1U);
}

TEST(FramesBesideTheRun, LetTheRunGoOn) {
  const TemporaryFolder folder;
  const auto gate = std::make_shared<Gate>();
  ResultsWriter first = ResultsWriter::create(options_in(folder.path()));
  declare(first);
  add_samples(first, 0);
  first.add_frame(frame_behind(0, [gate] { gate->pass(); }), 0, time_at(0));
  // All this while the frame waits for its values.
  ResultsWriter writer = std::move(first);
  EXPECT_EQ(writer.last_frame_step(), 0);
  EXPECT_EQ(writer.frame_count(), 1);
  add_samples(writer, 1);
  writer.check();
  gate->open();
  writer.wait();
  const auto samples = [&] {
    return Reader(folder.path() / "results.h5").array("observables/flow/v_rms/value").values.size();
  };
  EXPECT_EQ(expect_valid(folder.path()), 1U);
  EXPECT_EQ(samples(), 1U) << "those until the frame";
  writer.flush();
  EXPECT_EQ(samples(), 2U);
}

TEST(FramesBesideTheRun, AreWrittenOneAtATime) {
  const TemporaryFolder folder;
  std::atomic<int> at_work = 0;
  std::atomic<int> most = 0;
  ResultsWriter writer = ResultsWriter::create(options_in(folder.path()));
  for (std::int64_t step = 0; step < 5; ++step)
    writer.add_frame(frame_behind(step,
                                  [&] {
                                    most = std::max<int>(most, ++at_work);
                                    std::this_thread::sleep_for(std::chrono::milliseconds(2));
                                    --at_work;
                                  }),
                     step, time_at(step));
  writer.flush();
  EXPECT_EQ(most, 1);
}

TEST(FramesBesideTheRun, AreOnDiskAtTheEndOfTheWriter) {
  const TemporaryFolder folder;
  {
    ResultsWriter writer = ResultsWriter::create(options_in(folder.path()));
    declare(writer);
    add_samples(writer, 0);
    writer.add_frame(frame_behind(0, [] { std::this_thread::sleep_for(std::chrono::milliseconds(20)); }), 0, 0.0);
  }
  EXPECT_EQ(expect_valid(folder.path()), 1U);
}

/// Calls that tell of a frame that could not be written.
using Telling = std::function<void(ResultsWriter&)>;

class LostFrame : public testing::TestWithParam<std::pair<const char*, Telling>> {};

TEST_P(LostFrame, IsToldOfOnceAndTheRestIsKept) {
  const TemporaryFolder folder;
  ResultsWriter writer = ResultsWriter::create(options_in(folder.path()));
  declare(writer);
  advance(writer, 0, 3);
  add_samples(writer, 4);
  writer.add_frame(frame_behind(4, [] { throw Error(ExitCode::run_failed, "the device is gone"); }), 4, time_at(4));
  EXPECT_EQ(error_of([&] { GetParam().second(writer); }, ExitCode::run_failed), "the device is gone");
  EXPECT_EQ(writer.frame_count(), 2);
  EXPECT_EQ(writer.last_frame_step(), 2);
  writer.check();
  writer.flush();
  EXPECT_EQ(expect_valid(folder.path()), 2U);
  EXPECT_EQ(writer.last_sample_step("flow"), 4);
  EXPECT_EQ(Reader(folder.path() / "results.h5").array("observables/flow/v_rms/value").values.size(), 5U);
  writer.add_frame(frame_at(4), 4, time_at(4));
  writer.finish();
  EXPECT_EQ(expect_valid(folder.path()), 3U);
}

INSTANTIATE_TEST_SUITE_P(
    All, LostFrame,
    testing::Values(std::pair<const char*, Telling>("add_frame",
                                                    [](auto& writer) { writer.add_frame(frame_at(6), 6, 1.0); }),
                    std::pair<const char*, Telling>("wait", [](auto& writer) { writer.wait(); }),
                    std::pair<const char*, Telling>("flush", [](auto& writer) { writer.flush(); }),
                    std::pair<const char*, Telling>("finish", [](auto& writer) { writer.finish(); }),
                    std::pair<const char*, Telling>("check",
                                                    [](auto& writer) {
                                                      for (int tries = 0; tries < 30000; ++tries) {
                                                        writer.check();
                                                        std::this_thread::sleep_for(std::chrono::milliseconds(1));
                                                      }
                                                    })),
    [](const auto& set) { return set.param.first; });

TEST(FramesBesideTheRun, AFirstOneThatIsLostLeavesTheFieldsOpen) {
  const TemporaryFolder folder;
  ResultsWriter writer = ResultsWriter::create(options_in(folder.path()));
  writer.add_frame(frame_behind(0, [] { throw Error(ExitCode::run_failed, "lost"); }), 0, 0.0);
  EXPECT_EQ(error_of([&] { writer.flush(); }, ExitCode::run_failed), "lost");
  EXPECT_EQ(writer.last_frame_step(), -1);
  std::vector<FrameField> fewer = frame_at(0);
  fewer.pop_back();
  writer.add_frame(fewer, 0, 0.0);
  writer.flush();
  EXPECT_EQ(writer.frame_count(), 1);
}

TEST(FramesBesideTheRun, HaveOneRowAParticle) {
  const TemporaryFolder folder;
  ResultsWriter writer = ResultsWriter::create(options_in(folder.path()));
  writer.add_frame(frame_at(0, particles + 1), 0, 0.0);
  EXPECT_THROW(writer.flush(), std::logic_error);
}

}  // namespace
}  // namespace mesogen
