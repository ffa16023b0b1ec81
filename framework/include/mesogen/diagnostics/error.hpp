#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "mesogen/export.hpp"

namespace mesogen {

/// Exit status of the command.
enum class ExitCode : int {
  done = 0,
  run_failed = 1,
  bad_case = 2,  ///< or bad arguments
  plugin_refused = 3,
  interrupted = 130,
};

/// An error for the user. The message says what is wrong, where, and how to mend it.
class MESOGEN_EXPORT Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ~Error() override;
  [[nodiscard]] ExitCode code() const noexcept { return code_; }

 private:
  ExitCode code_;
};

/// A plugin refuses the value of one of its own parameters. The framework puts the parameter's place in the case before
/// the message. `key` is the name of the parameter: "bulk.A".
class MESOGEN_EXPORT BadParameter : public Error {
 public:
  BadParameter(std::string key, const std::string& message)
      : Error(ExitCode::bad_case, message), key_(std::move(key)) {}
  ~BadParameter() override;
  [[nodiscard]] const std::string& key() const noexcept { return key_; }

 private:
  std::string key_;
};

}  // namespace mesogen
