#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <vector>

#include "mesogen/export.hpp"
#include "output/checkpoint.hpp"

/// A checkpoint as a file: HDF5 behind a block of 512 bytes, the seal, which HDF5 itself skips (a "user block"). The
/// seal holds a serial number, the length of the file and a checksum (CRC-64/XZ) of all that follows, so nothing
/// damaged is ever given to HDF5 to interpret.
namespace mesogen::output {

/// Why the bytes are no checkpoint: "truncated: ...", "damaged: ...".
class DamagedCheckpoint : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A checkpoint whose checksum is right.
struct SealedCheckpoint {
  std::int64_t serial = -1;  ///< grows with each checkpoint of a run
  std::vector<std::byte> bytes;
};

MESOGEN_EXPORT std::vector<std::byte> encode_checkpoint(const Checkpoint& checkpoint, std::int64_t serial);
/// Throws DamagedCheckpoint.
MESOGEN_EXPORT SealedCheckpoint open_seal(std::vector<std::byte> bytes);
MESOGEN_EXPORT Checkpoint decode_content(const SealedCheckpoint& sealed);
MESOGEN_EXPORT Checkpoint decode_checkpoint(std::vector<std::byte> bytes);

/// Serial number of a file if its seal is whole and its length right, else -1.
std::int64_t serial_of(const std::filesystem::path& file);

}  // namespace mesogen::output
