// Any bytes as a checkpoint: read or refused with a reason.
//
// The first byte chooses. 0, 3, ...: the rest is the file, seal and all. 1, 4, ...: the rest says how a sound
// checkpoint is damaged; whatever is changed, it must be refused. 2, 5, ...: the rest are instructions by which an HDF5
// file is made that is sound as such but need not be a checkpoint: objects missing, of other kinds, types, ranks and
// sizes. Its seal is right, so all of it reaches the reader.
//
// Damaged bytes never reach HDF5 in Mesogen: the checksum is looked at first. HDF5 is not made for them; 1.10.8 reads
// past its buffers when single bytes of a checkpoint's content are changed.

#include <hdf5.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "output/checkpoint_file.hpp"
#include "output/hdf5.hpp"

namespace {

using namespace mesogen;

class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}
  std::uint8_t next() {
    if (left_ == 0) return 0;
    --left_;
    return *data_++;
  }
  [[nodiscard]] bool empty() const { return left_ == 0; }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};

constexpr std::size_t seal_size = 512;

/// A dataset or attribute of one of the kinds that there may be by mistake.
void put(const hdf5::Id& parent, const std::string& name, Bytes& bytes, bool attribute) {
  const hid_t types[] = {H5T_IEEE_F64LE, H5T_STD_I64LE, H5T_IEEE_F32LE, H5T_STD_I8LE, H5T_STD_U64BE, H5T_C_S1};
  const hid_t type = types[bytes.next() % 6];
  const unsigned rank = bytes.next() % 4;
  hdf5::Dimensions sizes;
  for (unsigned axis = 0; axis < rank; ++axis) sizes.push_back(bytes.next() % 5);
  const hdf5::Id space(rank == 0 ? H5Screate(bytes.next() % 3 == 0 ? H5S_NULL : H5S_SCALAR)
                                 : H5Screate_simple(static_cast<int>(rank), sizes.data(), nullptr),
                       H5Sclose, "make a dataspace");
  std::vector<std::uint8_t> values(4 * 4 * 4 * 8);
  for (std::size_t i = 0; i < 16; ++i) values[i] = bytes.next();
  if (attribute) {
    const hdf5::Id made(H5Acreate2(parent.get(), name.c_str(), type, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                        "make an attribute");
    H5Awrite(made.get(), type, values.data());
  } else {
    const hdf5::Id made(
        H5Dcreate2(parent.get(), name.c_str(), type, space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose,
        "make a dataset");
    H5Dwrite(made.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  }
}

/// Each object of a checkpoint: as it belongs, of another kind, or missing.
std::vector<std::byte> content(Bytes& bytes) {
  const hdf5::Id file = hdf5::create_in_memory();
  for (const char* name : {"step", "time", "step_size", "dimension", "single_precision"}) {
    const std::uint8_t how = bytes.next() % 8;
    if (how == 0) continue;
    if (how == 1)
      put(file, name, bytes, true);
    else if (how < 5)
      hdf5::write_attribute(file, name, static_cast<std::int64_t>(static_cast<std::int8_t>(bytes.next())));
    else
      hdf5::write_attribute(file, name, 1e300 * bytes.next());
  }
  for (const char* name : {"case", "version", "instruction_sets"}) {
    const std::uint8_t how = bytes.next() % 8;
    if (how == 0) continue;
    if (how == 1)
      put(file, name, bytes, false);
    else if (how == 2)
      hdf5::create_group(file, name);
    else
      hdf5::write_text(file, name, std::string(bytes.next(), static_cast<char>(bytes.next() | 1)));
  }
  for (const char* name : {"numbers", "integers", "observers"}) {
    const std::uint8_t how = bytes.next() % 8;
    if (how == 0) continue;
    if (how == 1) {
      put(file, name, bytes, false);
      continue;
    }
    const hdf5::Id group = hdf5::create_group(file, name);
    for (int n = bytes.next() % 4; n > 0; --n) {
      const std::string key(1, static_cast<char>('a' + n));
      if (bytes.next() % 3 == 0) {
        const hdf5::Id inner = hdf5::create_group(group, key);
        if (bytes.next() % 2 == 0) put(inner, "x", bytes, false);
      } else {
        put(group, key, bytes, false);
      }
    }
  }
  return hdf5::image(file);
}

void read(const std::vector<std::byte>& file) {
  try {
    const Checkpoint checkpoint = output::decode_checkpoint(file);
    // What is read can be written, and is then the same.
    const Checkpoint again = output::decode_checkpoint(output::encode_checkpoint(checkpoint, 1));
    if (again.numbers.size() != checkpoint.numbers.size() || again.case_text != checkpoint.case_text) std::abort();
  } catch (const output::DamagedCheckpoint&) {
  }
}

Checkpoint sound_checkpoint() {
  Checkpoint checkpoint;
  checkpoint.step = 3;
  checkpoint.case_text = "title = \"sound\"";
  checkpoint.version = "1";
  checkpoint.instruction_sets = "derivatives baseline";
  checkpoint.numbers["position 0"] = {0.25, -0.0, 1e300};
  checkpoint.integers["id"] = {2, 0, 1};
  checkpoint.observers["paths"]["distance"] = {1.0};
  return checkpoint;
}

/// Up to four places of a sound checkpoint changed, and perhaps its end cut off.
void damage(Bytes& bytes) {
  static const std::vector<std::byte> whole = output::encode_checkpoint(sound_checkpoint(), 7);
  std::vector<std::byte> file = whole;
  const auto number = [&] { return static_cast<std::size_t>(bytes.next()) * 256 + bytes.next(); };
  for (int n = bytes.next() % 5; n > 0; --n) file[number() % file.size()] ^= static_cast<std::byte>(bytes.next());
  if (bytes.next() % 4 == 0) file.resize(number() % (file.size() + 1));
  try {
    const Checkpoint read = output::decode_checkpoint(file);
    if (file != whole || !(read == sound_checkpoint())) std::abort();
  } catch (const output::DamagedCheckpoint&) {
    if (file == whole) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  Bytes bytes(data, size);
  const int kind = bytes.next() % 3;
  if (kind == 1) {
    damage(bytes);
    return 0;
  }
  if (kind == 0) {
    std::vector<std::byte> file;
    while (!bytes.empty()) file.push_back(static_cast<std::byte>(bytes.next()));
    read(file);
    return 0;
  }
  std::vector<std::byte> made;
  try {
    made = content(bytes);
  } catch (const hdf5::Failure&) {
    return 0;  // instructions that HDF5 refuses, such as a name twice
  }
  std::vector<std::byte> sealed(seal_size);
  sealed.insert(sealed.end(), made.begin(), made.end());
  try {
    const Checkpoint checkpoint = output::decode_content({1, sealed});
    (void)output::decode_checkpoint(output::encode_checkpoint(checkpoint, 1));
  } catch (const output::DamagedCheckpoint&) {
  }
  return 0;
}
