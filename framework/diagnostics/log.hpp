#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "mesogen/export.hpp"

namespace mesogen {

/// What a run tells: on stderr for the user, and with times in a file of the run.
class MESOGEN_EXPORT Log {
 public:
  /// Quiet: only warnings and errors go to stderr; the file gets everything.
  explicit Log(bool quiet = false);
  /// Tells nobody anything: of a rank whose words the first one says.
  static Log silent();
  ~Log();
  Log(Log&&) noexcept;
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;

  /// From now on also to this file, after what it holds already. Throws Error(run_failed) if it cannot be written.
  void open_file(const std::filesystem::path& file);
  void info(std::string_view text);
  void warn(std::string_view text);
  void error(std::string_view text);

 private:
  struct Sinks;
  explicit Log(std::unique_ptr<Sinks> sinks);
  std::unique_ptr<Sinks> sinks_;
};

}  // namespace mesogen
