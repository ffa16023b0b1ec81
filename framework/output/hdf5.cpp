#include "output/hdf5.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <string>
#include <utility>

namespace mesogen::hdf5 {

namespace {

/// What HDF5 says went wrong, innermost first: the last of its stack is what the system answered.
std::string reason() {
  std::string text;
  const auto collect = [](unsigned /*depth*/, const H5E_error2_t* entry, void* target) -> herr_t {
    auto& out = *static_cast<std::string*>(target);
    if (out.empty() && entry->desc != nullptr) out = entry->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, collect, &text);
  H5Eclear2(H5E_DEFAULT);
  return text;
}

/// HDF5 prints its own stack of errors unless told not to; each thread has its own setting.
void silence() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

Id property_list(hid_t kind) { return {H5Pcreate(kind), H5Pclose, "make a property list"}; }

Id access_list() {
  silence();
  Id list = property_list(H5P_FILE_ACCESS);
  // As old a format as each object allows: every HDF5 reads it (views of frames need 1.10), and its superblock has no
  // checksum, which H5Fget_file_image would leave wrong.
  check(H5Pset_libver_bounds(list.get(), H5F_LIBVER_EARLIEST, H5F_LIBVER_V110), "choose a file format");
#if H5_VERSION_GE(1, 10, 7)
  // No file is changed while others may read it, and file systems without locks exist.
  check(H5Pset_file_locking(list.get(), false, true), "turn off file locks");
#endif
  return list;
}

/// Times of creation would make equal runs differ.
Id creation_list(hid_t kind) {
  Id list = property_list(kind);
  check(H5Pset_obj_track_times(list.get(), false), "turn off time stamps");
  return list;
}

Id file_creation_list() { return creation_list(H5P_FILE_CREATE); }

Id text_type() {
  Id type(H5Tcopy(H5T_C_S1), H5Tclose, "make a text type");
  check(H5Tset_size(type.get(), H5T_VARIABLE), "make a text type");
  check(H5Tset_cset(type.get(), H5T_CSET_UTF8), "make a text type");
  return type;
}

/// Of so many bytes; a shorter text is filled up with zeros.
Id fixed_text_type(std::size_t size, bool ascii) {
  Id type(H5Tcopy(H5T_C_S1), H5Tclose, "make a text type");
  check(H5Tset_size(type.get(), std::max<std::size_t>(1, size)), "make a text type");
  check(H5Tset_strpad(type.get(), H5T_STR_NULLPAD), "make a text type");
  check(H5Tset_cset(type.get(), ascii ? H5T_CSET_ASCII : H5T_CSET_UTF8), "make a text type");
  return type;
}

bool is_ascii(const std::string& text) {
  return std::ranges::none_of(text, [](char c) { return (static_cast<unsigned char>(c) & 0x80U) != 0; });
}

/// Reads one text of any length; `read` fills a char* as HDF5 allocates it.
template <class Read>
std::string take_text(const Id& type, const Id& space, const std::string& name, const Read& read) {
  if (H5Tget_class(type.get()) != H5T_STRING || H5Tis_variable_str(type.get()) <= 0 ||
      H5Sget_simple_extent_npoints(space.get()) != 1)
    throw Failure(name + " is not a text");
  char* text = nullptr;
  const Id memory = text_type();
  check(read(memory.get(), &text), "read " + name);
  std::string result = text == nullptr ? std::string() : std::string(text);
  H5free_memory(text);
  return result;
}

}  // namespace

void check(herr_t status, const std::string& what) {
  if (status >= 0) return;
  const std::string why = reason();
  throw Failure("cannot " + what + (why.empty() ? "" : ": " + why));
}

Id::Id(hid_t id, Close closer, const std::string& what) : id_(id), close_(closer) {
  if (id_ < 0) check(-1, what);
}
Id::Id(Id&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
Id& Id::operator=(Id&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(close_, other.close_);
  return *this;
}
Id::~Id() {
  if (id_ >= 0) close_(id_);
}
void Id::close() {
  if (id_ >= 0) check(close_(std::exchange(id_, -1)), "close");
}

Id create_in_memory() {
  const Id access = access_list();
  constexpr std::size_t growth = std::size_t{1} << 20;
  check(H5Pset_fapl_core(access.get(), growth, false), "use memory as a file");
  // HDF5 refuses a second file of the same name while the first is open, in memory too.
  static std::atomic<std::uint64_t> made = 0;
  const std::string name = "memory " + std::to_string(made++);
  return {H5Fcreate(name.c_str(), H5F_ACC_TRUNC, file_creation_list().get(), access.get()), H5Fclose,
          "make a file in memory"};
}

std::vector<std::byte> image(const Id& file) {
  check(H5Fflush(file.get(), H5F_SCOPE_GLOBAL), "complete a file in memory");
  const ssize_t size = H5Fget_file_image(file.get(), nullptr, 0);
  check(size < 0 ? -1 : 0, "measure a file in memory");
  std::vector<std::byte> bytes(static_cast<std::size_t>(size));
  check(H5Fget_file_image(file.get(), bytes.data(), bytes.size()) < 0 ? -1 : 0, "copy a file in memory");
  return bytes;
}

Id open_file(const std::filesystem::path& path) {
  return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, access_list().get()), H5Fclose, "open it as HDF5"};
}

