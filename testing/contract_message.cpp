#include "contract_message.hpp"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>

namespace mesogen::testing {

namespace {

/// Both ends are the same program.
struct Header {
  ContractMessage::Kind kind;
  int code;
  std::uint64_t what;
  std::uint64_t problem;
};

void write_all(int pipe, const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t written = ::write(pipe, data, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;  // nobody listens any more
    data += written;
    size -= static_cast<std::size_t>(written);
  }
}

bool read_all(int pipe, char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t read = ::read(pipe, data, size);
    if (read < 0 && errno == EINTR) continue;
    if (read <= 0) return false;
    data += read;
    size -= static_cast<std::size_t>(read);
  }
  return true;
}

}  // namespace

void send(int pipe, const ContractMessage& message) {
  const Header header{message.kind, message.code, message.what.size(), message.problem.size()};
  write_all(pipe, reinterpret_cast<const char*>(&header), sizeof(header));
  write_all(pipe, message.what.data(), message.what.size());
  write_all(pipe, message.problem.data(), message.problem.size());
}

std::optional<ContractMessage> receive(int pipe) {
  Header header{};
  if (!read_all(pipe, reinterpret_cast<char*>(&header), sizeof(header))) return {};
  ContractMessage message{header.kind, header.code, std::string(header.what, '\0'), std::string(header.problem, '\0')};
  if (!read_all(pipe, message.what.data(), message.what.size())) return {};
  if (!read_all(pipe, message.problem.data(), message.problem.size())) return {};
  return message;
}

std::string receive_text(int pipe) {
  std::string text;
  for (char c = '\0'; read_all(pipe, &c, 1);) text += c;
  return text;
}

}  // namespace mesogen::testing
