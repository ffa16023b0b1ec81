#pragma once

#include <filesystem>
#include <memory>

#include "diagnostics/log.hpp"
#include "diagnostics/trace.hpp"

namespace mesogen {

/// The trace of a run and its file, or nothing if none is asked for. The file is a valid trace from the beginning:
/// an empty one until `write`.
class RunTrace {
 public:
  /// Can the file be written once the folder of the run is there? Throws Error(bad_case) where it is a folder, has none
  /// to be in, belongs to a run, or is there already and no trace. An empty path asks for none.
  static void check(const std::filesystem::path& file, const std::filesystem::path& run_folder);

  /// Writes an empty trace: what `check` cannot foresee is told before the first step. Throws Error(run_failed).
  explicit RunTrace(std::filesystem::path file);

  /// Null if none is asked for.
  [[nodiscard]] Trace* trace() const { return trace_.get(); }
  /// However a run ended. That a trace cannot be written is no failure of the run: a warning.
  void write(Log& log) const;

 private:
  std::filesystem::path file_;
  std::unique_ptr<Trace> trace_;
};

}  // namespace mesogen
