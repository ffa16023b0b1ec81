#include <cstdlib>

#include "output_fixture.hpp"

namespace mesogen {
namespace {

using namespace output_test;

TEST(Results, AreReadableAtEveryStage) {
  const TemporaryFolder folder;
  ResultsWriter writer = ResultsWriter::create(options_in(folder.path()));
  EXPECT_TRUE(Reader(folder.path() / "results.h5").is_open());
  declare(writer);
  writer.flush();
  EXPECT_EQ(expect_valid(folder.path()), 0U);
  for (std::int64_t step = 0; step < 8; ++step) {
    advance(writer, step, step);
    EXPECT_EQ(expect_valid(folder.path()), static_cast<std::size_t>(step / 2 + 1));
  }
  EXPECT_TRUE(Reader(folder.path() / "results.h5").array("particles/fluid/position/value").is_virtual);
  writer.finish();
  EXPECT_EQ(expect_valid(folder.path()), 4U);
  EXPECT_FALSE(Reader(folder.path() / "results.h5").array("particles/fluid/position/value").is_virtual);
  EXPECT_FALSE(fs::exists(folder.path() / "frames"));
}

TEST(Results, AreH5md) {
  const TemporaryFolder folder;
  ResultsWriter writer = ResultsWriter::create(options_in(folder.path()));
  declare(writer);
  advance(writer, 0, 4);
  writer.finish();
  const Reader reader(folder.path() / "results.h5");

  std::int64_t version[2] = {0, 0};
  const hid_t attribute = H5Aopen_by_name(reader.file(), "h5md", "version", H5P_DEFAULT, H5P_DEFAULT);
  ASSERT_GE(H5Aread(attribute, H5T_NATIVE_INT64, &version), 0);
  H5Aclose(attribute);
  EXPECT_EQ(version[0], 1);
  EXPECT_EQ(version[1], 1);
  EXPECT_FALSE(reader.text_attribute("h5md/author", "name").empty());
  EXPECT_EQ(reader.text_attribute("h5md/creator", "name"), "Mesogen");
  EXPECT_EQ(reader.text_attribute("h5md/creator", "version"), "0.1.0");

  EXPECT_EQ(reader.array("particles/fluid/box/edges").values, (std::vector<double>{2.0, 3.0}));
  EXPECT_EQ(reader.array("particles/fluid/id").values, (std::vector<double>{0, 1, 2, 3, 4, 5, 6}));
  const Array velocity = reader.array("particles/fluid/velocity/value");
  EXPECT_EQ(velocity.sizes, (std::vector<hsize_t>{3, 7, 2}));
  EXPECT_EQ(velocity.bytes_each, 4U);
  EXPECT_EQ(reader.array("particles/fluid/position/value").bytes_each, 8U);
  EXPECT_EQ(reader.array("particles/fluid/image/value").bytes_each, 4U);
  EXPECT_TRUE(reader.array("particles/fluid/image/value").is_integer);
  EXPECT_EQ(reader.array("particles/fluid/pressure/value").sizes, (std::vector<hsize_t>{3, 7}));
  EXPECT_EQ(reader.array("particles/fluid/pressure/step").values, (std::vector<double>{0, 2, 4}));
  EXPECT_EQ(reader.array("particles/fluid/pressure/time").values, (std::vector<double>{0, 0.25, 0.5}));
  EXPECT_EQ(reader.text_attribute("particles/fluid/velocity/value", "unit"), "m s-1");
  EXPECT_EQ(reader.text_attribute("particles/fluid/velocity/time", "unit"), "s");
  for (const char* name : {"step", "time"})
    EXPECT_EQ(reader.address(std::string("particles/fluid/velocity/") + name),
              reader.address(std::string("particles/fluid/position/") + name));
  EXPECT_EQ(reader.array("parameters/seed").values, (std::vector<double>{42}));
}

TEST(Results, TellWhatTheRunTookOnceItIsFinished) {
  const TemporaryFolder folder;
  ResultsWriter writer = ResultsWriter::create(options_in(folder.path()));
  declare(writer);
  advance(writer, 0, 4);
  writer.flush();
  EXPECT_EQ(H5Lexists(Reader(folder.path() / "results.h5").file(), "parameters/cost", H5P_DEFAULT), 0);
  writer.finish(RunCost{.steps = 3,
                        .sessions = 2,
                        .wall_seconds = 1.5,
                        .cpu_seconds = 2.25,
                        .threads = 2,
                        .peak_memory = std::int64_t{1} << 40});
  const Reader reader(folder.path() / "results.h5");
  const auto number = [&](const char* name) {
    double value = 0.0;
    const hid_t attribute = H5Aopen_by_name(reader.file(), "parameters/cost", name, H5P_DEFAULT, H5P_DEFAULT);
    EXPECT_GE(H5Aread(attribute, H5T_NATIVE_DOUBLE, &value), 0) << name;
    H5Aclose(attribute);
    return value;
  };
  EXPECT_EQ(number("steps"), 3.0);
  EXPECT_EQ(number("sessions"), 2.0);
  EXPECT_EQ(number("wall_seconds"), 1.5);
  EXPECT_EQ(number("cpu_seconds"), 2.25);
  EXPECT_EQ(number("threads"), 2.0);
  EXPECT_EQ(number("peak_memory"), 1099511627776.0);
}

TEST(Results, HoldTablesOfFixedAndVaryingSize) {
  const TemporaryFolder folder;
  ResultsWriter writer = ResultsWriter::create(options_in(folder.path()));
  declare(writer);
  advance(writer, 0, 4);
  writer.flush();
  const Reader reader(folder.path() / "results.h5");
  EXPECT_EQ(reader.array("observables/flow/v_rms/value").sizes, (std::vector<hsize_t>{5}));
  EXPECT_EQ(reader.text_attribute("observables/flow/v_rms/value", "unit"), "m s-1");
  EXPECT_EQ(reader.text_attribute("observables/flow/v_rms/value", "description"), "root mean square speed");
  EXPECT_EQ(reader.array("observables/flow/path/value").sizes, (std::vector<hsize_t>{5, 2, 3}));
  EXPECT_EQ(reader.array("observables/flow/path/step").values, (std::vector<double>{0, 1, 2, 3, 4}));

  const Array defects = reader.array("observables/defects/defects/value");
  EXPECT_EQ(defects.sizes, (std::vector<hsize_t>{5, 4, 2}));
  const Array count = reader.array("observables/defects/defects/count");
  EXPECT_EQ(count.values, (std::vector<double>{0, 2, 4, 1, 3}));
  for (std::size_t sample = 0; sample < 5; ++sample)
    for (std::size_t row = 0; row < 4; ++row) {
      const double value = defects.values[(sample * 4 + row) * 2];
      if (static_cast<double>(row) < count.values[sample])
        EXPECT_EQ(value, value_at(static_cast<std::int64_t>(sample), 2));
      else
        EXPECT_TRUE(std::isnan(value));
    }
}

TEST(Results, AreReadByPythonFromAnywhere) {
  ASSERT_EQ(std::system("/usr/bin/python3 -c 'import h5py'"), 0) << "scripts/setup installs python3-h5py";
  const TemporaryFolder folder;
  const fs::path check = folder.path() / "check.py";
  std::ofstream(check) << R"(
import sys, numpy as np, h5py
with h5py.File(sys.argv[1], "r") as f:
    fluid = f["particles/fluid"]
    frames = fluid["position/value"]
    assert frames.shape == (3, 7, 2), frames.shape
    expected = np.sin(np.array([0, 2, 4])[:, None] + 0.1 * np.arange(14)).reshape(3, 7, 2)
    assert np.allclose(frames[:], expected, rtol=0, atol=1e-15), frames[:] - expected
    assert np.array_equal(fluid["velocity/value"][-1], expected[-1].astype("f4"))
    assert fluid["velocity/value"].attrs["unit"] == b"m s-1"
    assert list(fluid["box"].attrs["boundary"]) == [b"periodic", b"none"], fluid["box"].attrs["boundary"]
    assert fluid["box"].attrs["dimension"] == 2
    assert f["parameters/case"].asstr()[()] == 'title = "test"\n'
    assert f["parameters/build"].asstr()[()] == "release, gcc"
    assert int(f["parameters/seed"][()]) == 42
    assert list(f["h5md"].attrs["version"]) == [1, 1]
)";
  ResultsWriter writer = ResultsWriter::create(options_in(folder.path()));
  declare(writer);
  advance(writer, 0, 4);
  const std::string command =
      "cd / && /usr/bin/python3 " + check.string() + " " + (folder.path() / "results.h5").string();
  EXPECT_EQ(std::system(command.c_str()), 0) << "while running";
  writer.finish();
  EXPECT_EQ(std::system(command.c_str()), 0) << "finished";
}

TEST(Results, RefuseSamplesThatDoNotFitTheirDeclaration) {
  const TemporaryFolder folder;
  ResultsWriter writer = ResultsWriter::create(options_in(folder.path()));
  declare(writer);
  add_samples(writer, 0);
  const auto refusal = [&](const char* name, const std::vector<double>& values) {
    Sample sample;
    sample.set("v_rms", 1.0);
    sample.set("path", std::vector<double>(6, 1.0));
    sample.set(name, values);
    return error_of([&] { writer.add_sample("flow", sample, 1, 1.0); }, ExitCode::run_failed);
  };
  EXPECT_EQ(refusal("speed", {1.0}),
            "observers.flow: sets speed, which it did not declare; this is a fault of its plugin");
  EXPECT_EQ(refusal("v_rms", {1.0, 2.0}),
            "observers.flow: v_rms of the sample at step 1 has 2 numbers, but was declared as one; this is a fault of "
            "its plugin");
  EXPECT_EQ(refusal("path", {1.0, 2.0}),
            "observers.flow: path of the sample at step 1 has 2 numbers, which do not fill rows of 3; this is a fault "
            "of its plugin");
  EXPECT_EQ(refusal("path", {1.0, 2.0, 3.0}),
            "observers.flow: path of the sample at step 1 has 1 rows, the samples before have 2: declare it as "
            "varying; this is a fault of its plugin");
  Sample incomplete;
  incomplete.set("v_rms", 1.0);
  EXPECT_EQ(error_of([&] { writer.add_sample("flow", incomplete, 1, 1.0); }, ExitCode::run_failed),
            "observers.flow: its sample at step 1 lacks path, which it declared; this is a fault of its plugin");
  EXPECT_EQ(writer.last_sample_step("flow"), 0) << "nothing is kept of a refused sample";
}

TEST(Results, IgnoreWhatIsThereAlready) {
  const TemporaryFolder folder;
  ResultsWriter writer = ResultsWriter::create(options_in(folder.path()));
  declare(writer);
  advance(writer, 0, 2);
  advance(writer, 2, 2);
  EXPECT_EQ(writer.frame_count(), 2);
  EXPECT_EQ(writer.last_frame_step(), 2);
  EXPECT_THROW(writer.add_frame(frame_at(1), 1, 0.1), std::logic_error);
  EXPECT_THROW(add_samples(writer, 1), std::logic_error);
  writer.flush();
  EXPECT_EQ(expect_valid(folder.path()), 2U);
}

}  // namespace
}  // namespace mesogen
