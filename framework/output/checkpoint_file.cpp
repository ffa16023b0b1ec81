#include "output/checkpoint_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/crc.hpp>
#include <cstdio>
#include <fstream>
#include <limits>
#include <string>
#include <system_error>
#include <utility>

#include "mesogen/diagnostics/error.hpp"
#include "output/hdf5.hpp"
#include "output/run_record_file.hpp"

namespace mesogen::output {

namespace {

constexpr std::size_t seal_size = 512;

/// What the seal says. Written as text, so that `head -c 512` shows it.
struct Seal {
  std::int64_t serial = 0;
  std::uint64_t length = 0;  ///< of the file, bytes
  std::uint64_t checksum = 0;

  [[nodiscard]] std::string text() const {
    std::string line =
        fmt::format("Mesogen checkpoint 1\nserial {}\nlength {}\ncrc64 {:016x}\n", serial, length, checksum);
    line.resize(seal_size, '\0');
    return line;
  }
};

std::uint64_t checksum_of(std::span<const std::byte> bytes) {
  constexpr std::uint64_t all = std::numeric_limits<std::uint64_t>::max();
  boost::crc_optimal<64, 0x42F0E1EBA9EA3693ULL, all, all, true, true> crc;
  crc.process_bytes(bytes.data(), bytes.size());
  return crc.checksum();
}

/// The seal in the first bytes of a file. Only the very text that a Seal writes is taken.
Seal read_seal(std::span<const std::byte> bytes) {
  if (bytes.size() < seal_size)
    throw DamagedCheckpoint(fmt::format("truncated: it has {} bytes, not even its first {}", bytes.size(), seal_size));
  std::string text(seal_size, '\0');
  std::ranges::transform(bytes.first(seal_size), text.begin(), [](std::byte byte) { return static_cast<char>(byte); });
  if (!text.starts_with("Mesogen checkpoint ")) throw DamagedCheckpoint("not a Mesogen checkpoint, or damaged");
  Seal seal;
  long long serial = 0;
  unsigned long long length = 0;
  unsigned long long checksum = 0;
  if (std::sscanf(text.c_str(), "Mesogen checkpoint 1\nserial %lld\nlength %llu\ncrc64 %llx", &serial, &length,
                  &checksum) == 3)
    seal = {serial, length, checksum};
  if (seal.text() != text) throw DamagedCheckpoint("damaged: its first 512 bytes are not as they were written");
  return seal;
}

void check_length(const Seal& seal, std::uint64_t length) {
  if (length == seal.length) return;
  throw DamagedCheckpoint(
      fmt::format("{}: it has {} bytes of {}", length < seal.length ? "truncated" : "damaged", length, seal.length));
}

template <class T>
void write_arrays(const hdf5::Id& file, const std::string& name, const std::map<std::string, std::vector<T>>& arrays) {
  const hdf5::Id group = hdf5::create_group(file, name);
  for (const auto& [key, values] : arrays) hdf5::write(group, key, {values.size()}, values);
}

template <class T>
std::map<std::string, std::vector<T>> read_arrays(const hdf5::Id& file, const std::string& name) {
  const hdf5::Id group = hdf5::open_group(file, name);
  std::map<std::string, std::vector<T>> arrays;
  for (const std::string& key : hdf5::names(group)) arrays[key] = hdf5::read<T>(hdf5::open_dataset(group, key), key);
  return arrays;
}

}  // namespace

std::vector<std::byte> encode_checkpoint(const Checkpoint& checkpoint, std::int64_t serial) {
  std::vector<std::byte> content;
  try {
    const hdf5::Id file = hdf5::create_in_memory();
    hdf5::write_attribute(file, "step", checkpoint.step);
    hdf5::write_attribute(file, "time", checkpoint.time);
    hdf5::write_attribute(file, "step_size", checkpoint.step_size);
    hdf5::write_attribute(file, "dimension", static_cast<std::int64_t>(checkpoint.dimension));
    hdf5::write_attribute(file, "single_precision",
                          static_cast<std::int64_t>(checkpoint.precision == Precision::single_precision));
    hdf5::write_text(file, "case", checkpoint.case_text);
    hdf5::write_text(file, "version", checkpoint.version);
    hdf5::write_text(file, "instruction_sets", checkpoint.instruction_sets);
    write_arrays(file, "numbers", checkpoint.numbers);
    write_arrays(file, "integers", checkpoint.integers);
    const hdf5::Id observers = hdf5::create_group(file, "observers");
    for (const auto& [name, saved] : checkpoint.observers) write_arrays(observers, name, saved);
    write_cost(file, checkpoint.cost);
    write_end_records(file, checkpoint.end_records);
    if (checkpoint.origin) write_origin(file, *checkpoint.origin);
    if (checkpoint.shortened_for) hdf5::write_attribute(file, "shortened_for", *checkpoint.shortened_for);
    hdf5::write_attribute(file, "starts_branch", static_cast<std::int64_t>(checkpoint.starts_branch));
    content = hdf5::image(file);
  } catch (const hdf5::Failure& failure) {
    throw Error(ExitCode::run_failed, "cannot make the checkpoint: " + std::string(failure.what()));
  }
  const Seal seal{serial, seal_size + content.size(), checksum_of(content)};
  const std::string head = seal.text();
  const auto head_bytes = std::as_bytes(std::span(head));
  content.insert(content.begin(), head_bytes.begin(), head_bytes.end());
  return content;
}

SealedCheckpoint open_seal(std::vector<std::byte> bytes) {
  const Seal seal = read_seal(bytes);
  check_length(seal, bytes.size());
  if (checksum_of(std::span(bytes).subspan(seal_size)) != seal.checksum)
    throw DamagedCheckpoint("damaged: its checksum does not match its bytes");
  return {seal.serial, std::move(bytes)};
}

Checkpoint decode_content(const SealedCheckpoint& sealed) {
  try {
    const hdf5::Id file = hdf5::open_image(std::span(sealed.bytes).subspan(seal_size));
    Checkpoint checkpoint;
    checkpoint.step = hdf5::read_attribute<std::int64_t>(file, "step");
    checkpoint.time = hdf5::read_attribute<double>(file, "time");
    checkpoint.step_size = hdf5::read_attribute<double>(file, "step_size");
    checkpoint.dimension = static_cast<int>(hdf5::read_attribute<std::int64_t>(file, "dimension"));
    checkpoint.precision = hdf5::read_attribute<std::int64_t>(file, "single_precision") != 0
                               ? Precision::single_precision
                               : Precision::double_precision;
    checkpoint.case_text = hdf5::read_text(file, "case");
    checkpoint.version = hdf5::read_text(file, "version");
    checkpoint.instruction_sets = hdf5::read_text(file, "instruction_sets");
    checkpoint.numbers = read_arrays<double>(file, "numbers");
    checkpoint.integers = read_arrays<std::int64_t>(file, "integers");
    const hdf5::Id observers = hdf5::open_group(file, "observers");
    for (const std::string& name : hdf5::names(observers))
      checkpoint.observers[name] = read_arrays<double>(observers, name);
    checkpoint.cost = read_cost(file);
    checkpoint.end_records = read_end_records(file);
    if (has_origin(file)) checkpoint.origin = read_origin(file);
    if (hdf5::has_attribute(file, "shortened_for"))
      checkpoint.shortened_for = hdf5::read_attribute<double>(file, "shortened_for");
    checkpoint.starts_branch = hdf5::read_attribute<std::int64_t>(file, "starts_branch") != 0;
    return checkpoint;
  } catch (const hdf5::Failure& failure) {
    throw DamagedCheckpoint("not a checkpoint that this version reads: " + std::string(failure.what()));
  }
}

Checkpoint decode_checkpoint(std::vector<std::byte> bytes) { return decode_content(open_seal(std::move(bytes))); }

std::int64_t serial_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string head(seal_size, '\0');
  std::error_code error;
  const std::uint64_t length = std::filesystem::file_size(path, error);
  if (error || !file.read(head.data(), static_cast<std::streamsize>(head.size()))) return -1;
  try {
    const Seal seal = read_seal(std::as_bytes(std::span(head)));
    check_length(seal, length);
    return seal.serial;
  } catch (const DamagedCheckpoint&) {
    return -1;
  }
}

}  // namespace mesogen::output