Id open_to_write(const std::filesystem::path& path) {
  return {H5Fopen(path.c_str(), H5F_ACC_RDWR, access_list().get()), H5Fclose, "open it as HDF5"};
}

Id open_image(std::span<const std::byte> bytes) {
  const Id access = access_list();
  check(H5Pset_fapl_core(access.get(), std::size_t{1} << 20, false), "use memory as a file");
  // HDF5 copies what it is given, but asks for a pointer that it might change.
  std::vector<std::byte> copy(bytes.begin(), bytes.end());
  check(H5Pset_file_image(access.get(), copy.data(), copy.size()), "use memory as a file");
  return {H5Fopen("memory", H5F_ACC_RDONLY, access.get()), H5Fclose, "open it as HDF5"};
}

Id create_group(const Id& parent, const std::string& name) {
  return {H5Gcreate2(parent.get(), name.c_str(), H5P_DEFAULT, creation_list(H5P_GROUP_CREATE).get(), H5P_DEFAULT),
          H5Gclose, "create group " + name};
}
Id open_group(const Id& parent, const std::string& name) {
  return {H5Gopen2(parent.get(), name.c_str(), H5P_DEFAULT), H5Gclose, "find group " + name};
}
bool has(const Id& parent, const std::string& name) { return H5Lexists(parent.get(), name.c_str(), H5P_DEFAULT) > 0; }

std::vector<std::string> names(const Id& group) {
  std::vector<std::string> result;
  const auto collect = [](hid_t /*group*/, const char* name, const H5L_info_t* /*info*/, void* target) -> herr_t {
    static_cast<std::vector<std::string>*>(target)->emplace_back(name);
    return 0;
  };
  check(H5Literate(group.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &result), "list a group");
  return result;
}

Id dataspace(const Dimensions& dimensions) {
  return {H5Screate_simple(static_cast<int>(dimensions.size()), dimensions.data(), nullptr), H5Sclose,
          "make a dataspace"};
}

Id create_dataset(const Id& parent, const std::string& name, hid_t type, const Dimensions& dimensions) {
  const Id list = creation_list(H5P_DATASET_CREATE);
  check(H5Pset_alloc_time(list.get(), H5D_ALLOC_TIME_EARLY), "set up a dataset");
  check(H5Pset_fill_time(list.get(), H5D_FILL_TIME_NEVER), "set up a dataset");
  return {
      H5Dcreate2(parent.get(), name.c_str(), type, dataspace(dimensions).get(), H5P_DEFAULT, list.get(), H5P_DEFAULT),
      H5Dclose, "create dataset " + name};
}
Id open_dataset(const Id& parent, const std::string& name) {
  return {H5Dopen2(parent.get(), name.c_str(), H5P_DEFAULT), H5Dclose, "find dataset " + name};
}
Dimensions dimensions_of(const Id& dataset) {
  const Id space(H5Dget_space(dataset.get()), H5Sclose, "measure a dataset");
  Dimensions dimensions(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space.get()))));
  check(H5Sget_simple_extent_dims(space.get(), dimensions.data(), nullptr), "measure a dataset");
  return dimensions;
}
Id slice(const Dimensions& dimensions, hsize_t index) {
  Id space = dataspace(dimensions);
  Dimensions start(dimensions.size(), 0);
  Dimensions count = dimensions;
  start[0] = index;
  count[0] = 1;
  check(H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr),
        "select a frame");
  return space;
}

