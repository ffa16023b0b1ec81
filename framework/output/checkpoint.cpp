#include "output/checkpoint.hpp"

#include <algorithm>
#include <functional>
#include <span>
#include <system_error>

#include "mesogen/diagnostics/error.hpp"
#include "output/checkpoint_file.hpp"
#include "output/write_file.hpp"

namespace mesogen {

namespace {

namespace fs = std::filesystem;

/// A file read and unpacked, or why not.
struct Candidate {
  std::string name;
  output::SealedCheckpoint sealed;
  std::string fault;
};

Candidate look_at(const fs::path& folder, const std::string& name) {
  Candidate candidate{name, {}, {}};
  try {
    candidate.sealed = output::open_seal(output::read_file(folder / name, ExitCode::bad_case));
  } catch (const std::exception& fault) {
    candidate.fault = fault.what();
  }
  return candidate;
}

void write(const fs::path& folder, const std::string& name, const Checkpoint& checkpoint) {
  std::int64_t newest = -1;
  for (const char* other : newest_checkpoint_names) newest = std::max(newest, output::serial_of(folder / other));
  const std::vector<std::byte> bytes = output::encode_checkpoint(checkpoint, newest + 1);
  output::write_file(folder / name, std::span<const std::byte>(bytes));
}

}  // namespace

bool has_checkpoint(const fs::path& folder) {
  std::error_code error;
  return std::ranges::any_of(newest_checkpoint_names,
                             [&](const char* name) { return fs::exists(folder / name, error); });
}

void write_checkpoint(const fs::path& folder, const Checkpoint& checkpoint) {
  // A truncated file counts as the oldest, so it goes before a whole one.
  const std::int64_t a = output::serial_of(folder / newest_checkpoint_names[0]);
  const std::int64_t b = output::serial_of(folder / newest_checkpoint_names[1]);
  write(folder, a <= b ? newest_checkpoint_names[0] : newest_checkpoint_names[1], checkpoint);
}

void write_checkpoint_before_end(const fs::path& folder, const Checkpoint& checkpoint) {
  write(folder, newest_checkpoint_names[2], checkpoint);
}

Checkpoint read_checkpoint(const fs::path& file) {
  try {
    return output::decode_checkpoint(output::read_file(file, ExitCode::bad_case));
  } catch (const output::DamagedCheckpoint& fault) {
    throw Error(ExitCode::bad_case, "cannot use " + file.string() + ": " + fault.what());
  }
}

Checkpoint read_newest_checkpoint(const fs::path& folder, std::string* which, std::vector<std::string>* refused,
                                  const CheckpointCheck& check) {
  std::vector<Candidate> candidates;
  std::error_code error;
  for (const char* name : newest_checkpoint_names)
    if (fs::exists(folder / name, error)) candidates.push_back(look_at(folder, name));
  if (candidates.empty()) throw Error(ExitCode::bad_case, folder.string() + " holds no checkpoint to continue from");
  std::ranges::stable_sort(candidates, std::ranges::greater(), [](const Candidate& one) { return one.sealed.serial; });

  // Files that were damaged have no serial number, so they are named last, but before any older one is used.
  std::vector<std::string> reasons;
  for (const Candidate& candidate : candidates)
    if (!candidate.fault.empty()) reasons.push_back(candidate.name + ": " + candidate.fault);
  for (const Candidate& candidate : candidates) {
    if (!candidate.fault.empty()) continue;
    std::string fault;
    try {
      Checkpoint checkpoint = output::decode_content(candidate.sealed);
      if (check) fault = check(checkpoint);
      if (fault.empty()) {
        if (which != nullptr) *which = candidate.name;
        if (refused != nullptr) *refused = reasons;
        return checkpoint;
      }
    } catch (const output::DamagedCheckpoint& damage) {
      fault = damage.what();
    }
    reasons.push_back(candidate.name + ": " + fault);
  }
  std::string text = "no checkpoint in " + folder.string() + " can be used:";
  for (const std::string& reason : reasons) text += "\n  " + reason;
  throw Error(ExitCode::bad_case, text);
}

}  // namespace mesogen
