#pragma once

#include <stdexcept>
#include <string>

#include "mesogen/export.hpp"

namespace mesogen {

/// What the command answers to its caller.
enum class ExitCode : int {
  done = 0,
  run_failed = 1,
  bad_case = 2,  ///< or bad arguments
  plugin_refused = 3,
  interrupted = 130,
};

/// An error meant for the user: says where, what, and how to mend it.
class MESOGEN_EXPORT Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ~Error() override;
  [[nodiscard]] ExitCode code() const noexcept { return code_; }

 private:
  ExitCode code_;
};

}  // namespace mesogen
