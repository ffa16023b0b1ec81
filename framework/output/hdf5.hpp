#pragma once

#include <hdf5.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

/// The little of HDF5 that is needed here, with owners instead of numbers and exceptions instead of return codes.
namespace mesogen::hdf5 {

/// HDF5 refused something. Callers turn it into an Error that says what to do.
class Failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Owns an open HDF5 object.
class Id {
 public:
  using Close = herr_t (*)(hid_t);
  Id(hid_t id, Close closer, const std::string& what);  ///< throws Failure("cannot " + what) if id < 0
  Id(Id&& other) noexcept;
  Id& operator=(Id&& other) noexcept;
  Id(const Id&) = delete;
  Id& operator=(const Id&) = delete;
  ~Id();

  [[nodiscard]] hid_t get() const { return id_; }
  /// Closes now, so that an error on writing what was held back is not lost. Throws Failure.
  void close();

 private:
  hid_t id_;
  Close close_;
};

/// Throws Failure("cannot " + what: what HDF5 says) if status < 0.
void check(herr_t status, const std::string& what);

using Dimensions = std::vector<hsize_t>;

/// How values of a C++ type lie in memory, and how they are stored.
template <class T>
hid_t memory_type() {
  static_assert(std::is_same_v<T, double> || std::is_same_v<T, float> || std::is_same_v<T, std::int64_t> ||
                std::is_same_v<T, std::int32_t>);
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, float>) return H5T_NATIVE_FLOAT;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5T_NATIVE_INT32;
  return H5T_NATIVE_INT64;
}
template <class T>
hid_t stored_type() {
  if constexpr (std::is_same_v<T, double>) return H5T_IEEE_F64LE;
  if constexpr (std::is_same_v<T, float>) return H5T_IEEE_F32LE;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5T_STD_I32LE;
  return H5T_STD_I64LE;
}

// Files. A file made in memory is written by write_file(), so a full disk never meets HDF5.
Id create_in_memory();
std::vector<std::byte> image(const Id& file);
Id open_file(const std::filesystem::path& path);
Id open_to_write(const std::filesystem::path& path);
Id open_image(std::span<const std::byte> bytes);

// Groups and names.
Id create_group(const Id& parent, const std::string& name);
Id open_group(const Id& parent, const std::string& name);
bool has(const Id& parent, const std::string& name);
std::vector<std::string> names(const Id& group);

// Datasets.
Id dataspace(const Dimensions& dimensions);
/// Contiguous, its space on disk taken at once.
Id create_dataset(const Id& parent, const std::string& name, hid_t type, const Dimensions& dimensions);
Id open_dataset(const Id& parent, const std::string& name);
Dimensions dimensions_of(const Id& dataset);
/// The part of a dataspace at one index of the first axis.
Id slice(const Dimensions& dimensions, hsize_t index);

// Texts of datasets are UTF-8 of variable length; those of attributes have a fixed length, as H5MD asks, and are ASCII
// where they can be. A text attribute of either kind can be read.
void write_text(const Id& parent, const std::string& name, const std::string& text);
std::string read_text(const Id& parent, const std::string& name);
void write_attribute(const Id& object, const std::string& name, const std::string& text);
void write_attribute(const Id& object, const std::string& name, const std::vector<std::string>& texts);
bool has_attribute(const Id& object, const std::string& name);
std::string read_text_attribute(const Id& object, const std::string& name);

/// Throws Failure unless a dataset has this many values.
void check_size(const Id& dataset, const std::string& name, std::size_t expected);

template <class T>
Id write(const Id& parent, const std::string& name, const Dimensions& dimensions, const std::vector<T>& values,
         hid_t type = stored_type<T>()) {
  Id dataset = create_dataset(parent, name, type, dimensions);
  check_size(dataset, name, values.size());
  check(H5Dwrite(dataset.get(), memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "write " + name);
  return dataset;
}

template <class T>
std::vector<T> read(const Id& dataset, const std::string& name) {
  std::size_t size = 1;
  for (const hsize_t n : dimensions_of(dataset)) size *= n;
  std::vector<T> values(size);
  check(H5Dread(dataset.get(), memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "read " + name);
  return values;
}
template <class T>
std::vector<T> read(const Id& parent, const std::string& name, std::size_t expected) {
  const Id dataset = open_dataset(parent, name);
  check_size(dataset, name, expected);
  return read<T>(dataset, name);
}

template <class T>
void write_attribute(const Id& object, const std::string& name, const std::vector<T>& values) {
  const Id space = dataspace({values.size()});
  const Id attribute(H5Acreate2(object.get(), name.c_str(), stored_type<T>(), space.get(), H5P_DEFAULT, H5P_DEFAULT),
                     H5Aclose, "create attribute " + name);
  check(H5Awrite(attribute.get(), memory_type<T>(), values.data()), "write attribute " + name);
}
template <class T>
void write_attribute(const Id& object, const std::string& name, T value) {
  const Id space(H5Screate(H5S_SCALAR), H5Sclose, "make a dataspace");
  const Id attribute(H5Acreate2(object.get(), name.c_str(), stored_type<T>(), space.get(), H5P_DEFAULT, H5P_DEFAULT),
                     H5Aclose, "create attribute " + name);
  check(H5Awrite(attribute.get(), memory_type<T>(), &value), "write attribute " + name);
}
template <class T>
T read_attribute(const Id& object, const std::string& name) {
  const Id attribute(H5Aopen(object.get(), name.c_str(), H5P_DEFAULT), H5Aclose, "find attribute " + name);
  const Id space(H5Aget_space(attribute.get()), H5Sclose, "read attribute " + name);
  if (H5Sget_simple_extent_npoints(space.get()) != 1) throw Failure("attribute " + name + " is not one number");
  T value{};
  check(H5Aread(attribute.get(), memory_type<T>(), &value), "read attribute " + name);
  return value;
}

}  // namespace mesogen::hdf5
