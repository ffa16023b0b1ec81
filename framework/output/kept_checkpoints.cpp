#include "output/kept_checkpoints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <system_error>

#include "output/checkpoint_file.hpp"
#include "output/write_file.hpp"

namespace mesogen {

namespace {

namespace fs = std::filesystem;

/// The step makes names sort, and twelve digits of the time leave its rounding out.
std::string name_of(std::int64_t step, double time) { return fmt::format("step{:010}_t{:.12g}.h5", step, time); }

std::optional<KeptCheckpoint> read_name(const std::string& name) {
  long long step = 0;
  double time = 0.0;
  if (std::sscanf(name.c_str(), "step%lld_t%lf.h5", &step, &time) != 2 || name != name_of(step, time))
    return std::nullopt;
  return KeptCheckpoint{fs::path(kept_checkpoints_folder) / name, step, time};
}

void remove_file(const fs::path& file) {
  std::error_code error;
  fs::remove(file, error);
  if (error) throw output::system_error(ExitCode::run_failed, "remove", file, error.value());
}

}  // namespace

void keep_checkpoint(const fs::path& folder, const Checkpoint& checkpoint) {
  const fs::path kept = folder / kept_checkpoints_folder;
  std::error_code error;
  fs::create_directory(kept, error);
  if (error) throw output::system_error(ExitCode::run_failed, "make the folder", kept, error.value());
  output::sync_folder(folder);
  const std::vector<std::byte> bytes = output::encode_checkpoint(checkpoint, checkpoint.step);
  output::write_file(kept / name_of(checkpoint.step, checkpoint.time), std::span<const std::byte>(bytes));
}

std::vector<KeptCheckpoint> kept_checkpoints(const fs::path& folder) {
  std::vector<KeptCheckpoint> found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder / kept_checkpoints_folder, error))
    if (const auto kept = read_name(entry.path().filename())) found.push_back(*kept);
  std::ranges::sort(found, {}, &KeptCheckpoint::step);
  return found;
}

void remove_kept_checkpoints(const fs::path& folder, std::int64_t last_step) {
  for (const KeptCheckpoint& kept : kept_checkpoints(folder))
    if (kept.step > last_step) remove_file(folder / kept.name);
  std::error_code ignored;
  // What was left of one that was never completed.
  for (const auto& entry : fs::directory_iterator(folder / kept_checkpoints_folder, ignored))
    if (entry.path().extension() == ".tmp" && read_name(entry.path().stem())) remove_file(entry.path());
  // Stays where it holds anything else.
  if (last_step < 0) fs::remove(folder / kept_checkpoints_folder, ignored);
}

}  // namespace mesogen
