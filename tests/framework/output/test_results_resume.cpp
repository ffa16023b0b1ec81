#include "output_fixture.hpp"

namespace mesogen {
namespace {

using namespace output_test;

constexpr std::int64_t last = 12;

std::string unbroken() {
  const TemporaryFolder folder;
  ResultsWriter writer = ResultsWriter::create(options_in(folder.path()));
  declare(writer);
  advance(writer, 0, last);
  writer.finish();
  return bytes_of(folder.path() / "results.h5");
}

TEST(ResumedResults, AreTheBytesOfAnUnbrokenRun) {
  const std::string expected = unbroken();
  for (std::int64_t step = 0; step <= last; ++step) {
    const TemporaryFolder folder;
    {
      ResultsWriter writer = ResultsWriter::create(options_in(folder.path()));
      declare(writer);
      advance(writer, 0, std::min<std::int64_t>(step + 3, last));
      writer.flush();
    }
    ResultsWriter writer = ResultsWriter::resume(options_in(folder.path()), step);
    EXPECT_EQ(expect_valid(folder.path()), static_cast<std::size_t>(step / 2 + 1));
    EXPECT_FALSE(fs::exists(folder.path() / output::frame_name(static_cast<std::size_t>(step / 2 + 1))));
    declare(writer);
    EXPECT_EQ(writer.last_frame_step(), step / 2 * 2);
    EXPECT_EQ(writer.last_sample_step("flow"), step);
    advance(writer, step + 1, last);
    writer.finish();
    EXPECT_TRUE(bytes_of(folder.path() / "results.h5") == expected) << "resumed after step " << step;
  }
}

TEST(ResumedResults, ForgetWhatWasRecordedOnlyBecauseTheRunEnded) {
  const TemporaryFolder folder;
  {
    ResultsWriter writer = ResultsWriter::create(options_in(folder.path()));
    declare(writer);
    advance(writer, 0, 4);
    EXPECT_FALSE(ResultsWriter::are_finished(folder.path()));
    writer.finish(RunCost{});
    EXPECT_TRUE(ResultsWriter::are_finished(folder.path()));
  }
  {
    const ResultsWriter writer =
        ResultsWriter::resume(options_in(folder.path()), 4, {.observers = {"flow"}, .frame = true});
    EXPECT_EQ(writer.last_frame_step(), 2);
    EXPECT_EQ(writer.last_sample_step("flow"), 3);
    EXPECT_EQ(writer.last_sample_step("defects"), 4);
    EXPECT_FALSE(ResultsWriter::are_finished(folder.path()));
  }
  EXPECT_EQ(expect_valid(folder.path()), 2U);
}

TEST(ResumedResults, MayHaveBeenFinished) {
  const std::string expected = unbroken();
  for (const std::int64_t step : {0, 5, 12}) {
    const TemporaryFolder folder;
    {
      ResultsWriter writer = ResultsWriter::create(options_in(folder.path()));
      declare(writer);
      advance(writer, 0, last);
      writer.finish();
    }
    // What a run that was killed while it tidied up leaves.
    fs::create_directory(folder.path() / "frames");
    put_bytes(folder.path() / "frames/000006.h5", "left over");
    ResultsWriter writer = ResultsWriter::resume(options_in(folder.path()), step);
    EXPECT_EQ(expect_valid(folder.path()), static_cast<std::size_t>(step / 2 + 1));
    declare(writer);
    advance(writer, step + 1, last);
    writer.finish();
    EXPECT_TRUE(bytes_of(folder.path() / "results.h5") == expected) << "resumed after step " << step;
    EXPECT_FALSE(fs::exists(folder.path() / "frames"));
  }
}

TEST(ResumedResults, MayStartFromNothing) {
  const TemporaryFolder folder;
  put_bytes(folder.path() / "results.h5", "never completed");
  fs::create_directory(folder.path() / "frames");
  put_bytes(folder.path() / "frames/000003.h5", "old");
  put_bytes(folder.path() / "frames/000004.h5.tmp", "old");
  ResultsWriter writer = ResultsWriter::resume(options_in(folder.path()), -1);
  EXPECT_TRUE(fs::is_empty(folder.path() / "frames"));
  declare(writer);
  advance(writer, 0, last);
  writer.finish();
  EXPECT_TRUE(bytes_of(folder.path() / "results.h5") == unbroken());
}

class BrokenResults : public testing::Test {
 protected:
  BrokenResults() {
    ResultsWriter writer = ResultsWriter::create(options_in(folder.path()));
    declare(writer);
    advance(writer, 0, 6);
  }
  std::string refusal(std::int64_t step = 6) {
    return error_of([&] { ResultsWriter::resume(options_in(folder.path()), step); }, ExitCode::bad_case);
  }
  TemporaryFolder folder;
};

TEST_F(BrokenResults, NameTheFrameThatIsMissing) {
  const fs::path frame = folder.path() / "frames/000002.h5";
  fs::remove(frame);
  EXPECT_EQ(refusal().rfind("cannot continue with the frame " + frame.string() + ": cannot open it as HDF5", 0), 0U)
      << refusal();
  EXPECT_NE(refusal().find("No such file"), std::string::npos) << refusal();
}
TEST_F(BrokenResults, NameTheFrameThatIsDamaged) {
  const fs::path frame = folder.path() / "frames/000001.h5";
  put_bytes(frame, bytes_of(frame).substr(0, 300));
  EXPECT_EQ(refusal().rfind("cannot continue with the frame " + frame.string(), 0), 0U) << refusal();
}
TEST_F(BrokenResults, NameTheFrameOfAnotherStep) {
  const fs::path frame = folder.path() / "frames/000001.h5";
  put_bytes(frame, bytes_of(folder.path() / "frames/000002.h5"));
  EXPECT_EQ(refusal(), "cannot continue with the frame " + frame.string() + ": it is of another step");
}
TEST_F(BrokenResults, AreRefusedWhereverTheyEnd) {
  const std::string whole = bytes_of(folder.path() / "results.h5");
  for (std::size_t size = 0; size < whole.size(); size += 512) {
    put_bytes(folder.path() / "results.h5", whole.substr(0, size));
    EXPECT_EQ(refusal().rfind("cannot continue " + (folder.path() / "results.h5").string() + ": ", 0), 0U)
        << size << ": " << refusal();
  }
}
TEST_F(BrokenResults, AreRefusedIfTheParticlesAreOthers) {
  ResultsOptions options = options_in(folder.path());
  options.count = 9;
  EXPECT_NE(error_of([&] { ResultsWriter::resume(options, 6); }, ExitCode::bad_case)
                .find("has another shape than this run's"),
            std::string::npos);
}
TEST_F(BrokenResults, AreRefusedIfTheyAreMissing) {
  fs::remove(folder.path() / "results.h5");
  EXPECT_NE(refusal().find("No such file"), std::string::npos) << refusal();
}
TEST_F(BrokenResults, TakeNoOtherFieldsOrQuantities) {
  ResultsWriter writer = ResultsWriter::resume(options_in(folder.path()), 6);
  std::vector<FrameField> fields = frame_at(8);
  fields.pop_back();
  EXPECT_EQ(error_of([&] { writer.add_frame(fields, 8, 1.0); }, ExitCode::bad_case),
            "the frames already in " + folder.path().string() +
                " hold other fields; keep output.fields as it was, or start a new run");
  Quantity quantity;
  quantity.name = "energy";
  EXPECT_EQ(error_of([&] { writer.declare_observable("flow", quantity); }, ExitCode::bad_case),
            "observers.flow: the results to be continued have no energy; start a new run to record it");
  quantity.name = "v_rms";
  quantity.columns = 2;
  EXPECT_EQ(error_of([&] { writer.declare_observable("flow", quantity); }, ExitCode::bad_case),
            "observers.flow: v_rms has another shape in the results to be continued; start a new run");
}

}  // namespace
}  // namespace mesogen