void check_size(const Id& dataset, const std::string& name, std::size_t expected) {
  std::size_t size = 1;
  for (const hsize_t n : dimensions_of(dataset)) size *= n;
  if (size != expected)
    throw Failure(name + " has " + std::to_string(size) + " values where " + std::to_string(expected) + " belong");
}

void write_text(const Id& parent, const std::string& name, const std::string& text) {
  const Id space(H5Screate(H5S_SCALAR), H5Sclose, "make a dataspace");
  const Id type = text_type();
  const Id list = creation_list(H5P_DATASET_CREATE);
  const Id dataset(
      H5Dcreate2(parent.get(), name.c_str(), type.get(), space.get(), H5P_DEFAULT, list.get(), H5P_DEFAULT), H5Dclose,
      "create dataset " + name);
  const char* pointer = text.c_str();
  check(H5Dwrite(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, &pointer), "write " + name);
}

std::string read_text(const Id& parent, const std::string& name) {
  const Id dataset = open_dataset(parent, name);
  const Id type(H5Dget_type(dataset.get()), H5Tclose, "read " + name);
  const Id space(H5Dget_space(dataset.get()), H5Sclose, "read " + name);
  return take_text(type, space, name, [&](hid_t memory, char** text) {
    return H5Dread(dataset.get(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, text);
  });
}

void write_attribute(const Id& object, const std::string& name, const std::string& text) {
  const Id space(H5Screate(H5S_SCALAR), H5Sclose, "make a dataspace");
  const Id type = fixed_text_type(text.size(), is_ascii(text));
  const Id attribute(H5Acreate2(object.get(), name.c_str(), type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT),
                     H5Aclose, "create attribute " + name);
  check(H5Awrite(attribute.get(), type.get(), text.c_str()), "write attribute " + name);
}

void write_attribute(const Id& object, const std::string& name, const std::vector<std::string>& texts) {
  std::size_t size = 1;
  for (const std::string& text : texts) size = std::max(size, text.size());
  std::string bytes;
  for (const std::string& text : texts) bytes += text + std::string(size - text.size(), '\0');
  const Id space = dataspace({texts.size()});
  const Id type = fixed_text_type(size, is_ascii(bytes));
  const Id attribute(H5Acreate2(object.get(), name.c_str(), type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT),
                     H5Aclose, "create attribute " + name);
  check(H5Awrite(attribute.get(), type.get(), bytes.data()), "write attribute " + name);
}

bool has_attribute(const Id& object, const std::string& name) { return H5Aexists(object.get(), name.c_str()) > 0; }

std::string read_text_attribute(const Id& object, const std::string& name) {
  const Id attribute(H5Aopen(object.get(), name.c_str(), H5P_DEFAULT), H5Aclose, "find attribute " + name);
  const Id type(H5Aget_type(attribute.get()), H5Tclose, "read attribute " + name);
  const Id space(H5Aget_space(attribute.get()), H5Sclose, "read attribute " + name);
  if (H5Tget_class(type.get()) == H5T_STRING && H5Tis_variable_str(type.get()) == 0 &&
      H5Sget_simple_extent_npoints(space.get()) == 1) {
    std::string text(H5Tget_size(type.get()), '\0');
    check(H5Aread(attribute.get(), type.get(), text.data()), "read attribute " + name);
    return text.substr(0, text.find('\0'));
  }
  return take_text(type, space, name,
                   [&](hid_t memory, char** text) { return H5Aread(attribute.get(), memory, text); });
}

}  // namespace mesogen::hdf5
