#pragma once

#include <gtest/gtest.h>
#include <hdf5.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "error_of.hpp"
#include "mesogen/diagnostics/error.hpp"
#include "output/results.hpp"

/// A small run to write, and a reader of HDF5 that shares nothing with the writer.
namespace mesogen::output_test {

namespace fs = std::filesystem;

/// An empty folder, removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "mesogen_output_XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

inline std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}
inline void put_bytes(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

struct Array {
  std::vector<hsize_t> sizes;
  std::vector<double> values;
  std::size_t bytes_each = 0;
  bool is_integer = false;
  bool is_virtual = false;
};

/// Reads results.h5; every value that it cannot read fails the test.
class Reader {
 public:
  explicit Reader(const fs::path& file) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    file_ = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() {
    if (file_ >= 0) H5Fclose(file_);
  }
  [[nodiscard]] bool is_open() const { return file_ >= 0; }
  [[nodiscard]] hid_t file() const { return file_; }

  [[nodiscard]] Array array(const std::string& name) const {
    Array result;
    const hid_t dataset = H5Dopen2(file_, name.c_str(), H5P_DEFAULT);
    EXPECT_GE(dataset, 0) << name;
    if (dataset < 0) return result;
    const hid_t space = H5Dget_space(dataset);
    const hid_t type = H5Dget_type(dataset);
    const hid_t list = H5Dget_create_plist(dataset);
    result.sizes.resize(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
    H5Sget_simple_extent_dims(space, result.sizes.data(), nullptr);
    result.values.resize(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    result.bytes_each = H5Tget_size(type);
    result.is_integer = H5Tget_class(type) == H5T_INTEGER;
    result.is_virtual = H5Pget_layout(list) == H5D_VIRTUAL;
    EXPECT_GE(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, result.values.data()), 0) << name;
    H5Pclose(list);
    H5Tclose(type);
    H5Sclose(space);
    H5Dclose(dataset);
    return result;
  }
  [[nodiscard]] std::string text_attribute(const std::string& object, const std::string& name) const {
    const hid_t attribute = H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
    EXPECT_GE(attribute, 0) << object << "@" << name;
    if (attribute < 0) return {};
    const hid_t type = H5Aget_type(attribute);
    EXPECT_EQ(H5Tis_variable_str(type), 0) << object << "@" << name << " must have a fixed length";
    std::string result(H5Tget_size(type), '\0');
    H5Aread(attribute, type, result.data());
    result.resize(result.find_last_not_of('\0') + 1);
    H5Tclose(type);
    H5Aclose(attribute);
    return result;
  }
  /// Where an object lies in the file: the same for two names of one object.
  [[nodiscard]] haddr_t address(const std::string& name) const {
    H5O_info_t info;
    return H5Oget_info_by_name(file_, name.c_str(), &info, H5P_DEFAULT) < 0 ? HADDR_UNDEF : info.addr;
  }

 private:
  hid_t file_ = -1;
};

constexpr Index particles = 7;

inline ResultsOptions options_in(const fs::path& folder) {
  return {folder, {2.0, 3.0, 0.0}, 2, {true, false}, "title = \"test\"\n", "0.1.0", "release, gcc", 42, particles};
}

inline double value_at(std::int64_t step, std::size_t i) {
  return std::sin(static_cast<double>(step) + 0.1 * static_cast<double>(i));
}

inline double image_at(std::int64_t step, std::size_t i) { return static_cast<double>(step) - static_cast<double>(i); }

inline std::vector<FrameField> frame_at(std::int64_t step, Index count = particles) {
  const auto n = static_cast<std::size_t>(count);
  std::vector<FrameField> fields{{"velocity", "m/s", 2, std::vector<double>(2 * n), NumberType::float32, Rank::vector},
                                 {"position", "m", 2, std::vector<double>(2 * n), NumberType::float64, Rank::vector},
                                 {"image", "1", 2, std::vector<double>(2 * n), NumberType::int32, Rank::vector},
                                 {"pressure", "Pa", 1, std::vector<double>(n), NumberType::float64}};
  for (FrameField& field : fields)
    for (std::size_t i = 0; i < field.values.size(); ++i)
      field.values[i] = field.type == NumberType::int32 ? image_at(step, i) : value_at(step, i);
  return fields;
}

inline double time_at(std::int64_t step) { return 0.125 * static_cast<double>(step); }

inline void declare(ResultsWriter& writer) {
  Quantity v_rms;
  v_rms.name = "v_rms";
  v_rms.unit("m/s").doc("root mean square speed");
  Quantity path;
  path.name = "path";
  path.columns = 3;
  Quantity defects;
  defects.name = "defects";
  defects.columns = 2;
  defects.varying = true;
  writer.declare_observable("flow", v_rms);
  writer.declare_observable("flow", path);
  writer.declare_observable("defects", defects);
}

/// 0, 2, 4, 1, 3 rows, over and over: some samples have none, and the most rows come late.
inline std::size_t defects_at(std::int64_t step) { return static_cast<std::size_t>((step * 2) % 5); }

inline void add_samples(ResultsWriter& writer, std::int64_t step) {
  Sample flow;
  flow.set("v_rms", value_at(step, 0));
  flow.set("path", std::vector<double>(6, value_at(step, 1)));
  writer.add_sample("flow", flow, step, time_at(step));
  Sample defects;
  defects.set("defects", std::vector<double>(2 * defects_at(step), value_at(step, 2)));
  writer.add_sample("defects", defects, step, time_at(step));
}

/// Samples at each step, frames at each second one. The last may not be on disk yet.
inline void record(ResultsWriter& writer, std::int64_t from, std::int64_t to, Index count = particles) {
  for (std::int64_t step = from; step <= to; ++step) {
    add_samples(writer, step);
    if (step % 2 == 0) writer.add_frame(frame_at(step, count), step, time_at(step));
  }
}

/// The same; all of it is on disk then.
inline void advance(ResultsWriter& writer, std::int64_t from, std::int64_t to, Index count = particles) {
  record(writer, from, to, count);
  writer.flush();
}

/// results.h5 is readable and all its values are those of the run; returns the number of frames.
inline std::size_t expect_valid(const fs::path& folder, Index count = particles) {
  const Reader reader(folder / "results.h5");
  EXPECT_TRUE(reader.is_open());
  if (!reader.is_open()) return 0;
  // Killed before its observers were declared.
  if (H5Lexists(reader.file(), "observables/flow", H5P_DEFAULT) <= 0) return 0;
  const Array steps_of_samples = reader.array("observables/flow/v_rms/step");
  const Array v_rms = reader.array("observables/flow/v_rms/value");
  EXPECT_EQ(steps_of_samples.values.size(), v_rms.values.size());
  for (std::size_t i = 0; i < v_rms.values.size(); ++i) {
    EXPECT_EQ(steps_of_samples.values[i], static_cast<double>(i));
    EXPECT_EQ(v_rms.values[i], value_at(static_cast<std::int64_t>(i), 0));
  }
  if (H5Lexists(reader.file(), "particles/fluid/position", H5P_DEFAULT) <= 0) return 0;
  const Array steps = reader.array("particles/fluid/position/step");
  const Array position = reader.array("particles/fluid/position/value");
  const Array velocity = reader.array("particles/fluid/velocity/value");
  const Array image = reader.array("particles/fluid/image/value");
  const std::size_t row = 2 * static_cast<std::size_t>(count);
  EXPECT_EQ(position.values.size(), steps.values.size() * row);
  for (std::size_t frame = 0; frame < steps.values.size(); ++frame) {
    const auto step = static_cast<std::int64_t>(steps.values[frame]);
    EXPECT_EQ(step, static_cast<std::int64_t>(2 * frame));
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < row; ++i) {
      const double expected = value_at(step, i);
      if (position.values[frame * row + i] != expected) ++wrong;
      if (velocity.values[frame * row + i] != static_cast<double>(static_cast<float>(expected))) ++wrong;
      if (image.values[frame * row + i] != image_at(step, i)) ++wrong;
    }
    EXPECT_EQ(wrong, 0U) << "frame " << frame;
  }
  return steps.values.size();
}

}  // namespace mesogen::output_test
