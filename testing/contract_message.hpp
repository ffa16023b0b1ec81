#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace mesogen::testing {

/// What the process that checks a plugin tells the one that started it.
struct ContractMessage {
  enum class Kind : char { begun, held, broken, note, refused, complete };
  Kind kind;
  int code = 0;      ///< of `refused`: its exit code
  std::string what;  ///< the check, or the text
  std::string problem;
};

/// Writes it to a pipe.
void send(int pipe, const ContractMessage& message);
/// Waits for the next one; nothing where the other end is closed.
std::optional<ContractMessage> receive(int pipe);
/// All that comes until the other end is closed.
std::string receive_text(int pipe);

}  // namespace mesogen::testing
