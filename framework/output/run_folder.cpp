#include "output/run_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "output/kept_checkpoints.hpp"
#include "output/write_file.hpp"

namespace mesogen {

namespace {

namespace fs = std::filesystem;

constexpr std::array run_files = {"case.toml",       "results.h5",      "results.xdmf",
                                  "checkpoint_a.h5", "checkpoint_b.h5", "checkpoint_before_end.h5",
                                  "run.log"};

/// 000012.h5, or 000012.h5.tmp of a frame that was never completed.
bool is_frame(const std::string& name) {
  const auto digits = std::ranges::find_if_not(name, [](unsigned char c) { return std::isdigit(c) != 0; });
  const std::string rest(digits, name.end());
  return digits - name.begin() >= 6 && digits - name.begin() <= 12 && (rest == ".h5" || rest == ".h5.tmp");
}

void remove_file(const fs::path& file) {
  std::error_code error;
  fs::remove(file, error);
  if (error) throw output::system_error(ExitCode::bad_case, "remove", file, error.value());
}

void remove_run(const fs::path& folder) {
  // The case goes first: a folder without one is no run to resume.
  for (const char* name : run_files) {
    remove_file(folder / name);
    remove_file(output::temporary_name(folder / name));
  }
  output::remove_frames(folder, 0);
  remove_kept_checkpoints(folder, -1);
}

/// The folder with its case and a lock, under another name; renamed when complete.
fs::path name_before_start(const fs::path& folder) {
  return folder.parent_path() / ("." + folder.filename().string() + ".starting");
}

/// Removes a folder that was about to start. Whoever finds it locked is not the one to remove it.
void remove_unstarted(const fs::path& folder) {
  std::error_code ignored;
  for (const char* name : {"case.toml", "case.toml.tmp", "checkpoint_a.h5", "checkpoint_a.h5.tmp", "mesogen.lock"})
    fs::remove(folder / name, ignored);
  fs::remove(folder, ignored);
}

/// Nothing if an empty folder is there already and has to be filled in place.
std::optional<RunLock> start_new_folder(const fs::path& folder, const std::string& case_text, const Checkpoint* first) {
  const fs::path before = name_before_start(folder);
  std::error_code error;
  std::error_code ignored;
  fs::create_directories(before, error);
  if (error && fs::exists(folder, ignored)) return std::nullopt;
  if (error) throw output::system_error(ExitCode::bad_case, "make the folder", folder, error.value());
  RunLock lock(before);
  try {
    if (first != nullptr) write_checkpoint(before, *first);
    output::write_file(before / "case.toml", case_text);
  } catch (...) {
    remove_unstarted(before);
    throw;
  }
  fs::rename(before, folder, error);
  if (!error) {
    output::sync_folder(folder.parent_path());
    return lock;
  }
  remove_unstarted(before);
  if (fs::exists(folder, ignored)) return std::nullopt;
  throw output::system_error(ExitCode::bad_case, "make the folder", folder, error.value());
}

/// A case.toml that no run stored: a run has its lock beside it.
bool holds_other_case(const fs::path& folder) {
  std::error_code error;
  return fs::exists(folder / "case.toml", error) && !fs::exists(folder / "mesogen.lock", error) &&
         std::ranges::none_of(run_files, [&](const std::string& name) {
           return name != "case.toml" && fs::exists(folder / name, error);
         });
}

/// Files of somebody else's, among which those of a run would be scattered. A lock or a log is left of a run too.
bool holds_no_run_but_files(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error) || fs::is_empty(folder, error) || error) return false;
  return !holds_run(folder) && !fs::exists(folder / "mesogen.lock", error) && !fs::exists(folder / "run.log", error);
}

}  // namespace

namespace output {

void remove_frames(const fs::path& folder, std::size_t first) {
  const fs::path frames = folder / "frames";
  std::error_code error;
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(frames, error)) {
    const std::string name = entry.path().filename();
    if (!is_frame(name)) continue;
    if (name.ends_with(".tmp") || std::stoull(name) >= first) found.push_back(entry.path());
  }
  if (error && error != std::errc::no_such_file_or_directory)
    throw system_error(ExitCode::run_failed, "list", frames, error.value());
  for (const fs::path& file : found) remove_file(file);
  // Stays where it holds anything else.
  if (first == 0) fs::remove(frames, error);
}

}  // namespace output

