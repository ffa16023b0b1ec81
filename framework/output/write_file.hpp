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

/// What the system answered (errno) and what to do about it: "cannot write X: No space left on device; ...".
MESOGEN_EXPORT Error system_error(ExitCode code, const std::string& action, const std::filesystem::path& path,
                                  int number);

/// The name that a file has until it is complete.
std::filesystem::path temporary_name(const std::filesystem::path& path);

/// Writes beside `path`, syncs, renames over it, syncs the folder. Throws Error(run_failed); `path` is then as before.
MESOGEN_EXPORT void write_file(const std::filesystem::path& path, std::span<const std::byte> bytes);
MESOGEN_EXPORT void write_file(const std::filesystem::path& path, const std::string& text);

/// Begins a temporary file that somebody else completes, with room for `size` bytes on disk. Throws Error(run_failed).
void write_unfinished(const std::filesystem::path& path, std::span<const std::byte> begin, std::uint64_t size);

/// Syncs a complete temporary file and renames it over `path`. Throws Error(run_failed).
void put_in_place(const std::filesystem::path& path);

/// Makes what happened to the names in a folder last.
void sync_folder(const std::filesystem::path& folder);

/// Throws Error(code).
std::vector<std::byte> read_file(const std::filesystem::path& path, ExitCode code);

}  // namespace mesogen::output
