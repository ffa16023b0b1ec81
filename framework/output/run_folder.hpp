#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "mesogen/export.hpp"
#include "output/checkpoint.hpp"

namespace mesogen {

/// Keeps a second process out of the folder of a run. Released when it is destroyed or the process dies, however it
/// dies.
class MESOGEN_EXPORT RunLock {
 public:
  /// The folder must exist. Throws Error(bad_case) if another process holds the lock.
  explicit RunLock(const std::filesystem::path& folder);
  RunLock(RunLock&& other) noexcept;
  RunLock& operator=(RunLock&& other) noexcept;
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;
  ~RunLock();

 private:
  int file_ = -1;
};

/// Does the folder hold files of a run?
MESOGEN_EXPORT bool holds_run(const std::filesystem::path& folder);

/// Would writing this file harm a run: is it one of its files, or anything among its frames? Links on the way are
/// followed.
MESOGEN_EXPORT bool belongs_to_run(const std::filesystem::path& file);

/// Makes a folder ready for a new run and stores the resolved case in it as case.toml. A new folder appears with its
/// case.toml or not at all, so a run killed at any moment can be resumed if its folder is there.
/// `first`: the checkpoint that a branch starts from, which is there as soon as its case is.
/// With `overwrite`, the files that a run writes are removed first; any other file stays.
/// Throws Error(bad_case) if the folder holds a run and may not be overwritten, holds files but no run, is in use, or
/// cannot be made.
[[nodiscard]] MESOGEN_EXPORT RunLock start_run_folder(const std::filesystem::path& folder, const std::string& case_text,
                                                      bool overwrite, const Checkpoint* first = nullptr);

/// Puts another case in the place of the stored one: that of a run that is extended.
MESOGEN_EXPORT void replace_stored_case(const std::filesystem::path& folder, const std::string& case_text);

/// The resolved case of the run in a folder. Throws Error(bad_case) if there is none.
MESOGEN_EXPORT std::string stored_case(const std::filesystem::path& folder);

namespace output {

/// Removes the frames from number `first` on and what was left of unfinished ones; from 0 on, their folder too.
void remove_frames(const std::filesystem::path& folder, std::size_t first);

}  // namespace output

}  // namespace mesogen
