#include <algorithm>
#include <limits>
#include <random>

#include "output/checkpoint.hpp"
#include "output/checkpoint_file.hpp"
#include "output_fixture.hpp"

namespace mesogen {
namespace {

using namespace output_test;

Checkpoint checkpoint_at(std::int64_t step) {
  Checkpoint checkpoint;
  checkpoint.step = step;
  checkpoint.time = time_at(step);
  checkpoint.step_size = 0.1;
  checkpoint.case_text = "title = \"Grüße\"\n";
  checkpoint.version = "0.1.0";
  checkpoint.instruction_sets = "derivatives x86-64-v3, wcsph baseline";
  checkpoint.precision = Precision::double_precision;
  checkpoint.numbers["position.0"].resize(1500);
  for (std::size_t i = 0; i < 1500; ++i) checkpoint.numbers["position.0"][i] = value_at(step, i);
  checkpoint.numbers["odd"] = {-0.0, std::numeric_limits<double>::denorm_min(),
                               std::numeric_limits<double>::infinity()};
  checkpoint.numbers["none"] = {};
  checkpoint.integers["id"] = {5, std::numeric_limits<std::int64_t>::min(), 3};
  checkpoint.observers["paths"]["distance"] = {1.0, 2.0};
  checkpoint.observers["flow"] = {};
  checkpoint.cost = {
      .steps = 17, .sessions = 2, .wall_seconds = 1.5, .cpu_seconds = 3.0, .threads = 2, .peak_memory = 9};
  checkpoint.end_records = {.observers = {"flow", "paths"}, .frame = true};
  checkpoint.shortened_for = 0.3;
  checkpoint.origin = BranchOrigin{"/runs/first", "checkpoint_a.h5", 0.25, 4, {"title=\"a\"", "time.end=2"}};
  checkpoint.starts_branch = true;
  return checkpoint;
}

std::string refusal_of(const fs::path& file) {
  return error_of([&] { (void)read_checkpoint(file); }, ExitCode::bad_case);
}

TEST(Checkpoints, KeepEverything) {
  const TemporaryFolder folder;
  EXPECT_FALSE(has_checkpoint(folder.path()));
  const Checkpoint written = checkpoint_at(17);
  write_checkpoint(folder.path(), written);
  EXPECT_TRUE(has_checkpoint(folder.path()));
  std::string which;
  std::vector<std::string> refused{"something"};
  const Checkpoint read = read_newest_checkpoint(folder.path(), &which, &refused);
  EXPECT_TRUE(read == written);
  EXPECT_TRUE(std::signbit(read.numbers.at("odd")[0]));
  EXPECT_EQ(which, "checkpoint_a.h5");
  EXPECT_TRUE(refused.empty());
}

TEST(Checkpoints, AlternateBetweenTwoFiles) {
  const TemporaryFolder folder;
  for (std::int64_t step = 1; step <= 5; ++step) {
    write_checkpoint(folder.path(), checkpoint_at(step));
    std::string which;
    EXPECT_EQ(read_newest_checkpoint(folder.path(), &which).step, step);
    EXPECT_EQ(which, step % 2 == 1 ? "checkpoint_a.h5" : "checkpoint_b.h5");
    if (step > 1) {
      EXPECT_EQ(read_checkpoint(folder.path() / (step % 2 == 1 ? "checkpoint_b.h5" : "checkpoint_a.h5")).step,
                step - 1);
    }
  }
}

TEST(Checkpoints, KeepTheOneBeforeTheEndBesideTheTwo) {
  const TemporaryFolder folder;
  write_checkpoint(folder.path(), checkpoint_at(10));
  write_checkpoint_before_end(folder.path(), checkpoint_at(20));
  EXPECT_EQ(read_newest_checkpoint(folder.path()).step, 20);
  for (const std::int64_t step : {21, 22, 23}) write_checkpoint(folder.path(), checkpoint_at(step));
  EXPECT_EQ(read_newest_checkpoint(folder.path()).step, 23);
  std::string which;
  const auto older = [](const Checkpoint& one) { return one.step > 20 ? "too late" : ""; };
  EXPECT_EQ(read_newest_checkpoint(folder.path(), &which, nullptr, older).step, 20);
  EXPECT_EQ(which, "checkpoint_before_end.h5");
}

TEST(Checkpoints, ContinueToAlternateFromAnOlderOne) {
  const TemporaryFolder folder;
  write_checkpoint(folder.path(), checkpoint_at(10));
  write_checkpoint(folder.path(), checkpoint_at(20));
  // The newer is refused, the run goes on from step 10: its checkpoints are now the newest.
  write_checkpoint(folder.path(), checkpoint_at(12));
  EXPECT_EQ(read_newest_checkpoint(folder.path()).step, 12);
}

TEST(Checkpoints, AreHdf5FilesToOtherPrograms) {
  const TemporaryFolder folder;
  write_checkpoint(folder.path(), checkpoint_at(3));
  const Reader reader(folder.path() / "checkpoint_a.h5");
  ASSERT_TRUE(reader.is_open());
  EXPECT_EQ(reader.array("numbers/position.0").values, checkpoint_at(3).numbers.at("position.0"));
}

class DamagedCheckpoints : public testing::Test {
 protected:
  DamagedCheckpoints() {
    write_checkpoint(folder.path(), checkpoint_at(1));
    write_checkpoint(folder.path(), checkpoint_at(2));
    newest = folder.path() / "checkpoint_b.h5";
    whole = bytes_of(newest);
  }
  /// The older one is used, and the newer one's fault is told.
  void expect_older_instead_of(const std::string& bytes, const std::string& reason) {
    put_bytes(newest, bytes);
    std::string which;
    std::vector<std::string> refused;
    EXPECT_EQ(read_newest_checkpoint(folder.path(), &which, &refused).step, 1);
    EXPECT_EQ(which, "checkpoint_a.h5");
    ASSERT_EQ(refused.size(), 1U);
    EXPECT_EQ(refused[0].rfind("checkpoint_b.h5: " + reason, 0), 0U) << refused[0];
  }
  TemporaryFolder folder;
  fs::path newest;
  std::string whole;
};

TEST_F(DamagedCheckpoints, AreRefusedWhereverTheyEnd) {
  ASSERT_GT(whole.size(), 12288U);
  for (std::size_t size = 0; size < whole.size(); size += 4096)
    expect_older_instead_of(whole.substr(0, size), "truncated: ");
  expect_older_instead_of(whole.substr(0, whole.size() - 1), "truncated: ");
  put_bytes(newest, whole.substr(0, 4096));
  EXPECT_EQ(refusal_of(newest),
            "cannot use " + newest.string() + ": truncated: it has 4096 bytes of " + std::to_string(whole.size()));
  put_bytes(newest, whole.substr(0, 10));
  EXPECT_EQ(refusal_of(newest),
            "cannot use " + newest.string() + ": truncated: it has 10 bytes, not even its first 512");
  put_bytes(newest, whole + "x");
  EXPECT_EQ(refusal_of(newest), "cannot use " + newest.string() + ": damaged: it has " +
                                    std::to_string(whole.size() + 1) + " bytes of " + std::to_string(whole.size()));
}

TEST_F(DamagedCheckpoints, AreRefusedWhicheverByteIsFlipped) {
  std::mt19937 random(7);
  std::vector<std::size_t> places(600);
  for (std::size_t i = 0; i < 512; ++i) places[i] = i;  // all of the seal
  for (std::size_t i = 512; i < places.size(); ++i) places[i] = random() % whole.size();
  for (std::size_t place = 512; place < whole.size(); place += 61) places.push_back(place);
  for (const std::size_t place : places) {
    std::string bytes = whole;
    bytes[place] = static_cast<char>(bytes[place] ^ (1 << (random() % 8)));
    // A length that is another one reads as truncated.
    expect_older_instead_of(bytes, place < 19 ? "not a Mesogen checkpoint" : (place < 64 ? "" : "damaged: "));
  }
  std::string bytes = whole;
  bytes[2000] = static_cast<char>(bytes[2000] ^ 1);
  put_bytes(newest, bytes);
  EXPECT_EQ(refusal_of(newest), "cannot use " + newest.string() + ": damaged: its checksum does not match its bytes");
  put_bytes(newest, "x" + whole.substr(1));
  EXPECT_EQ(refusal_of(newest), "cannot use " + newest.string() + ": not a Mesogen checkpoint, or damaged");
}

TEST_F(DamagedCheckpoints, GiveBothReasonsIfNoneIsLeft) {
  put_bytes(newest, whole.substr(0, 5000));
  std::string other = bytes_of(folder.path() / "checkpoint_a.h5");
  other[600] = static_cast<char>(~other[600]);
  put_bytes(folder.path() / "checkpoint_a.h5", other);
  EXPECT_EQ(error_of([&] { (void)read_newest_checkpoint(folder.path()); }, ExitCode::bad_case),
            "no checkpoint in " + folder.path().string() +
                " can be used:\n  checkpoint_a.h5: damaged: its checksum does not match its bytes\n"
                "  checkpoint_b.h5: truncated: it has 5000 bytes of " +
                std::to_string(whole.size()));
}

TEST_F(DamagedCheckpoints, IncludeThoseThatTheCallerRefuses) {
  std::string which;
  std::vector<std::string> refused;
  const CheckpointCheck only_first = [](const Checkpoint& checkpoint) {
    return checkpoint.step == 1 ? std::string() : "made by version 9";
  };
  EXPECT_EQ(read_newest_checkpoint(folder.path(), &which, &refused, only_first).step, 1);
  EXPECT_EQ(refused, (std::vector<std::string>{"checkpoint_b.h5: made by version 9"}));
  const CheckpointCheck none = [](const Checkpoint&) { return std::string("of another case"); };
  EXPECT_EQ(error_of([&] { (void)read_newest_checkpoint(folder.path(), nullptr, nullptr, none); }, ExitCode::bad_case),
            "no checkpoint in " + folder.path().string() +
                " can be used:\n  checkpoint_b.h5: of another case\n  checkpoint_a.h5: of another case");
}

TEST_F(DamagedCheckpoints, AreReplacedBeforeWholeOnes) {
  put_bytes(newest, whole.substr(0, 5000));
  write_checkpoint(folder.path(), checkpoint_at(3));
  EXPECT_EQ(read_checkpoint(newest).step, 3);
  EXPECT_EQ(read_checkpoint(folder.path() / "checkpoint_a.h5").step, 1);
}

TEST(Checkpoints, AreRefusedIfTheyHoldSomethingElse) {
  const TemporaryFolder folder;
  EXPECT_EQ(error_of([&] { (void)read_newest_checkpoint(folder.path()); }, ExitCode::bad_case),
            folder.path().string() + " holds no checkpoint to continue from");
  EXPECT_NE(refusal_of(folder.path() / "checkpoint_a.h5").find("No such file or directory"), std::string::npos);
  // Whole, by its seal, but not what it should be: the seal of one file on the content of another kind.
  Checkpoint empty;
  std::vector<std::byte> bytes = output::encode_checkpoint(empty, 1);
  EXPECT_TRUE(output::decode_checkpoint(bytes) == empty);
}

}  // namespace
}  // namespace mesogen