RunLock::RunLock(const fs::path& folder) {
  const fs::path path = folder / "mesogen.lock";
  file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0) throw output::system_error(ExitCode::bad_case, "lock the folder by", path, errno);
  if (::flock(file_, LOCK_EX | LOCK_NB) == 0) return;
  const int number = errno;
  ::close(file_);
  if (number == EWOULDBLOCK)
    throw Error(ExitCode::bad_case, "another run is writing into " + folder.string() +
                                        ": wait until it ends, or choose another folder with --output");
  throw output::system_error(ExitCode::bad_case, "lock", path, number);
}
RunLock::RunLock(RunLock&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
RunLock& RunLock::operator=(RunLock&& other) noexcept {
  std::swap(file_, other.file_);
  return *this;
}
RunLock::~RunLock() {
  if (file_ >= 0) ::close(file_);
}

bool holds_run(const fs::path& folder) {
  std::error_code error;
  return std::ranges::any_of(
      run_files, [&](const char* name) { return std::string(name) != "run.log" && fs::exists(folder / name, error); });
}

bool belongs_to_run(const fs::path& file) {
  std::error_code error;
  const fs::path parent = fs::weakly_canonical(fs::absolute(file).parent_path(), error);
  if (error) return false;
  const fs::path name = file.extension() == ".tmp" ? file.stem() : file.filename();
  const bool is_run_file = name == "mesogen.lock" || std::ranges::find(run_files, name.string()) != run_files.end();
  if (is_run_file && holds_run(parent)) return true;
  for (fs::path folder = parent; folder.has_relative_path(); folder = folder.parent_path())
    if ((folder.filename() == "frames" || folder.filename() == kept_checkpoints_folder) &&
        holds_run(folder.parent_path()))
      return true;
  return false;
}

RunLock start_run_folder(const fs::path& given, const std::string& case_text, bool overwrite, const Checkpoint* first) {
  const fs::path folder = (given.has_filename() ? given : given.parent_path());
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    throw Error(ExitCode::bad_case, folder.string() + " is a file: choose another --output");
  if (holds_other_case(folder))
    throw Error(ExitCode::bad_case, (folder / "case.toml").string() +
                                        " was not stored by a run, and a run keeps its own case.toml there: choose "
                                        "another --output, or move it away");
  const auto refuse_run = [&] {
    if (!overwrite && holds_run(folder))
      throw Error(ExitCode::bad_case, folder.string() +
                                          " already holds a run: continue it with `mesogen resume`, replace it with "
                                          "--overwrite, or choose another --output");
  };
  refuse_run();
  if (holds_no_run_but_files(folder))
    throw Error(ExitCode::bad_case, folder.string() +
                                        " is not empty and holds no run: choose another --output, such as a new folder "
                                        "in it");
  if (!fs::exists(folder, error) || fs::is_empty(folder, error)) {
    std::optional<RunLock> lock = start_new_folder(folder, case_text, first);
    if (lock) return std::move(*lock);
  }
  RunLock lock(folder);
  refuse_run();
  remove_run(folder);
  if (first != nullptr) write_checkpoint(folder, *first);
  output::write_file(folder / "case.toml", case_text);
  return lock;
}

void replace_stored_case(const fs::path& folder, const std::string& case_text) {
  output::write_file(folder / "case.toml", case_text);
}

std::string stored_case(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder / "case.toml", error))
    throw Error(ExitCode::bad_case, folder.string() + " holds no run: it has no case.toml");
  const std::vector<std::byte> bytes = output::read_file(folder / "case.toml", ExitCode::bad_case);
  std::string text(bytes.size(), '\0');
  std::ranges::transform(bytes, text.begin(), [](std::byte byte) { return static_cast<char>(byte); });
  return text;
}

}  // namespace mesogen
