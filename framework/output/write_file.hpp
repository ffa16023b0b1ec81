#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "mesogen/diagnostics/error.hpp"
#include "mesogen/export.hpp"

/// Files that are there whole or not at all, whenever the process dies.
namespace mesogen::output {

/// Whose file it is, so what to do when the disk is full: go on with the run, or ask for the file again.
enum class Owner { run, user };

/// What the system answered (errno) and what to do about it: "cannot write X: No space left on device; ...".
MESOGEN_EXPORT Error system_error(ExitCode code, const std::string& action, const std::filesystem::path& path,
                                  int number, Owner owner = Owner::run);

/// A file that the user names with --output: throws Error(bad_case) if it is there already and `overwrite` is not set,
/// if it is a folder, and if there is no folder for it. To be asked before the work that would be lost.
MESOGEN_EXPORT void require_writable(const std::filesystem::path& path, bool overwrite);

/// The name that a file has until it is complete.
std::filesystem::path temporary_name(const std::filesystem::path& path);

/// Writes beside `path`, syncs, renames over it, syncs the folder. Throws Error(run_failed); `path` is then as before.
MESOGEN_EXPORT void write_file(const std::filesystem::path& path, std::span<const std::byte> bytes,
                               Owner owner = Owner::run);
MESOGEN_EXPORT void write_file(const std::filesystem::path& path, const std::string& text, Owner owner = Owner::run);

/// Begins a temporary file that somebody else completes, with room for `size` bytes on disk. Throws Error(run_failed).
void write_unfinished(const std::filesystem::path& path, std::span<const std::byte> begin, std::uint64_t size,
                      Owner owner = Owner::run);

/// Syncs a complete temporary file and renames it over `path`. Throws Error(run_failed).
void put_in_place(const std::filesystem::path& path, Owner owner = Owner::run);

/// Makes what happened to the names in a folder last.
void sync_folder(const std::filesystem::path& folder);

/// Throws Error(code).
std::vector<std::byte> read_file(const std::filesystem::path& path, ExitCode code);

}  // namespace mesogen::output
